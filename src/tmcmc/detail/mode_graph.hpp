/// \file
/// Parts of a cloud of points with next to no points between them.
#pragma once

#include <vector>

#include "tmcmc/modes.hpp"

namespace tmcmc::detail {

/// Points and what each stands for.
struct WeightedPoints {
  Population white;  ///< n x d, different from each other, in coordinates in which distances mean something
  std::vector<double> weights;  ///< n, positive, with the sum 1
};

/// The part of each point, numbered from 0, as find_modes() tells them apart.
[[nodiscard]] std::vector<Index> separate_parts(WeightedPoints points, const ModeOptions& options);

}  // namespace tmcmc::detail
