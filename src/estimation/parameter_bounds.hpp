/// \file
/// Box-shaped support of independent uniform priors on the four parameters (Table 2 of Lye and
/// Marino 2023).
#pragma once

#include <array>

#include "friction/likelihood.hpp"

namespace estimation {

/// Bounds of one parameter, in its unit.
struct Interval {
  /// Lower bound, finite and less than upper.
  double lower = 0.0;
  /// Upper bound, finite.
  double upper = 0.0;

  /// upper - lower, in the unit of the parameter.
  [[nodiscard]] double width() const { return upper - lower; }
  /// Whether x lies strictly between the bounds.
  [[nodiscard]] bool has_inside(double x) const { return x > lower && x < upper; }
};

/// One interval per parameter, in the order and the units of friction::Parameter.
using ParameterBounds = std::array<Interval, friction::parameter_count>;

/// \throws errors::InvalidValue, naming a field such as "friction_force.lower", unless all bounds
///         are finite, lower is less than upper, the friction force is not negative, and natural
///         frequency and noise levels are positive.
void validate(const ParameterBounds& bounds);

/// Logarithm of the volume of the box, which is minus the log-density of the prior.
[[nodiscard]] double log_volume(const ParameterBounds& bounds);

/// The name "friction_force", "natural_frequency", "phase_noise" or "frequency_ratio_noise".
[[nodiscard]] const char* name_of(friction::Parameter parameter);

}  // namespace estimation
