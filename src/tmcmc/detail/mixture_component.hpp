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
  double log_constant;   ///< log of its weight times the density at its mean, without a wider part
  double narrow = 0.0;   ///< the same relative to the largest constant, of the narrow part
  double wide = 0.0;     ///< and of the wider one
};

/// The components, without narrow and wide.
/// \param mixture  non-owning view of its means and factors; it must outlive the result
[[nodiscard]] std::vector<Component> components_of(const StudentMixture& mixture);

/// c^d = min(2^d, 16) of StudentMixture::wider().
[[nodiscard]] double wider_volume(Index d);

}  // namespace tmcmc::detail
