// Validation of the model: Den Hartog's phase angle (Eqs. 15-21) against event-driven integration of Eq. 10 in time; the
// error of the published discretisation (phase from a 901-point transform, limit of Eq. 18 on a grid of 14 points); the
// response beyond the limit of continuous motion, where the analytic model is NaN; and an open question of the paper's
// Section 4: does the posterior change when stick-slip responses are computed instead of given the likelihood 0?
//
// Data: frequency ratios and phase angles of Table 1 and the prior of Table 2 as printed in Lye and Marino (ESREL
// 2023), or the reader's own.

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <map>

#include "friction/angle.hpp"
#include "friction/time_integration.hpp"
#include "inputs.hpp"
#include "portable_math/elementary.hpp"

using namespace experiments;

namespace {

/// Closer to the limit than this, as a fraction of it, the integrator can take a near stop for a stop.
constexpr double near_limit = 1e-3;

/// Posterior masses below this are not refined.
constexpr double negligible_mass = 1e-20;

std::string degrees(double value) {
  return std::isfinite(value) ? fmt::format("{:.8f}", value) : "nan";
}

/// The same motion in the exact model and in the published discretisation.
struct Models {
  friction::ResponseConstants exact, published;

  Models(double r, double driving_force_n)
      : exact(friction::response_constants(r, {.driving_force_n = driving_force_n})),
        published(friction::response_constants(r, {.driving_force_n = driving_force_n,
                                                   .limit = friction::LimitRule::grid,
                                                   .phase = friction::PhaseRule::discrete_bin})) {}
};

/// Analytic and integrated phase over a grid of r and phi, and what motion there is beyond the limit.
void validate_phase(const Program& program, std::optional<io::CsvWriter>& csv,
                    const friction::Observations& observations, double driving_force_n, long points) {
  program.report("{:>8} {:>9} {:>9} {:>22} {:>22} {:>24}\n", "r", "phi_lim", "on grid",
                 "largest difference, deg", "stick-slip phase, deg", "stops a period");
  double largest = 0.0, between = 0.0;
  long compared = 0, continuous_beyond = 0, stopping_below = 0;
  for (const double r : observations.measured_ratio) {
    const Models models(r, driving_force_n);
    double difference = 0.0, lowest = 360.0, highest = 0.0;
    int fewest = 1000000, most = 0;
    for (long i = 0; i < points; ++i) {
      const double phi = static_cast<double>(i) / static_cast<double>(points - 1);
      const auto integrated = friction::integrate_steady_response(r, phi);
      const double exact = friction::phase_deg(models.exact, phi);
      const double published = friction::phase_deg(models.published, phi);
      if (csv) {
        csv->row(r, phi, digits(models.exact.limit_force_ratio), digits(models.published.limit_force_ratio),
                 degrees(exact), degrees(published), degrees(integrated.phase_deg),
                 integrated.stops_per_period);
      }
      const double beyond = phi / models.exact.limit_force_ratio - 1.0;
      if (integrated.state != friction::SteadyState::periodic || std::fabs(beyond) < near_limit) {
        continue;
      }
      if (beyond < 0.0) {
        difference = std::max(difference, std::fabs(integrated.phase_deg - exact));
        stopping_below += integrated.continuous ? 0 : 1;
        ++compared;
      } else {
        between =
            std::max(between, std::isnan(published) ? 0.0 : std::fabs(published - integrated.phase_deg));
        lowest = std::min(lowest, integrated.phase_deg);
        highest = std::max(highest, integrated.phase_deg);
        fewest = std::min(fewest, integrated.stops_per_period);
        most = std::max(most, integrated.stops_per_period);
        continuous_beyond += integrated.continuous ? 1 : 0;
      }
    }
    largest = std::max(largest, difference);
    const bool stick_slip = most > 0;
    program.report("{:>8} {:>9.5f} {:>9.5f} {:>22.1e} {:>22} {:>24}\n", r, models.exact.limit_force_ratio,
                   models.published.limit_force_ratio, difference,
                   stick_slip ? fmt::format("{:.1f} to {:.1f}", lowest, highest) : "none",
                   stick_slip ? fmt::format("{} to {}", fewest, most) : "");
  }
  program.report(
      "largest difference of the phase angle {:.1e} deg over {} points below the limit;\n"
      "{} of them stop, {} beyond the limit do not; between the exact limit and the published one\n"
      "the published phase is off by up to {:.2f} deg\n",
      largest, compared, stopping_below, continuous_beyond, between);
}

/// Phase of the discrete bin minus the exact one, and the limit on the grid relative to the exact one, over r.
void published_errors(const Program& program, std::optional<io::CsvWriter>& csv, double friction_force_n,
                      double driving_force_n, long points) {
  constexpr double lowest = 0.6, highest = 2.0;
  double least = 0.0, most = 0.0, limit = 0.0;
  for (long i = 0; i < points; ++i) {
    const double r = lowest + (highest - lowest) * static_cast<double>(i) / static_cast<double>(points - 1);
    if (friction::is_singular_ratio(r)) {
      continue;
    }
    const Models models(r, driving_force_n);
    const double phi = friction_force_n / driving_force_n;
    const double phase = friction::phase_deg(models.published, phi) - friction::phase_deg(models.exact, phi);
    const double relative = models.published.limit_force_ratio / models.exact.limit_force_ratio - 1.0;
    if (csv) {
      csv->row(digits(r), digits(phase, 8), digits(relative, 8));
    }
    least = std::min(least, phase);
    most = std::max(most, phase);
    limit = std::max(limit, relative);
  }
  program.report(
      "published discretisation, r = {} to {}: phase at {} N off by {:+.4f} to {:+.4f} deg,\n"
      "limit by up to {:.2f} %\n",
      lowest, highest, friction_force_n, least, most, 100.0 * limit);
}

/// Squared phase residuals, the phase being integrated where an observation's motion is not continuous; NaN from phi = 1
/// on, where the mass rests and has no phase.
double misfit_with_stick_slip(const friction::Observations& observations,
                              const std::vector<friction::ResponseConstants>& constants, double phi) {
  double sum = 0.0;
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const double phase =
        phi <= constants[i].limit_force_ratio
            ? friction::phase_deg(constants[i], phi)
            : friction::integrate_steady_response(constants[i].frequency_ratio, phi).phase_deg;
    const double residual = friction::angle_residual_deg(observations.phase_deg[i], phase);
    sum += residual * residual;
  }
  return sum;
}

