/// \file
/// Fit of a mixture of Student t distributions to weighted points.
#pragma once

#include <functional>

#include "tmcmc/student_mixture.hpp"

namespace tmcmc {

/// Points to which a mixture is fitted.
struct WeightedPoints {
  /// n x d.
  Population points;
  /// n, not negative; their sum is the equivalent number of independent points.
  Eigen::VectorXd weights;
  /// Of each point: dependent points (states of one chain) have the same group.
  std::vector<Index> groups;
};

/// Limits of a fit.
struct MixtureFitOptions {
  /// nu, even.
  int degrees_of_freedom = 8;
  /// The numbers 1, 2, 4, ... up to this one are tried.
  Index most_components = 16;
  /// Iterations of the EM algorithm.
  int most_iterations = 8;
  /// A smaller gain of the mean log-density ends the iteration.
  double tolerance = 3e-3;
  /// Smallest gain of the held-out mean log-density for which more components are used.
  double gain_of_component = 0.005;
};

/// Maximum-likelihood fit of `components` components by expectation-maximisation with the parameter
/// expansion of Kent, Tyler and Vardi (1994; Peel and McLachlan 2000 for mixtures), starting from
/// the clusters of the points (k-means++: Arthur and Vassilvitskii 2007) in coordinates whitened by
/// the covariance of all points. With W_k the weight of the points assigned to component k,
///
///     S_k <- (1 - l_k) S_k + l_k sum_j W_j S_j / sum_j W_j,   l_k = (d+1) / (d+1 + W_k),
///
/// keeps components with few points from collapsing; a component with less than 2 + d/4 points is
/// removed. The number of components can thus decrease.
/// \param stage  stage of the random stream of Purpose::reference
/// \param look   called before each iteration, if not empty; see Problem::look
/// \throws SamplingError if no weight is positive; any exception of look
[[nodiscard]] StudentMixture fit_mixture(const WeightedPoints& data, Index components,
                                         const MixtureFitOptions& options, const StreamKey& key,
                                         std::uint32_t stage, const std::function<void()>& look = {});

/// As fit_mixture above, starting from known components, such as those of a fit to some of the
/// points. Their number does not grow.
[[nodiscard]] StudentMixture improve_mixture(const WeightedPoints& data, StudentMixture start,
                                             const MixtureFitOptions& options,
                                             const std::function<void()>& look = {});

/// As fit_mixture above, with the number of components that has the largest mean log-density on
/// held-out points: the groups with even numbers are fitted and those with odd numbers scored, and
/// vice versa. A larger number of components must gain at least d over the sum of the weights,
/// since the score of few points is noisy, and each half must hold 2 + d/2 points for each
/// component.
[[nodiscard]] StudentMixture fit_mixture(const WeightedPoints& data, const MixtureFitOptions& options,
                                         const StreamKey& key, std::uint32_t stage,
                                         const std::function<void()>& look = {});

}  // namespace tmcmc
