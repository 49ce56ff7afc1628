/// \file
/// What independent runs of the sampler say together of a posterior.
#pragma once

#include <string>
#include <vector>

#include "tmcmc/prior.hpp"
#include "tmcmc/result.hpp"

namespace statistics {

/// A parameter in the posterior of all runs, each of which counts the same.
struct ParameterSummary {
  /// Of the parameter.
  std::string name;
  /// Empty for none.
  std::string unit;
  /// In its unit, as are the next four.
  double mean = 0.0;
  /// Standard deviation.
  double sd = 0.0;
  /// Linear between the middles of the steps of the weighted distribution function.
  double quantile_5 = 0.0, median = 0.0, quantile_95 = 0.0;
  /// Sum over the runs.
  double effective_sample_size = 0.0;
  /// Gelman and Rubin (1992), with runs as chains and effective samples as draws; NaN for one run.
  double r_hat = 0.0;
};

/// One for each parameter.
/// \param runs  at least one, all completed, with diagnostics
[[nodiscard]] std::vector<ParameterSummary> summarise(const std::vector<tmcmc::Result>& runs,
                                                      const tmcmc::Prior& prior);

/// The log-evidence of all runs: their mean, and its standard error from the errors of the runs or from the scatter between
/// them, whichever is larger.
[[nodiscard]] tmcmc::Evidence mean_evidence(const std::vector<tmcmc::Result>& runs);

/// Rows of a run that stand for its posterior with equal weights: evenly spaced in the sum of the weights, ascending.
/// \param draws  at least 1
[[nodiscard]] std::vector<tmcmc::Index> equal_rows(const tmcmc::Result& run, tmcmc::Index draws);

/// The number of equally weighted draws that the samples of a run are worth: all if the weights are equal.
[[nodiscard]] tmcmc::Index equal_draws(const tmcmc::Result& run);

}  // namespace statistics