/// Posterior mass of the friction forces beyond the limit, with their first two moments about a centre, as multiples
/// of the mass below it.
struct Beyond {
  double mass = 0.0, first = 0.0, second = 0.0;
  double error = 0.0;  ///< of the mass
};

Beyond integrate_beyond(const friction::Observations& observations, double driving_force_n,
                        const estimation::Interval& force, const estimation::Interval& noise,
                        double log_mass_below, double centre) {
  std::vector<friction::ResponseConstants> constants;
  constants.reserve(observations.size());
  for (const double r : observations.measured_ratio) {
    constants.push_back(friction::response_constants(r, {.driving_force_n = driving_force_n}));
  }
  // The motion of one observation after the other stops: there the misfit has kinks.
  const double top = std::min(force.upper, driving_force_n);
  std::vector<double> limits;
  for (const auto& c : constants) {
    limits.push_back(std::clamp(c.limit_force_ratio * driving_force_n, force.lower, top));
  }
  std::sort(limits.begin(), limits.end());
  std::vector<double> ends = {limits.front()};
  for (const double limit : limits) {
    if (limit - ends.back() > (top - limits.front()) / 64.0) {
      ends.push_back(limit);
    }
  }
  ends.push_back(top);
  std::map<double, double> known;
  const auto density = [&](double x) {
    const auto [place, is_new] = known.try_emplace(x, 0.0);
    if (is_new) {
      const double misfit = misfit_with_stick_slip(observations, constants, x / driving_force_n);
      place->second =
          std::isnan(misfit)
              ? 0.0
              : portable_math::exp(estimation::log_noise_integral(observations.size(), noise, misfit) -
                                   log_mass_below);
    }
    return place->second;
  };
  Beyond beyond;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (!(ends[i] < ends[i + 1])) {
      continue;
    }
    const auto integral = [&](int power, unsigned depth, double* error) {
      return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
          [&](double x) {
            const double d = x - centre;
            return density(x) * (power == 0 ? 1.0 : power == 1 ? d : d * d);
          },
          ends[i], ends[i + 1], depth, 1e-7, error);
    };
    double error = 0.0;
    const unsigned depth = integral(0, 0, nullptr) > negligible_mass ? 6 : 0;
    beyond.mass += integral(0, depth, &error);
    beyond.first += integral(1, depth, nullptr);
    beyond.second += integral(2, depth, nullptr);
    beyond.error += error;
  }
  return beyond;
}

