/// \file
/// Fit of a mixture of Student t distributions to weighted points.
#pragma once

#include <functional>

#include "tmcmc/student_mixture.hpp"

namespace tmcmc {

/// Points to fit to.
struct WeightedPoints {
  Population points;  ///< n x d
  Eigen::VectorXd
      weights;  ///< n, not negative; their sum is the number of independent points that they stand for
  std::vector<Index> groups;  ///< of each point: dependent points (states of one chain) have the same group
};

/// Limits of a fit.
struct MixtureFitOptions {
  int degrees_of_freedom = 8;  ///< nu, even
  Index most_components = 16;  ///< the numbers 1, 2, 4, ... up to this are tried
  int most_iterations = 8;     ///< of the EM algorithm
  double tolerance = 3e-3;     ///< of the mean log-density: a smaller gain ends the iteration
  double gain_of_component =
      0.005;  ///< least gain of the held-out mean log-density for which more components are taken
};

/// Maximum-likelihood fit of `components` components by expectation-maximisation with the parameter expansion of Kent, Tyler
/// and Vardi (1994; Peel and McLachlan 2000 for mixtures), from the clusters of the points (k-means++: Arthur and Vassilvitskii
/// 2007) in coordinates whitened by the covariance of all points. With W_k the weight of the points that component k takes,
///
///     S_k <- (1 - l_k) S_k + l_k sum_j W_j S_j / sum_j W_j,   l_k = (d+1) / (d+1 + W_k),
///
/// keeps components of few points from collapsing; one that takes less than 2 + d/4 points goes. Components can so become fewer.
/// \param stage  of Purpose::reference
/// \param look   called before each iteration, if not empty; see Problem::look
/// \throws SamplingError if no weight is positive; what look throws
[[nodiscard]] StudentMixture fit_mixture(const WeightedPoints& data, Index components,
                                         const MixtureFitOptions& options, const StreamKey& key,
                                         std::uint32_t stage, const std::function<void()>& look = {});

/// The same from components that are known about, such as those of a fit to some of the points. Their number does not grow.
[[nodiscard]] StudentMixture improve_mixture(const WeightedPoints& data, StudentMixture start,
                                             const MixtureFitOptions& options,
                                             const std::function<void()>& look = {});

/// The same with the number of components that has the largest mean log-density on points that it was not fitted to:
/// the groups of even number are fitted and the odd ones scored, and the other way round. More components have to gain d over the
/// sum of the weights at least, since the score of few points is noisy, and each half needs 2 + d/2 points for each of them.
[[nodiscard]] StudentMixture fit_mixture(const WeightedPoints& data, const MixtureFitOptions& options,
                                         const StreamKey& key, std::uint32_t stage,
                                         const std::function<void()>& look = {});

}  // namespace tmcmc
