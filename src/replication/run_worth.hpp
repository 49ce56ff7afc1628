/// \file
/// The worth of a run: its posterior mean compared with that of independent draws, and iterations
/// compared with errors.
#pragma once

#include <span>
#include <vector>

#include "replication/replication.hpp"
#include "replication/verdict.hpp"

namespace replication {

/// A number with its standard error.
struct Estimate {
  /// The estimate.
  double value = 0.0;
  /// Standard error of the estimate, from the spread over studies.
  double standard_error = 0.0;
};

/// Number of independent draws from the exact posterior whose mean has the same mean-square error
/// as a run's posterior mean: exact variance over mean-square error, bias included, over all runs
/// of the studies.
/// \param runs  number of runs per study, at least 2
/// \param parameter  index into StudySummary::means
/// \param exact_mean, exact_sd  mean and standard deviation of the exact posterior, in the unit of
///        the parameter
/// \throws errors::InvalidValue for fewer than two studies or runs.
[[nodiscard]] Estimate independent_draws_worth(const std::vector<StudySummary>& studies, long runs,
                                               std::size_t parameter, double exact_mean, double exact_sd);

/// Difference of the mean numbers of iterations of two samplers, second minus first.
/// \throws errors::InvalidValue for fewer than two studies of either sampler.
[[nodiscard]] Estimate difference_of_iterations(const std::vector<StudySummary>& first,
                                                const std::vector<StudySummary>& second);

/// Spearman's rank correlation; ties get their mean rank. NaN where all x or all y are equal.
struct RankCorrelation {
  /// Rank correlation, in [-1, 1].
  double rho = 0.0;
  /// Two-sided, Student's t of rho sqrt((n - 2)/(1 - rho^2)) with n - 2 degrees of freedom.
  double p = 1.0;
};

/// \throws errors::InvalidValue unless there are as many x as y, at least 3.
[[nodiscard]] RankCorrelation rank_correlation(std::span<const double> x, std::span<const double> y);

/// Probability that a study of `runs` runs contains no run with at least so many iterations,
/// computed from the share of such runs among all runs of the studies; the standard error is the
/// binomial one of the share, by the delta method.
[[nodiscard]] PValue probability_of_none(const std::vector<StudySummary>& studies, tmcmc::Index iterations,
                                         long runs);

}  // namespace replication
