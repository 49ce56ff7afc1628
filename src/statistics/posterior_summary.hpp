/// \file
/// Joint summary of a posterior from independent runs of the sampler.
#pragma once

#include <string>
#include <vector>

#include "tmcmc/prior.hpp"
#include "tmcmc/result.hpp"

namespace statistics {

/// Summary of one parameter in the posterior of all runs, each of which has the same weight.
struct ParameterSummary {
  /// Name of the parameter.
  std::string name;
  /// Unit of the parameter; empty for none.
  std::string unit;
  /// Posterior mean, in the unit of the parameter, as are the next four members.
  double mean = 0.0;
  /// Posterior standard deviation.
  double sd = 0.0;
  /// Quantiles, linearly interpolated between the middles of the steps of the weighted distribution
  /// function.
  double quantile_5 = 0.0, median = 0.0, quantile_95 = 0.0;
  /// Effective sample size, summed over the runs.
  double effective_sample_size = 0.0;
  /// R-hat of Gelman and Rubin (1992), with runs as chains and effective samples as draws; NaN for
  /// one run.
  double r_hat = 0.0;
};

/// One summary per parameter.
/// \param runs  at least one, all completed, with diagnostics
[[nodiscard]] std::vector<ParameterSummary> summarise(const std::vector<tmcmc::Result>& runs,
                                                      const tmcmc::Prior& prior);

/// The log-evidence from all runs: their mean, with a standard error from the errors of the runs or
/// from the scatter between the runs, whichever is larger.
[[nodiscard]] tmcmc::Evidence mean_evidence(const std::vector<tmcmc::Result>& runs);

/// Rows of a run that represent its posterior with equal weights: evenly spaced in the cumulative
/// weight, ascending.
/// \param draws  at least 1
[[nodiscard]] std::vector<tmcmc::Index> equal_rows(const tmcmc::Result& run, tmcmc::Index draws);

/// The number of equally weighted draws to which the samples of a run are equivalent: all of them
/// if the weights are equal.
[[nodiscard]] tmcmc::Index equal_draws(const tmcmc::Result& run);

}  // namespace statistics
