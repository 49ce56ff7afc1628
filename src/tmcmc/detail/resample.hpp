/// \file
/// Resampling with memory that is used again.
#pragma once

#include <vector>

#include "tmcmc/resampling.hpp"

namespace tmcmc::detail {

/// Memory of resample(), to be reused from call to call.
struct ResamplingWorkspace {
  /// Of the weights.
  std::vector<double> partial_sums;
  /// Of the expected numbers of copies.
  std::vector<double> residuals;
  /// Ancestors of the multinomial part.
  std::vector<Index> drawn;
};

/// As tmcmc::resample().
/// \param threads  the result does not depend on it
void resample(Resampling scheme, ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
              std::span<Index> ancestors, ResamplingWorkspace& work, int threads = 1);

}  // namespace tmcmc::detail
