// Validation of the model: Den Hartog's phase angle (Eqs. 15-21) against event-driven integration
// of Eq. 10 in time; the error of the published discretisation (phase from a 901-point transform,
// limit of Eq. 18 on a grid of 14 points); the response beyond the limit of continuous motion,
// where the analytic model is NaN; and an open question of the paper's Section 4: does the
// posterior change when stick-slip responses are computed instead of given the likelihood 0?
//
// Data: frequency ratios and phase angles of Table 1 and the prior of Table 2 as printed in Lye and
// Marino (ESREL 2023), or the reader's own.

#include <algorithm>
#include <cmath>

#include "estimation/stick_slip.hpp"
#include "inputs.hpp"
#include "replication/model_checks.hpp"

using namespace experiments;

namespace {

std::string degrees(double value) {
  return std::isfinite(value) ? fmt::format("{:.8f}", value) : "nan";
}

/// Analytic and integrated phase over a grid of r and phi, and the kind of motion beyond the limit.
void check_phases(const Report& report, OptionalCsv& csv, const friction::Observations& observations,
                  double driving_force_n, long points) {
  report("{:>8} {:>9} {:>9} {:>22} {:>22} {:>24}\n", "r", "phi_lim", "on grid", "largest difference, deg",
         "stick-slip phase, deg", "stops a period");
  double largest = 0.0, between = 0.0;
  long compared = 0, continuous_beyond = 0, stopping_below = 0;
  for (const double r : observations.measured_ratio) {
    const auto check = replication::check_phase(r, driving_force_n, points);
    for (const auto& point : check.points) {
      csv.row(r, point.force_ratio, digits(check.limit_force_ratio), digits(check.limit_force_ratio_grid),
              degrees(point.exact_deg), degrees(point.published_deg), degrees(point.integrated_deg),
              point.stops_per_period);
    }
    largest = std::max(largest, check.largest_difference_deg);
    between = std::max(between, check.published_error_deg);
    compared += check.compared;
    continuous_beyond += check.continuous_beyond;
    stopping_below += check.stopping_below;
    const bool stick_slip = check.most_stops > 0;
    report("{:>8} {:>9.5f} {:>9.5f} {:>22.1e} {:>22} {:>24}\n", r, check.limit_force_ratio,
           check.limit_force_ratio_grid, check.largest_difference_deg,
           stick_slip ? fmt::format("{:.1f} to {:.1f}", check.lowest_deg, check.highest_deg) : "none",
           stick_slip ? fmt::format("{} to {}", check.fewest_stops, check.most_stops) : "");
  }
  report(
      "largest difference of the phase angle {:.1e} deg over {} points below the limit;\n"
      "{} of them stop, {} beyond the limit do not; between the exact limit and the published one\n"
      "the published phase is off by up to {:.2f} deg\n",
      largest, compared, stopping_below, continuous_beyond, between);
}

/// Phase of the discrete bin minus the exact phase, and the limit on the grid relative to the exact
/// limit, over r.
void published_errors(const Report& report, OptionalCsv& csv, double friction_force_n, double driving_force_n,
                      long points) {
  constexpr double lowest = 0.6, highest = 2.0;
  double least = 0.0, most = 0.0, limit = 0.0;
  for (const auto& error :
       replication::discretisation_errors(lowest, highest, points, friction_force_n, driving_force_n)) {
    csv.row(digits(error.frequency_ratio), digits(error.phase_deg, 8), digits(error.limit_relative, 8));
    least = std::min(least, error.phase_deg);
    most = std::max(most, error.phase_deg);
    limit = std::max(limit, error.limit_relative);
  }
  report(
      "published discretisation, r = {} to {}: phase at {} N off by {:+.4f} to {:+.4f} deg,\n"
      "limit by up to {:.2f} %\n",
      lowest, highest, friction_force_n, least, most, 100.0 * limit);
}

void report_stick_slip(const Report& report, OptionalCsv& csv, double limit_n,
                       const estimation::ExactPosterior& posterior,
                       const estimation::StickSlipPosterior& computed) {
  const auto& excluded = posterior.marginal(friction::friction_force);
  const double sd = excluded.standard_deviation();
  report(
      "stick-slip computed instead of excluded, F_mu beyond {:.6f} N: posterior probability {:.3g};\n"
      "F_mu mean {:.6f} N {:+.1e}, sd {:.6f} N {:+.1e}; log-evidence {:.5f} {:+.1e}\n",
      limit_n, computed.probability, excluded.mean(), computed.mean_shift, sd,
      computed.standard_deviation - sd, posterior.log_evidence(), computed.log_evidence_change);
  csv.row("excluded", digits(excluded.mean()), digits(sd), digits(posterior.log_evidence()), 0, 0);
  csv.row("computed", digits(excluded.mean() + computed.mean_shift), digits(computed.standard_deviation),
          digits(posterior.log_evidence() + computed.log_evidence_change), digits(computed.probability, 6),
          digits(computed.probability_error, 1));
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Den Hartog's solution and the published discretisation against integration in time, and the "
      "posterior with stick-slip.",
      "model_validation");
  Report report(app);
  std::string output;
  InputFiles inputs;
  PhysicsOptions physics;
  double friction_force = 1.086;
  long points = 201, error_points = 281;
  std::string errors_output, posterior_output;
  add_output(app, output, "CSV: exact, published and integrated phase over frequency ratio and force ratio");
  add_output(app, "--errors-output", errors_output,
             "CSV: errors of the published discretisation over the frequency ratio");
  add_output(app, "--posterior-output", posterior_output,
             "CSV: posterior with stick-slip excluded and computed");
  inputs.add_observations_to(app);
  inputs.add_prior_to(app);
  physics.add_driving_force_to(app);
  app.add_option("--friction-force", friction_force, "Friction force of the errors, N")
      ->transform(non_negative());
  app.add_option("--points", points, "Force ratios from 0 to 1")->transform(count(2, 100000));
  app.add_option("--error-points", error_points, "Frequency ratios of the errors")
      ->transform(count(2, 1000000));

  return report.run(argc, argv, [&] {
    const double driving_force = physics.driving_force_n;
    const auto observations = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, replication::reading(replication::ReadingName::corrected));
    const friction::Likelihood likelihood(observations, {.driving_force_n = driving_force});
    const auto posterior = exact_posterior_for(inputs, likelihood, prior);
    auto csv = open_csv(
        output, {"frequency_ratio", "force_ratio", "limit_force_ratio", "limit_force_ratio_grid",
                 "phase_exact_deg", "phase_published_deg", "phase_integrated_deg", "stops_per_period"});
    auto errors = open_csv(errors_output, {"frequency_ratio", "phase_error_deg", "limit_relative_error"});
    auto moments =
        open_csv(posterior_output, {"stick_slip", "mean_friction_force_n", "sd_friction_force_n",
                                    "log_evidence", "stick_slip_probability", "probability_error"});
    check_phases(report, csv, observations, driving_force, points);
    published_errors(report, errors, friction_force, driving_force, error_points);
    report_stick_slip(
        report, moments, likelihood.limit_friction_force_n(), posterior,
        estimation::posterior_with_stick_slip(observations, likelihood, posterior,
                                              bounds_of(prior, "the posterior with stick-slip")));
    io::commit_all(csv, errors, moments);
  });
}
