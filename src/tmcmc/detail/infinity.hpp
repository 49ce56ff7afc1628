/// \file
/// Infinity by a short name.
#pragma once

#include <limits>

namespace tmcmc::detail {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace tmcmc::detail
