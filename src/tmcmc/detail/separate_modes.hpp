/// \file
/// Number of separate modes of a fitted mixture.
#pragma once

#include "tmcmc/student_mixture.hpp"

namespace tmcmc::detail {

/// Groups of components between which the density falls: two components belong together if the mixture's density at nine points
/// of the line between their means is nowhere below a twentieth of the smaller one at the means, or if a chain of such pairs
/// joins them. Components of less than a hundredth of the weight are left out, unless all are.
[[nodiscard]] Index separate_modes(const StudentMixture& mixture);

}  // namespace tmcmc::detail
