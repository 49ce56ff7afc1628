/// \file
/// What own_model reports of its runs.
#pragma once

#include <string>
#include <vector>

#include "own_models.hpp"
#include "run.hpp"
#include "tmcmc/sampler.hpp"

namespace examples {

/// A parameter in the posterior of all runs, each of which counts the same.
struct ParameterSummary {
  std::string name;                    ///< of the parameter
  std::string unit;                    ///< empty for none
  double mean = 0.0;                   ///< in its unit
  double sd = 0.0;                     ///< likewise
  double quantile_5 = 0.0;             ///< 5 % of the posterior lie below
  double median = 0.0;                 ///< 50 %
  double quantile_95 = 0.0;            ///< 95 %
  double effective_sample_size = 0.0;  ///< sum over the runs
  double r_hat =
      0.0;  ///< Gelman and Rubin (1992), runs as chains and effective samples as draws; NaN for one run
};

/// One for each parameter.
/// \param runs  at least one, all completed
[[nodiscard]] std::vector<ParameterSummary> summarise(const std::vector<tmcmc::Result>& runs,
                                                      const tmcmc::Prior& prior);

/// The log-evidence of all runs: the mean, and its standard error from the errors of the runs or from the scatter between them,
/// whichever is larger.
[[nodiscard]] tmcmc::Evidence mean_evidence(const std::vector<tmcmc::Result>& runs);

/// Prints the table, the log-evidence and the warnings.
void print_summary(const experiments::Report& report, const std::vector<ParameterSummary>& summary,
                   const std::vector<tmcmc::Result>& runs);

/// Columns of the CSV file of the summary, and its rows.
[[nodiscard]] const std::vector<std::string>& summary_columns();
void write_summary(experiments::OptionalCsv& csv, const std::vector<ParameterSummary>& summary);

/// Columns of the CSV file of the samples: the run if there are several, parameters, log-likelihood.
[[nodiscard]] std::vector<std::string> sample_columns(const tmcmc::Prior& prior, long runs);
/// Its rows, of equal weight: of weighted samples as many as they are worth, evenly spaced in the sum of the weights.
void write_samples(experiments::OptionalCsv& csv, const std::vector<tmcmc::Result>& runs);

/// Samples, stages and observations in the layout of ArviZ, runs as chains of the length of the shortest, with equal
/// weights as in the CSV file.
[[nodiscard]] storage::InferenceData inference_data(const std::vector<tmcmc::Result>& runs,
                                                    const Model& model, std::uint64_t seed);

}  // namespace examples
