/// \file
/// Nearest neighbours in a cloud of points, and coordinates in which they lie in all directions alike.
#pragma once

#include <vector>

#include "tmcmc/types.hpp"

namespace tmcmc::detail {

/// Each point's nearest neighbours.
struct Neighbours {
  /// Of each point, ascending indices.
  std::vector<std::vector<Index>> of;
  /// Distance to the last of them.
  std::vector<double> reach;
};

/// Squared distances of point i to all; `squared` has a place for each point.
void distances_from(const Population& white, Index i, std::vector<double>& squared);

/// \param white  n x d; `count` below n. Of points at the same distance those of the least index.
[[nodiscard]] Neighbours neighbours_of(const Population& white, Index count);

/// The points times the inverse of a lower triangular factor, n x d; 0 where its diagonal is.
[[nodiscard]] Population whitened(const Population& points, const Eigen::MatrixXd& factor);

/// Coordinates in which neighbours lie in all directions at like distances: the scatter within modes is
/// isotropic, however far these are from each other (Art, Gnanadesikan and Kettenring 1982).
[[nodiscard]] Population with_isotropic_neighbours(const Population& white, const Neighbours& neighbours);

}  // namespace tmcmc::detail
