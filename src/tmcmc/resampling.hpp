/// \file
/// Resampling: which samples the chains of a stage start from.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "tmcmc/random.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// Each scheme gives sample i an expected number of n w_i / sum(w) copies among n; they differ in
/// the spread about it (Douc, Cappe and Moulines 2005).
enum class Resampling {
  /// n independent draws (Ching and Chen 2007).
  multinomial,
  /// The whole part of the expected number of copies, the rest multinomial.
  residual,
  /// One draw from each n-th of the total weight.
  stratified,
  /// The same with one uniform number for all; the least spread.
  systematic
};
constexpr std::array<std::string_view, 4> enumerator_names(std::type_identity<Resampling>) {
  return {"multinomial", "residual", "stratified", "systematic"};
}

/// Ancestors of `ancestors.size()` draws, in ascending order; their number need not be that of the
/// weights. Linear time.
/// \param weights  non-negative, with a positive sum
/// \param stage    enters the random stream
void resample(Resampling scheme, ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
              std::span<Index> ancestors);

}  // namespace tmcmc
