// The exact posterior of Eq. 24 by quadrature, for any observations, prior and reading of the physics: no sampler and no
// Monte Carlo error. Beside it the Laplace approximation and least squares; and, given what sampling_study wrote, how far
// each sampler is from the exact answer (bias, spread over the runs, effective sample size, log-evidence).
//
// Data: Table 1 and the prior of Table 2 as printed in Lye and Marino (ESREL 2023), or the reader's own.

#include <algorithm>
#include <cmath>

#include "estimation/laplace.hpp"
#include "inputs.hpp"
#include "portable_math/elementary.hpp"

using namespace experiments;

namespace {

constexpr std::array<double, 5> quantile_levels = {0.025, 0.25, 0.5, 0.75, 0.975};

const estimation::TabulatedDensity& marginal(const estimation::ExactPosterior& posterior, std::size_t p) {
  return posterior.marginal(static_cast<friction::Parameter>(p));
}

/// What the estimates of independent runs are off, against the exact value.
struct Accuracy {
  double mean, bias, standard_error, spread, rmse;
};

Accuracy accuracy(const std::vector<double>& estimates, double exact) {
  const auto n = static_cast<double>(estimates.size());
  const auto m = replication::moments(estimates);
  const double spread = estimates.size() > 1 ? m.standard_deviation : std::nan("");
  double squares = 0.0;
  for (const double x : estimates) {
    squares += (x - exact) * (x - exact);
  }
  return {m.mean, m.mean - exact, spread / std::sqrt(n), spread, std::sqrt(squares / n)};
}

/// Columns by name; read before anything is written.
struct Columns {
  GroupedColumns file;
  std::vector<std::size_t> places;  ///< of the names asked for

