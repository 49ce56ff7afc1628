/// \file
/// Loops that the compiler unrolls where there are few coordinates.
#pragma once

#include <type_traits>

#include "portable_math/elementary.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc::detail {

/// For so few coordinates there are versions in which those of a point stay in registers.
constexpr Index most_of_few = 6;

/// use(std::integral_constant<int, d>).
/// \param use  to be inlined, so that it is compiled for the instruction set of the caller
/// \return  false, and nothing is done, for more than most_of_few coordinates
template <class Use>
PORTABLE_MATH_INLINE bool for_few_coordinates(Index d, const Use& use) {
  switch (d) {
    case 1:
      use(std::integral_constant<int, 1>{});
      return true;
    case 2:
      use(std::integral_constant<int, 2>{});
      return true;
    case 3:
      use(std::integral_constant<int, 3>{});
      return true;
    case 4:
      use(std::integral_constant<int, 4>{});
      return true;
    case 5:
      use(std::integral_constant<int, 5>{});
      return true;
    case 6:
      use(std::integral_constant<int, 6>{});
      return true;
    default:
      return false;
  }
}

}  // namespace tmcmc::detail
