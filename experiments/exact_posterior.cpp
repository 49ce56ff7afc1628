// The exact posterior of Eq. 24 by quadrature, for any observations, prior and reading of the
// physics: no sampler and no Monte Carlo error. Beside it the Laplace approximation, least squares
// and, given what sampling_study wrote, how far each sampler is from the exact answer.
//
// Data: Tables 1 and 2 as printed in Lye and Marino (ESREL 2023), or the reader's own.

#include <algorithm>
#include <cmath>

#include "inputs.hpp"
#include "replication/posterior_tables.hpp"

using namespace experiments;

namespace {

void report_parameters(const Report& report, OptionalCsv& csv,
                       const std::vector<replication::ParameterEstimate>& estimates) {
  report("{:<22} {:>10} {:>10} {:>10} {:>10} {:>10} {:>22} {:>13}\n", "", "mean", "sd", "2.5 %", "median",
         "97.5 %", "Laplace mode +- sd", "least squares");
  for (std::size_t p = 0; p < estimates.size(); ++p) {
    const auto& e = estimates[p];
    const auto& q = e.quantiles;
    report("{:<22} {:>10.5f} {:>10.5f} {:>10.5f} {:>10.5f} {:>10.5f} {:>22} {:>13}\n", parameter_columns[p],
           e.mean, e.standard_deviation, q[0], q[2], q[4],
           fmt::format("{} +- {}", or_undefined("{:.5f}", e.laplace_mode),
                       or_undefined("{:.5f}", e.laplace_standard_deviation)),
           or_undefined("{:.5f}", e.least_squares));
    csv.row(parameter_columns[p], digits(e.mean), digits(e.standard_deviation), digits(q[0]), digits(q[1]),
            digits(q[2]), digits(q[3]), digits(q[4]), digits(e.laplace_mode, 8),
            digits(e.laplace_standard_deviation, 8), digits(e.least_squares, 8));
  }
}

void compare_samplers(const Report& report, OptionalCsv& csv, const replication::GroupedColumns& runs,
                      const estimation::ExactPosterior& posterior) {
  report("\n{:<10} {:<28} {:>10} {:>11} {:>10} {:>10} {:>6}\n", "sampler", "quantity", "exact", "bias", "+-",
         "spread", "ESS");
  for (const auto& e : replication::errors_of(runs, posterior)) {
    report("{:<10} {:<28} {:>10.5g} {:>+11.3g} {:>10.2g} {:>10.3g} {:>6}\n", e.sampler, e.quantity, e.exact,
           e.error.bias, e.error.standard_error, e.error.spread,
           std::isfinite(e.effective_size) ? fmt::format("{:.1f}", e.effective_size) : "");
    csv.row(e.sampler, e.quantity, e.runs, digits(e.exact), digits(e.error.mean), digits(e.error.bias),
            digits(e.error.standard_error), digits(e.error.spread), digits(e.error.root_mean_square),
            digits(e.effective_size));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Exact posterior (Eq. 24), and how far the samplers are from it.", "exact_posterior");
  Report report(app);
  ProblemInputs inputs;
  std::optional<double> threshold;
  long points = 401, bins = 50;
  std::string output, summary_output, runs_input, samplers_output, marginals_output, samples_input,
      histogram_output, pbox_output;
  auto* const of_runs = add_input(app, "--runs-input", runs_input, "--runs-output of sampling_study");
  auto* const of_samples = add_input(app, "--samples-input", samples_input, "--output of sampling_study");
  add_output(app, output,
             "CSV: one row for each parameter with moments and quantiles, Laplace and least squares");
  add_output(app, "--summary-output", summary_output,
             "CSV: quantity, value: log-evidence, its error, Laplace's, P(F_mu > threshold)");
  add_output(app, "--marginals-output", marginals_output, "CSV: parameter, x, density, cdf, laplace_density");
  add_output(app, "--samplers-output", samplers_output, "CSV: the errors of each sampler")->needs(of_runs);
  add_output(app, "--histogram-output", histogram_output, "CSV: pooled samples of each sampler")
      ->needs(of_samples);
  add_output(app, "--pbox-output", pbox_output,
             "CSV: p-boxes of each sampler beside the exact distribution function")
      ->needs(of_samples);
  app.add_option("--exceedance", threshold, "Threshold of P(F_mu > threshold), N; for Table 1 it is 1.086")
      ->transform(non_negative());
  app.add_option("--points", points, "Grid points of each marginal")->transform(count(2, 1000000));
  app.add_option("--bins", bins, "Bins of each histogram")->transform(count(1, 1000000));
  inputs.add_to(app);

  return report.run(argc, argv, [&] {
    replication::GroupedColumns runs, samples;
    if (!runs_input.empty()) runs = replication::read_estimates(runs_input);
    if (!samples_input.empty()) {
      samples =
          read_samples(io::CsvTable::read(samples_input), parameter_columns, "the samples of sampling_study");
    }
    const auto reading = inputs.physics.reading();
    const auto observations = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, reading);
    const auto posterior =
        exact_posterior_for(inputs, friction::Likelihood(observations, reading.physics), prior);
    const auto fit = estimation::fit_least_squares(observations, reading.physics);
    estimation::LaplaceApproximation laplace;
    if (prior.is_box()) {  // else the mode would not be that of the likelihood
      laplace = estimation::laplace_approximation(observations, reading.physics, fit,
                                                  bounds_of(prior, "the Laplace approximation"));
    }
    if (!threshold && is_table1(inputs.observations)) threshold = 1.086;  // that the paper states
    auto csv = open_csv(output, {"parameter", "mean", "sd", "q025", "q25", "q50", "q75", "q975",
                                 "laplace_mode", "laplace_sd", "least_squares"});
    auto summary = open_csv(summary_output, {"quantity", "value"});
    auto marginals = open_csv(marginals_output, {"parameter", "x", "density", "cdf", "laplace_density"});
    auto accuracies =
        open_csv(samplers_output, {"sampler", "quantity", "runs", "exact", "mean", "bias",
                                   "bias_standard_error", "spread", "rmse", "effective_sample_size"});
    auto histograms = open_csv(histogram_output, {"sampler", "parameter", "low", "high", "density"});
    auto pboxes = open_csv(pbox_output, {"sampler", "parameter", "x", "lower", "upper", "exact",
                                         "lower_less_exact", "upper_less_exact"});
    report("Exact posterior of {} ({} observations, reading {})\n", inputs.observations, observations.size(),
           inputs.physics.reading_name);
    report_parameters(report, csv, replication::parameter_estimates(posterior, laplace, fit));
    report("log-evidence {:.5f} (relative error of the evidence below {:.0e}); Laplace {}\n",
           posterior.log_evidence(), std::max(posterior.relative_error(), 1e-12),
           or_undefined("{:.3f}", laplace.log_evidence));
    if (!prior.is_box()) {
      report("The Laplace approximation is that of uniform priors, and least squares know no prior.\n");
    }
    for (const auto* block : {&fit.friction_force, &fit.natural_frequency}) {
      if (block->fitted_noise != estimation::FittedNoise::determined) {
        report("least squares of {}: the noise is undefined: {}\n",
               block == &fit.friction_force ? "F_mu" : "omega_n", describe(block->fitted_noise));
      }
    }
    summary.row("log_evidence", digits(posterior.log_evidence()));
    summary.row("log_evidence_error", digits(posterior.relative_error(), 1));
    summary.row("laplace_log_evidence", digits(laplace.log_evidence, 8));
    if (threshold) {
      const double exceedance = posterior.marginal(friction::friction_force).exceedance(*threshold);
      report("P(F_mu > {} N) = {:.4g}\n", *threshold, exceedance);
      summary.row("exceedance_threshold_n", *threshold);
      summary.row("exceedance_probability", digits(exceedance, 8));
    }
    if (!runs_input.empty()) {
      compare_samplers(report, accuracies, runs, posterior);
    }
    for (const auto& m : replication::marginal_points(posterior, laplace, points)) {
      marginals.row(parameter_columns[m.parameter], digits(m.x), digits(m.density), digits(m.cdf),
                    digits(m.laplace_density, 8));
    }
    for (const auto& bin : replication::sample_histograms(samples, posterior, bins)) {
      histograms.row(bin.sampler, parameter_columns[bin.parameter], digits(bin.low), digits(bin.high),
                     digits(bin.density));
    }
    for (const auto& b : replication::pbox_points(samples, posterior, points)) {
      pboxes.row(b.sampler, parameter_columns[b.parameter], digits(b.x), b.lower, b.upper, digits(b.exact),
                 digits(b.lower - b.exact), digits(b.upper - b.exact));
    }
    io::commit_all(csv, summary, marginals, accuracies, histograms, pboxes);
  });
}
