/// \file
/// Resampling with reusable work space.
#pragma once

#include <vector>

#include "tmcmc/resampling.hpp"

namespace tmcmc::detail {

/// Work space of resample(), reused from call to call.
struct ResamplingWorkspace {
  /// Partial sums of the weights.
  std::vector<double> partial_sums;
  /// Residuals of the expected numbers of copies.
  std::vector<double> residuals;
  /// Ancestors of the multinomial part.
  std::vector<Index> drawn;
};

/// As tmcmc::resample(), with work space.
/// \param threads  number of threads; the result does not depend on it
void resample(Resampling scheme, ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
              std::span<Index> ancestors, ResamplingWorkspace& work, int threads = 1);

}  // namespace tmcmc::detail
