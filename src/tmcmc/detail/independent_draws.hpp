/// \file
/// A posterior measured by independent draws: a search finds it, then a density that was fitted to
/// it is frozen and drawn from (tmcmc::IndependentDraws).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tmcmc/reference_search.hpp"

namespace tmcmc::detail {

/// A posterior represented by weighted independent draws.
struct MeasuredPosterior {
  /// Points, n x d.
  Population points;
  /// Log-likelihoods, n.
  Eigen::VectorXd log_likelihood;
  /// Weights, n, with a mean of 1.
  Eigen::VectorXd weights;
  /// Log of the mean weight, with its error.
  Evidence evidence;
  /// (sum w)^2 / sum w^2.
  double effective_sample_size = 0.0;
  /// k-hat of the largest weights, see pareto_shape().
  double pareto_shape = 0.0;
  /// Number of separate modes that the searches have found or that the fit has; at least 2 if a
  /// search has ended below beta = 1, since its fits may have merged two modes.
  Index modes = 1;
  /// Effective draws from which beta was chosen; with several modes, the number for each of them
  /// and one more.
  double draws_a_mode = 0.0;
  /// Number of draws of both searches.
  Index search_draws = 0;
  /// The density of the draws, in unbounded coordinates.
  ReferenceDensity reference;
  /// Temperature that each search has reached.
  std::array<double, 2> search_beta{};
  /// Posterior mass of the region in which each search has hardly any draws.
  std::array<double, 2> missed_mass{};
  /// Rounds of the last pass of the first search.
  std::vector<StageRecord> rounds;
  /// The run that took over if the searches failed.
  std::optional<Result> tmcmc;
  /// Total number of log-likelihoods.
  Index evaluations = 0;
  /// Warnings about the searches and the weights, without those of the run that took over.
  std::vector<Warning> warnings;
};

/// Finds the posterior and measures it, as described at IndependentDraws.
/// \param options  valid, with the finish IndependentDraws
/// \throws SamplingError as run().
[[nodiscard]] MeasuredPosterior measure_posterior(const Problem& problem, const Options& options,
                                                  const StreamKey& key);

}  // namespace tmcmc::detail
