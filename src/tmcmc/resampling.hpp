/// \file
/// Resampling: which samples the chains of a stage start from.
#pragma once

#include <vector>

#include "tmcmc/random.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// Each scheme gives sample i an expected number of n w_i / sum(w) copies among n; they differ in the spread about it
/// (Douc, Cappe and Moulines 2005).
enum class Resampling {
  multinomial,  ///< n independent draws (Ching and Chen 2007)
  residual,     ///< the whole part of the expected number of copies, the rest multinomial
  stratified,   ///< one draw from each n-th of the total weight
  systematic    ///< the same with one uniform number for all; the least spread
};

/// Memory of resample(), to be reused from call to call.
struct ResamplingWorkspace {
  std::vector<double> partial_sums;  ///< of the weights
  std::vector<double> residuals;     ///< of the expected numbers of copies
  std::vector<Index> drawn;          ///< ancestors of the multinomial part
};

/// Ancestors of `ancestors.size()` draws, in ascending order; their number need not be that of the weights. Linear time.
/// \param weights  non-negative, with a positive sum
/// \param threads  the result does not depend on it
void resample(Resampling scheme, ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
              std::span<Index> ancestors, ResamplingWorkspace& work, int threads = 1);
/// The same with work space of its own.
void resample(Resampling scheme, ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
              std::span<Index> ancestors);

}  // namespace tmcmc
