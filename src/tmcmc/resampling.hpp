/// \file
/// Multinomial resampling.
#pragma once

#include <vector>

#include "tmcmc/random.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// Ancestors of `ancestors.size()` independent draws with probabilities proportional to the weights, in
/// ascending order. The sorted uniforms are partial sums of exponential spacings, so that the time is linear.
/// \param weights  non-negative, with a positive sum
/// \param partial_sums  work space, to be reused from call to call
/// \param threads  the result does not depend on it
void multinomial_ancestors(ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
                           std::span<Index> ancestors, std::vector<double>& partial_sums, int threads = 1);
void multinomial_ancestors(ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
                           std::span<Index> ancestors);

}  // namespace tmcmc
