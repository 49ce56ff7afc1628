/// \file
/// Differences of angles, where angles that differ by whole turns are equal.
#pragma once

#include <cmath>

namespace friction {

/// Largest absolute value of a measured phase angle, deg: every angle has an equivalent within one
/// turn of 0.
inline constexpr double largest_phase_deg = 360.0;

/// Residual of an angle: the shortest rotation from the modelled angle to the observed one, in
/// (-180, 180] deg. Angles that differ by a whole turn are the same measurement. A difference that
/// already lies in this interval is returned bit for bit.
/// \param observed_deg  from -largest_phase_deg to largest_phase_deg
/// \param modelled_deg  from 0 to 180, as phase_deg() returns it; T is double or a type that
///        carries derivatives
template <class T>
[[nodiscard]] inline T angle_residual_deg(double observed_deg, const T& modelled_deg) {
  const T difference = observed_deg - modelled_deg;
  // The code selects between constants, not results: compilers turn this into masks, so that a loop
  // over points is still vectorised.
  const double turn = difference > 180.0 ? -360.0 : (difference <= -180.0 ? 360.0 : 0.0);
  return T(difference + turn);
}

/// An equivalent angle within the range of measurements: unchanged up to largest_phase_deg,
/// otherwise from -180 to 180 deg.
[[nodiscard]] inline double within_a_turn_deg(double angle_deg) {
  return std::fabs(angle_deg) <= largest_phase_deg ? angle_deg : std::remainder(angle_deg, 360.0);
}

}  // namespace friction
