/// \file
/// Number of separate modes of a fitted mixture.
#pragma once

#include "tmcmc/student_mixture.hpp"

namespace tmcmc::detail {

/// Number of groups of components between which the density falls: two components belong together
/// if the mixture's density at nine points on the line between their means is nowhere below a
/// twentieth of the smaller density at the two means, or if a chain of such pairs connects them.
/// Components with less than a hundredth of the weight are ignored, unless all have less.
[[nodiscard]] Index separate_modes(const StudentMixture& mixture);

}  // namespace tmcmc::detail