  Columns(const std::string& path, const std::vector<std::string>& names, const char* expected,
          void (*check)(const io::CsvTable&) = nullptr) {
    if (path.empty()) {
      return;
    }
    const auto table = io::CsvTable::read(path);
    file = read_samples(table);
    for (const auto& name : names) {
      const auto found = std::find(file.columns.begin(), file.columns.end(), name);
      if (found == file.columns.end()) {
        throw io::InputError(fmt::format("{}: no column '{}': expected {}", path, name, expected));
      }
      places.push_back(static_cast<std::size_t>(found - file.columns.begin()));
    }
    if (check != nullptr) {
      check(table);
    }
  }
};

/// One row a run, and no negative standard deviation.
void require_runs(const io::CsvTable& table) {
  require_runs_once(table);
  for (const auto& name : parameter_columns) {
    static_cast<void>(nonnegative_numbers(table, "sd_" + name));
  }
}

/// What the runs estimate: mean and standard deviation of each parameter, log-evidence.
std::vector<std::string> estimated_quantities() {
  std::vector<std::string> names;
  for (const auto& parameter : parameter_columns) {
    names.push_back("mean_" + parameter);
    names.push_back("sd_" + parameter);
  }
  names.emplace_back("log_evidence");
  return names;
}

void compare_samplers(const Program& program, std::optional<io::CsvWriter>& csv, const Columns& runs,
                      const estimation::ExactPosterior& posterior) {
  const auto names = estimated_quantities();
  program.report("\n{:<10} {:<28} {:>10} {:>11} {:>10} {:>10} {:>6}\n", "sampler", "quantity", "exact",
                 "bias", "+-", "spread", "ESS");
  for (std::size_t s = 0; s < runs.file.samplers.size(); ++s) {
    for (std::size_t q = 0; q < names.size(); ++q) {
      const bool evidence = q + 1 == names.size();
      const bool mean = !evidence && q % 2 == 0;
      const auto& density = marginal(posterior, evidence ? 0 : q / 2);
      const double sd = density.standard_deviation();
      const double exact = evidence ? posterior.log_evidence() : mean ? density.mean() : sd;
      std::vector<double> estimates;
      for (const auto& run : runs.file.values[s][runs.places[q]]) {
        estimates.push_back(run.front());
      }
      const Accuracy a = accuracy(estimates, exact);
      const double size = mean ? sd * sd / (a.spread * a.spread) : std::nan("");
      program.report("{:<10} {:<28} {:>10.5g} {:>+11.3g} {:>10.2g} {:>10.3g} {:>6}\n", runs.file.samplers[s],
                     names[q], exact, a.bias, a.standard_error, a.spread,
                     std::isfinite(size) ? fmt::format("{:.1f}", size) : "");
      if (csv) {
        csv->row(runs.file.samplers[s], names[q], estimates.size(), digits(exact), digits(a.mean),
                 digits(a.bias), digits(a.standard_error), digits(a.spread), digits(a.rmse), digits(size));
      }
    }
  }
}

/// From where to where the marginal is drawn: all but 2e-4 of its probability.
estimation::Interval drawn_range(const estimation::TabulatedDensity& exact) {
  return {exact.quantile(1e-4), exact.quantile(1.0 - 1e-4)};
}

void write_marginals(io::CsvWriter& csv, long points, const estimation::ExactPosterior& posterior,
                     const estimation::LaplaceApproximation& laplace) {
  for (std::size_t p = 0; p < parameter_columns.size(); ++p) {
    const auto& exact = marginal(posterior, p);
    const auto range = drawn_range(exact);
    const double sd = laplace.standard_deviation[p];
    for (long i = 0; i < points; ++i) {
      const double x = range.lower + range.width() * static_cast<double>(i) / static_cast<double>(points - 1);
      const double z = (x - laplace.mode[p]) / sd;
      const double normal = portable_math::exp(-0.5 * z * z) / (sd * std::sqrt(2.0 * std::numbers::pi));
      csv.row(parameter_columns[p], digits(x), digits(exact.density(x)), digits(exact.cdf(x)),
              digits(normal, 8));
    }
  }
}

void write_histograms(io::CsvWriter& csv, const Columns& samples, long bins,
                      const estimation::ExactPosterior& posterior) {
  for (std::size_t s = 0; s < samples.file.samplers.size(); ++s) {
    for (std::size_t p = 0; p < parameter_columns.size(); ++p) {
      const auto range = drawn_range(marginal(posterior, p));
      const double width = range.width() / static_cast<double>(bins);
      std::vector<long> counts(static_cast<std::size_t>(bins));
      long total = 0;
      for (const auto& run : samples.file.values[s][samples.places[p]]) {
        for (const double x : run) {
          const double bin = std::floor((x - range.lower) / width);
          if (bin >= 0.0 && bin < static_cast<double>(bins)) {
            ++counts[static_cast<std::size_t>(bin)];
          }
          ++total;
        }
      }
      for (std::size_t b = 0; b < counts.size(); ++b) {
        const double low = range.lower + width * static_cast<double>(b);
        csv.row(samples.file.samplers[s], parameter_columns[p], digits(low), digits(low + width),
                digits(static_cast<double>(counts[b]) / (static_cast<double>(total) * width)));
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  Program program("exact_posterior",
                  "Exact posterior (Eq. 24) by quadrature, and how far the samplers are from it.");
  InputFiles inputs;
  PhysicsOptions physics;
  double threshold = 1.086;
  long points = 401, bins = 50;
  std::string summary_output, runs_input, samplers_output, marginals_output, samples_input, histogram_output;
  program.add_output("CSV: one row a parameter with moments and quantiles, Laplace and least squares");
  program.add_file_output("--summary-output", summary_output,
                          "CSV: quantity, value: log-evidence, its error, Laplace's, P(F_mu > threshold)");
  program.add_file_output("--marginals-output", marginals_output,
                          "CSV: parameter, x, density, cdf, laplace_density");
  program.add_file_output("--samplers-output", samplers_output,
                          "CSV: what each sampler is off (needs --runs-input)");
  program.add_file_output("--histogram-output", histogram_output,
                          "CSV: pooled samples of each sampler (needs --samples-input)");
  program.add_input("--runs-input", runs_input,
                    "Runs of a study: what sampling_study writes to --runs-output");
  program.add_input("--samples-input", samples_input,
                    "Samples of a study: what sampling_study writes to --output");
  program.add_number("--exceedance", threshold, non_negative(),
                     "Friction force whose probability to be exceeded is wanted, N");
  program.add_number("--points", points, count(2, 1000000), "Grid points of each marginal");
  program.add_number("--bins", bins, count(1, 1000000), "Bins of each histogram");
  inputs.add_observations_to(program);
  inputs.add_prior_to(program);
  physics.add_to(program);

  return program.run(argc, argv, [&] {
    if (!samplers_output.empty() && runs_input.empty()) {
      throw io::InputError("--samplers-output: expected --runs-input with the runs to compare");
    }
    if (!histogram_output.empty() && samples_input.empty()) {
      throw io::InputError("--histogram-output: expected --samples-input with the samples to count");
    }
    const Columns runs(runs_input, estimated_quantities(), "the runs of sampling_study", require_runs);
    const Columns samples(samples_input, parameter_columns, "the samples of sampling_study");
    const auto reading = physics.reading();
    const auto observations = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, reading);
    const auto posterior =
        exact_posterior_for(inputs, friction::Likelihood(observations, reading.physics), prior);
    const auto fit = estimation::fit_least_squares(observations, reading.physics);
    const auto laplace =
        estimation::laplace_approximation(observations, reading.physics, fit, bounds_of(prior));
    const std::array<double, friction::parameter_count> least_squares = {
        fit.friction_force.estimate, fit.natural_frequency.estimate, fit.friction_force.noise_ml,
        fit.natural_frequency.noise_ml};
    const double error = posterior.relative_error();
    const double exceedance = posterior.marginal(friction::friction_force).exceedance(threshold);

    auto csv = open_csv(program.output(), {"parameter", "mean", "sd", "q025", "q25", "q50", "q75", "q975",
                                           "laplace_mode", "laplace_sd", "least_squares"});
    auto summary = open_csv(summary_output, {"quantity", "value"});
    auto marginals = open_csv(marginals_output, {"parameter", "x", "density", "cdf", "laplace_density"});
    auto accuracies =
        open_csv(samplers_output, {"sampler", "quantity", "runs", "exact", "mean", "bias",
                                   "bias_standard_error", "spread", "rmse", "effective_sample_size"});
    auto histograms = open_csv(histogram_output, {"sampler", "parameter", "low", "high", "density"});

    program.report("Exact posterior of {} ({} observations, reading {})\n", inputs.observations,
                   observations.size(), physics.reading_name);
    program.report("{:<22} {:>10} {:>10} {:>10} {:>10} {:>10} {:>22} {:>13}\n", "", "mean", "sd", "2.5 %",
                   "median", "97.5 %", "Laplace mode +- sd", "least squares");
    for (std::size_t p = 0; p < parameter_columns.size(); ++p) {
      const auto& exact = marginal(posterior, p);
      std::vector<std::string> quantiles(quantile_levels.size());
      std::transform(quantile_levels.begin(), quantile_levels.end(), quantiles.begin(),
                     [&](double level) { return digits(exact.quantile(level)); });
      program.report("{:<22} {:>10.5f} {:>10.5f} {:>10.5f} {:>10.5f} {:>10.5f} {:>22} {:>13}\n",
                     parameter_columns[p], exact.mean(), exact.standard_deviation(), exact.quantile(0.025),
                     exact.quantile(0.5), exact.quantile(0.975),
                     fmt::format("{} +- {}", or_undefined("{:.5f}", laplace.mode[p]),
                                 or_undefined("{:.5f}", laplace.standard_deviation[p])),
                     or_undefined("{:.5f}", least_squares[p]));
      if (csv) {
        csv->row(parameter_columns[p], digits(exact.mean()), digits(exact.standard_deviation()), quantiles,
                 digits(laplace.mode[p], 8), digits(laplace.standard_deviation[p], 8),
                 digits(least_squares[p], 8));
      }
    }
    program.report("log-evidence {:.5f} (relative error of the evidence below {:.0e}); Laplace {}\n",
                   posterior.log_evidence(), std::max(error, 1e-12),
                   or_undefined("{:.3f}", laplace.log_evidence));
    for (const auto* block : {&fit.friction_force, &fit.natural_frequency}) {
      if (block->fitted_noise != estimation::FittedNoise::determined) {
        program.report("least squares of {}: the noise is undefined: {}\n",
                       block == &fit.friction_force ? "F_mu" : "omega_n", describe(block->fitted_noise));
      }
    }
    program.report("P(F_mu > {} N) = {:.4g}\n", threshold, exceedance);
    if (summary) {
      summary->row("log_evidence", digits(posterior.log_evidence()));
      summary->row("log_evidence_error", digits(error, 1));
      summary->row("laplace_log_evidence", digits(laplace.log_evidence, 8));
      summary->row("exceedance_threshold_n", threshold);
      summary->row("exceedance_probability", digits(exceedance, 8));
    }
    if (!runs_input.empty()) {
      compare_samplers(program, accuracies, runs, posterior);
    }
    if (marginals) {
      write_marginals(*marginals, points, posterior, laplace);
    }
    if (histograms) {
      write_histograms(*histograms, samples, bins, posterior);
    }
    io::commit_all(csv, summary, marginals, accuracies, histograms);
  });
}
