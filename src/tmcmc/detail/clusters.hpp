/// \file
/// Clusters of weighted points, from which the fit of a mixture starts.
#pragma once

#include <vector>

#include "tmcmc/random.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc::detail {

/// The number of the cluster of each point: weighted k-means++ (Arthur and Vassilvitskii 2007),
/// then a few of Lloyd's iterations.
/// \param white  n x d, in coordinates in which distances are meaningful
/// \param weights  n, not negative, not all zero
/// \param components  largest number of clusters; some may be empty
/// \param stage  stage of the random stream of Purpose::reference
[[nodiscard]] std::vector<Index> clusters(const Population& white, const Eigen::VectorXd& weights,
                                          Index components, const StreamKey& key, std::uint32_t stage);

}  // namespace tmcmc::detail
