/// \file
/// Loops that the compiler unrolls if there are few coordinates.
#pragma once

#include <type_traits>
#include <utility>

#include "portable_math/elementary.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc::detail {

/// Up to this number of coordinates there are versions in which the coordinates of a point stay in
/// registers.
constexpr int most_of_few = 6;

/// Calls use(std::integral_constant<int, d>) if d is one of D + 1.
template <class Use, int... D>
PORTABLE_MATH_INLINE bool for_one_of(Index d, const Use& use, std::integer_sequence<int, D...>) {
  return ((d == D + 1 && (use(std::integral_constant<int, D + 1>{}), true)) || ...);
}

/// Calls use(std::integral_constant<int, d>).
/// \param use  must be inlined, so that it is compiled for the instruction set of the caller
/// \return  false, without doing anything, for more than most_of_few coordinates
template <class Use>
PORTABLE_MATH_INLINE bool for_few_coordinates(Index d, const Use& use) {
  return for_one_of(d, use, std::make_integer_sequence<int, most_of_few>{});
}

}  // namespace tmcmc::detail
