/// \file
/// Resampling with memory that is used again.
#pragma once

#include <vector>

#include "tmcmc/resampling.hpp"

namespace tmcmc::detail {

/// Memory of resample(), to be reused from call to call.
struct ResamplingWorkspace {
  std::vector<double> partial_sums;  ///< of the weights
  std::vector<double> residuals;     ///< of the expected numbers of copies
  std::vector<Index> drawn;          ///< ancestors of the multinomial part
};

/// As tmcmc::resample().
/// \param threads  the result does not depend on it
void resample(Resampling scheme, ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
              std::span<Index> ancestors, ResamplingWorkspace& work, int threads = 1);

}  // namespace tmcmc::detail
