/// \file
/// Resampling: selects the samples from which the chains of a stage start.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "tmcmc/random.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// Each scheme gives sample i an expected number of n w_i / sum(w) copies among n; the schemes
/// differ in the variance of this number (Douc, Cappe and Moulines 2005).
enum class Resampling {
  /// n independent draws (Ching and Chen 2007).
  multinomial,
  /// The whole part of the expected number of copies; the rest is multinomial.
  residual,
  /// One draw from each n-th part of the total weight.
  stratified,
  /// As stratified, with one uniform number for all draws; this has the smallest variance.
  systematic
};
constexpr std::array<std::string_view, 4> enumerator_names(std::type_identity<Resampling>) {
  return {"multinomial", "residual", "stratified", "systematic"};
}

/// Ancestors of `ancestors.size()` draws, in ascending order; their number may differ from the
/// number of weights. Linear time.
/// \param weights  non-negative, with a positive sum
/// \param stage  stage of the random stream
void resample(Resampling scheme, ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
              std::span<Index> ancestors);

}  // namespace tmcmc
