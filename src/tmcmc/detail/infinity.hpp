/// \file
/// A short name for infinity.
#pragma once

#include <limits>

namespace tmcmc::detail {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace tmcmc::detail
