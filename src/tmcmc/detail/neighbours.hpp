/// \file
/// Nearest neighbours in a cloud of points, and coordinates in which they are distributed alike in
/// all directions.
#pragma once

#include <vector>

#include "tmcmc/types.hpp"

namespace tmcmc::detail {

/// Each point's nearest neighbours.
struct Neighbours {
  /// Neighbours of each point, in ascending order of index.
  std::vector<std::vector<Index>> of;
  /// Distance from each point to its last neighbour.
  std::vector<double> reach;
};

/// Squared distances of point i to all points; `squared` has an entry for each point.
void distances_from(const Population& white, Index i, std::vector<double>& squared);

/// The `count` nearest neighbours of each point; of points at the same distance those with the
/// smallest index.
/// \param white  n x d; `count` must be below n
[[nodiscard]] Neighbours neighbours_of(const Population& white, Index count);

/// The points times the inverse of a lower triangular factor, n x d; 0 where its diagonal is 0.
[[nodiscard]] Population whitened(const Population& points, const Eigen::MatrixXd& factor);

/// Coordinates in which neighbours lie at similar distances in all directions: the scatter within
/// modes is isotropic, however far apart the modes are (Art, Gnanadesikan and Kettenring 1982).
[[nodiscard]] Population with_isotropic_neighbours(const Population& white, const Neighbours& neighbours);

}  // namespace tmcmc::detail
