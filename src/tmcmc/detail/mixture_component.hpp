/// \file
/// Components of a mixture of Student t distributions with the constants of their densities.
#pragma once

#include <vector>

#include "tmcmc/student_mixture.hpp"

namespace tmcmc::detail {

/// One component ready for use.
struct Component {
  const double* mean;    ///< d
  const double* factor;  ///< d x d, by columns
  double log_constant;   ///< log of (weight times density at the mean), without a wider part
  double narrow = 0.0;   ///< this constant relative to the largest, for the narrow part
  double wide = 0.0;     ///< this constant relative to the largest, for the wider part
};

/// The components of a mixture, without narrow and wide set.
/// \param mixture  non-owning view of its means and factors, which must outlive the result
[[nodiscard]] std::vector<Component> components_of(const StudentMixture& mixture);

/// c^d = min(2^d, 16) of StudentMixture::wider().
[[nodiscard]] double wider_volume(Index d);

}  // namespace tmcmc::detail
