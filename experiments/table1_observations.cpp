// Table 1: observations with noise (Eqs. 22-23) for any truth, noise levels and seed; and an audit
// of the printed table, with the phase and the limit of the reading and with the exact ones:
// standardised residuals, chi^2 and likelihood-ratio tests of the stated truth (1.086 N) and of 1.0
// N, confidence intervals. Data: Table 1 as printed, or the reader's own observations: a truth that
// is given is that of the observations generated, and audits those of --observations, not the
// printed ones.

#include <algorithm>
#include <cmath>

#include "inputs.hpp"
#include "replication/audit.hpp"

using namespace experiments;

namespace {

void report_rows(const Report& report, const replication::Audit& a, const replication::Truth& truth,
                 double alternative) {
  report("{:>5} {:>20} {:>18} {:>18} {:>18}\n", "row", "omega_b - r omega_n", "(r-r_nom)/sigma",
         fmt::format("phase z, {} N", truth.friction_force_n), fmt::format("phase z, {} N", alternative));
  for (std::size_t i = 0; i < a.ratio_residual.size(); ++i) {
    report("{:>5} {:>20.5f} {:>18.3f} {:>18.3f} {:>18.3f}\n", i + 1, a.frequency_difference_hz[i],
           a.ratio_residual[i], a.phase_residual_truth[i], a.phase_residual_alternative[i]);
  }
  report("frequency ratio: chi^2 = {:.1f} on {} points, p = {:.2g}\n", a.ratio_chi_squared,
         a.ratio_residual.size(), a.ratio_chi_squared_p);
}

void report_parameter(const Report& report, const char* name, const char* unit,
                      const replication::ParameterAudit& a) {
  const auto interval = [&](const replication::ConfidenceInterval& i) {
    return std::isnan(i.lower) ? "undefined"
                               : fmt::format("[{:.5g}, {:.5g}]{}", i.lower, i.upper,
                                             i.lower_at_bound || i.upper_at_bound ? " up to a bound" : "");
  };
  report("{} = {:.5g} {} (least squares), chi^2 = {:.1f}, p = {}\n", name, a.estimate, unit, a.chi_squared,
         or_undefined("{:.2g}", a.chi_squared_p));
  report("  95 % interval {} with noise {} as stated, {} with noise unknown ({})\n",
         interval(a.noise_known_95), a.noise_stated, interval(a.noise_unknown_95),
         or_undefined("{:.4g}", a.noise_unbiased));
  if (a.fitted_noise != estimation::FittedNoise::determined)
    report("  the unknown noise is undefined: {}\n", describe(a.fitted_noise));
  for (const auto& t : a.tests) {
    if (std::isnan(t.chi_squared)) {
      report("  {} {}: the motion is not continuous at every observation\n", t.value, unit);
    } else {
      report(
          "  {} {}: chi^2 = {:.1f}, p = {:.2g}; likelihood ratio {:.2f}, p = {:.2g}; noise unknown F = "
          "{}, p = {}\n",
          t.value, unit, t.chi_squared, t.chi_squared_p, t.likelihood_ratio, t.likelihood_ratio_p,
          or_undefined("{:.2f}", t.f_statistic), or_undefined("{:.2g}", t.f_p));
    }
  }
}

void write_audit(OptionalCsv& csv, const std::string& physics, const replication::Audit& audit) {
  for (const auto& line : replication::audit_lines(audit)) {
    const auto& t = line.test;
    csv.row(line.parameter, line.hypothesis, digits(t.value, 8), line.noise_stated,
            digits(line.noise_unbiased, 8), digits(t.chi_squared, 8), digits(t.chi_squared_p, 4),
            digits(t.likelihood_ratio, 8), digits(t.likelihood_ratio_p, 4), digits(t.f_statistic, 8),
            digits(t.f_p, 4), digits(line.noise_known_95.lower, 8), digits(line.noise_known_95.upper, 8),
            digits(line.noise_unknown_95.lower, 8), digits(line.noise_unknown_95.upper, 8), physics);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Generates observations with noise (Table 1, Eqs. 22-23) and audits the printed ones.",
               "table1_observations");
  Report report(app);
  InputFiles inputs;
  PhysicsOptions physics;
  RunOptions run_options;
  TruthOptions truth_options;
  double alternative = 1.0;
  std::string output, audit_output, summary_output;
  add_output(app, output, "CSV of generated observations, as table1_observations.csv");
  add_output(app, "--audit-output", audit_output, "CSV of the audit, one row an observation");
  add_output(app, "--audit-summary-output", summary_output,
             "CSV of the audit's statistics: estimates, tests, 95 % intervals");
  truth_options.add_to(app);
  app.add_option("--alternative", alternative, "Second friction force of the audit, N")
      ->transform(non_negative());
  run_options.add_seed_to(app);
  inputs.add_observations_to(app);
  physics.add_to(app);

  return report.run(argc, argv, [&] {
    const auto reading = physics.reading();
    const auto& truth = truth_options.truth;
    const bool is_wanted = !audit_output.empty() || !summary_output.empty();
    // A truth that the reader gives says nothing about the table of the paper.
    const bool is_of_the_data = !truth_options.is_given(app) || app.get_option("--observations")->count() > 0;
    const bool has_noise = truth.phase_noise_deg > 0.0 && truth.frequency_ratio_noise > 0.0;
    const bool audited = has_noise && (is_wanted || is_of_the_data);
    if (is_wanted && !has_noise) {
      throw io::InputError(
          fmt::format("{}: expected positive noise levels, the residuals are divided by them",
                      audit_output.empty() ? "--audit-summary-output" : "--audit-output"));
    }
    const auto printed = read_observations(inputs.observations);
    const auto generated = replication::generate_observations(truth, replication::nominal_ratios(),
                                                              reading.physics, run_options.seed);
    auto csv = open_csv(output, {"index", "r_nominal", "r_measured", "driving_frequency_hz", "phase_deg"});
    auto rows = open_csv(audit_output, {"index", "driving_frequency_difference_hz", "ratio_residual",
                                        "phase_residual_truth", "phase_residual_alternative",
                                        "phase_residual_truth_exact", "phase_residual_alternative_exact"});
    auto summary =
        open_csv(summary_output, {"parameter", "hypothesis", "value", "noise_stated", "noise_unbiased",
                                  "chi_squared", "chi_squared_p", "likelihood_ratio", "likelihood_ratio_p",
                                  "f_statistic", "f_p", "noise_known_low", "noise_known_high",
                                  "noise_unknown_low", "noise_unknown_high", "physics"});
    for (std::size_t i = 0; i < generated.size(); ++i) {
      csv.row(i + 1, generated.nominal_ratio[i], generated.measured_ratio[i],
              generated.driving_frequency_hz[i], generated.phase_deg[i]);
    }
    if (!audited) {
      report("Generated {} observations: truth {} N, {} Hz; noise {} deg, {}; driving force {} N. {}\n",
             generated.size(), truth.friction_force_n, truth.natural_frequency_hz, truth.phase_noise_deg,
             truth.frequency_ratio_noise, reading.physics.driving_force_n,
             has_noise ? "Measurements are audited if --observations names them"
                       : "Without noise there is no audit");
    } else {
      const auto a = replication::audit(printed, truth, alternative, reading.physics);
      const auto exact_physics = replication::with_exact_rules(reading.physics);
      const auto exact = replication::audit(printed, truth, alternative, exact_physics);
      report("Audit of {} (reading {}): truth {} N, {} Hz; noise {} deg, {}\n", inputs.observations,
             physics.reading_name, truth.friction_force_n, truth.natural_frequency_hz, truth.phase_noise_deg,
             truth.frequency_ratio_noise);
      report_rows(report, a, truth, alternative);
      report_parameter(report, "F_mu", "N", a.friction_force);
      report_parameter(report, "omega_n", "Hz", a.natural_frequency);
      report("With the exact phase and limit:\n");
      report_parameter(report, "F_mu", "N", exact.friction_force);
      for (std::size_t i = 0; i < printed.size(); ++i) {
        rows.row(i + 1, a.frequency_difference_hz[i], a.ratio_residual[i], a.phase_residual_truth[i],
                 a.phase_residual_alternative[i], exact.phase_residual_truth[i],
                 exact.phase_residual_alternative[i]);
      }
      write_audit(summary, "of the reading", a);
      write_audit(summary, "exact", exact);
    }
    io::commit_all(csv, rows, summary);
  });
}
