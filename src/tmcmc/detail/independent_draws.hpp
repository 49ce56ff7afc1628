/// \file
/// A posterior measured by independent draws: a search finds it, a density that was fitted to it is
/// frozen and drawn from (tmcmc::IndependentDraws).
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "tmcmc/reference_search.hpp"

namespace tmcmc::detail {

/// A posterior as weighted independent draws.
struct MeasuredPosterior {
  /// n x d.
  Population points;
  /// n.
  Eigen::VectorXd log_likelihood;
  /// n, with a mean of 1.
  Eigen::VectorXd weights;
  /// Log of the mean weight, with its error.
  Evidence evidence;
  /// (sum w)^2 / sum w^2.
  double effective_sample_size = 0.0;
  /// k-hat of the largest weights, see pareto_shape().
  double pareto_shape = 0.0;
  /// Separate modes that the searches have seen or the fit has; at least 2 where a search has ended
  /// below beta = 1, whose fits may have taken two modes for one.
  Index modes = 1;
  /// Effective draws that chose beta; where there are several modes, for each of them and one more.
  double draws_a_mode = 0.0;
  /// Draws of both searches.
  Index search_draws = 0;
  /// What the draws are from, in unbounded coordinates.
  ReferenceDensity reference;
  /// Temperature that each search has reached.
  std::array<double, 2> search_beta{};
  /// Posterior mass where each search has hardly drawn.
  std::array<double, 2> missed_mass{};
  /// Rounds of the first search, of its last pass.
  std::vector<StageRecord> rounds;
  /// The run that took over where the searches failed.
  std::optional<Result> tmcmc;
  /// Log-likelihoods in all.
  Index evaluations = 0;
  /// Of the searches and the weights; without those of the run that took over.
  std::vector<Warning> warnings;
};

/// Finds the posterior and measures it, as IndependentDraws says.
/// \param options  valid, with the finish IndependentDraws
/// \throws SamplingError as run().
[[nodiscard]] MeasuredPosterior measure_posterior(const Problem& problem, const Options& options,
                                                  const StreamKey& key);

}  // namespace tmcmc::detail
