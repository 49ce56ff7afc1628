/// \file
/// Components of a mixture of Student t distributions with the constants of their densities.
#pragma once

#include <vector>

#include "tmcmc/student_mixture.hpp"

namespace tmcmc::detail {

/// One component ready for use.
struct Component {
  /// d.
  const double* mean;
  /// d x d, by columns.
  const double* factor;
  /// log of (weight times density at the mean), without a wider part.
  double log_constant;
  /// This constant relative to the largest, for the narrow part.
  double narrow = 0.0;
  /// This constant relative to the largest, for the wider part.
  double wide = 0.0;
};

/// The components of a mixture, without narrow and wide set.
/// \param mixture  non-owning view of its means and factors, which must outlive the result
[[nodiscard]] std::vector<Component> components_of(const StudentMixture& mixture);

/// c^d = min(2^d, 16) of StudentMixture::wider().
[[nodiscard]] double wider_volume(Index d);

}  // namespace tmcmc::detail