void stick_slip(const Program& program, std::optional<io::CsvWriter>& csv,
                const friction::Observations& observations, const friction::Likelihood& likelihood,
                const estimation::ExactPosterior& posterior, const estimation::ParameterBounds& bounds) {
  const auto& excluded = posterior.marginal(friction::friction_force);
  const double sd = excluded.standard_deviation();
  const Beyond beyond =
      integrate_beyond(observations, likelihood.driving_force_n(), bounds[friction::friction_force],
                       bounds[friction::phase_noise], excluded.log_integral(), excluded.mean());
  const double total = 1.0 + beyond.mass;
  const double shift = beyond.first / total;
  const double sd_computed = std::sqrt((sd * sd + beyond.second) / total - shift * shift);
  const double evidence_change = portable_math::log(total);
  program.report(
      "stick-slip computed instead of excluded, F_mu beyond {:.6f} N: posterior probability {:.3g};\n"
      "F_mu mean {:.6f} N {:+.1e}, sd {:.6f} N {:+.1e}; log-evidence {:.5f} {:+.1e}\n",
      likelihood.limit_friction_force_n(), beyond.mass / total, excluded.mean(), shift, sd, sd_computed - sd,
      posterior.log_evidence(), evidence_change);
  if (csv) {
    csv->row("excluded", digits(excluded.mean()), digits(sd), digits(posterior.log_evidence()), 0, 0);
    csv->row("computed", digits(excluded.mean() + shift), digits(sd_computed),
             digits(posterior.log_evidence() + evidence_change), digits(beyond.mass / total, 6),
             digits(beyond.error / total, 1));
  }
}

}  // namespace

int main(int argc, char** argv) {
  Program program(
      "model_validation",
      "Den Hartog's solution and the published discretisation against integration in time, and the "
      "posterior with stick-slip.");
  InputFiles inputs;
  PhysicsOptions physics;
  double friction_force = 1.086;
  long points = 201, error_points = 281;
  std::string errors_output, posterior_output;
  program.add_output("CSV: exact, published and integrated phase over frequency ratio and force ratio");
  program.add_file_output("--errors-output", errors_output,
                          "CSV: errors of the published discretisation over the frequency ratio");
  program.add_file_output("--posterior-output", posterior_output,
                          "CSV: posterior with stick-slip excluded and computed");
  inputs.add_observations_to(program);
  inputs.add_prior_to(program);
  physics.add_driving_force_to(program);
  program.add_number("--friction-force", friction_force, non_negative(), "Friction force of the errors, N");
  program.add_number("--points", points, count(2, 100000), "Force ratios from 0 to 1");
  program.add_number("--error-points", error_points, count(2, 1000000), "Frequency ratios of the errors");

  return program.run(argc, argv, [&] {
    const double driving_force = physics.driving_force_n;
    const auto observations = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, replication::reading(replication::ReadingName::corrected));
    const friction::Likelihood likelihood(observations, {.driving_force_n = driving_force});
    const auto posterior = exact_posterior_for(inputs, likelihood, prior);
    auto csv = open_csv(program.output(), {"frequency_ratio", "force_ratio", "limit_force_ratio",
                                           "limit_force_ratio_grid", "phase_exact_deg", "phase_published_deg",
                                           "phase_integrated_deg", "stops_per_period"});
    auto errors = open_csv(errors_output, {"frequency_ratio", "phase_error_deg", "limit_relative_error"});
    auto moments =
        open_csv(posterior_output, {"stick_slip", "mean_friction_force_n", "sd_friction_force_n",
                                    "log_evidence", "stick_slip_probability", "probability_error"});
    validate_phase(program, csv, observations, driving_force, points);
    published_errors(program, errors, friction_force, driving_force, error_points);
    stick_slip(program, moments, observations, likelihood, posterior, bounds_of(prior));
    io::commit_all(csv, errors, moments);
  });
}
