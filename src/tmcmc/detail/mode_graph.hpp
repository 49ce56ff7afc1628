/// \file
/// Parts of a cloud of points with practically no points between them.
#pragma once

#include <vector>

#include "tmcmc/modes.hpp"

namespace tmcmc::detail {

/// Points and their weights.
struct WeightedPoints {
  /// n x d, distinct, in coordinates in which distances are meaningful.
  Population white;
  /// n, positive, with the sum 1.
  std::vector<double> weights;
};

/// The part to which each point belongs, numbered from 0, as find_modes() separates them.
[[nodiscard]] std::vector<Index> separate_parts(WeightedPoints points, const ModeOptions& options);

}  // namespace tmcmc::detail
