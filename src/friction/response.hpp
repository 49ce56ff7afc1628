/// \file
/// Steady response of a base-excited mass with Coulomb friction against a fixed wall (Den Hartog
/// 1930; Lye and Marino 2023, Eqs. 10-21), for continuous motion.
///
/// For a given frequency ratio r everything except the force ratio phi is constant, and the angle
/// between base motion and response is the argument of a complex number
///
///     (a0 + a1 phi x0 + a2 phi^2) + i (b1 phi x0 + b2 phi^2),   x0 = sqrt(V^2 - (phi U)^2),
///
/// with V = 1/(1 - r^2). For the exact first Fourier coefficient it reduces to (V + 4/pi U phi^2) +
/// i (4/pi) phi x0. The published scripts use one bin of a discrete Fourier transform instead,
/// which gives the same form with other constants; response_constants() computes both.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <type_traits>

#include "portable_math/elementary.hpp"

namespace friction {

/// Rule by which S in the limit of continuous motion (Eq. 18) is computed.
enum class LimitRule {
  /// Maximum over tau = pi/15 ... 14 pi/15, as in the published scripts.
  grid,
  /// Supremum over the half-period (0, pi).
  supremum
};
constexpr std::array<std::string_view, 2> enumerator_names(std::type_identity<LimitRule>) {
  return {"grid", "supremum"};
}

/// Rule by which the phase angle (Eq. 21) is computed from the two signals.
enum class PhaseRule {
  /// Bin 30 of a 901-point transform of 30 periods, end point repeated (published scripts).
  discrete_bin,
  /// First Fourier coefficient, in closed form.
  fourier_coefficient
};
constexpr std::array<std::string_view, 2> enumerator_names(std::type_identity<PhaseRule>) {
  return {"discrete-bin", "fourier-coefficient"};
}

/// The excitation, and the reading of the equations that can be interpreted in more than one way.
struct Physics {
  /// k Y_b, N (Section 3 of the paper).
  double driving_force_n = 2.5;
  /// Eq. 18.
  LimitRule limit = LimitRule::supremum;
  /// Eq. 21.
  PhaseRule phase = PhaseRule::fourier_coefficient;
};

/// All quantities on which the phase angle at one frequency ratio depends, apart from the force
/// ratio. Dimensionless.
struct ResponseConstants {
  /// r = omega_b / omega_n.
  double frequency_ratio;
  /// U of Eq. 16.
  double u;
  /// 1 / (1 - r^2).
  double v;
  /// phi_lim of Eq. 18: continuous motion for phi <= phi_lim.
  double limit_force_ratio;
  /// Real part: constant.
  double a0;
  /// Real part: factor of phi x0.
  double a1;
  /// Real part: factor of phi^2.
  double a2;
  /// Imaginary part: factor of phi x0.
  double b1;
  /// Imaginary part: factor of phi^2.
  double b2;
};

/// True where U or V is infinite, up to rounding: r = 1, 1/3, 1/5, ...
[[nodiscard]] bool is_singular_ratio(double frequency_ratio);

/// U of Eq. 16, written as tan(pi / (2 r)) / r.
[[nodiscard]] double response_function_u(double frequency_ratio);

/// S of Eq. 18: the largest value over the half-period of (r sin(tau/r) + U r^2 (cos tau -
/// cos(tau/r))) / sin tau, which tends to 1 as tau -> 0.
[[nodiscard]] double response_function_s(double frequency_ratio, LimitRule rule);

/// Constants for one frequency ratio.
/// \throws errors::InvalidValue unless r lies between 1e-4 and 1e6 and is not singular.
[[nodiscard]] ResponseConstants response_constants(double frequency_ratio, const Physics& physics);

/// x(tau) of Eq. 15 over the whole period, tau in [0, 2 pi), for phi <= phi_lim.
[[nodiscard]] double response(const ResponseConstants& constants, double force_ratio, double tau);

/// eta of Eqs. 19-20, in (-pi, pi]: the base moves as cos(tau + eta).
[[nodiscard]] double base_phase(const ResponseConstants& constants, double force_ratio);

namespace detail {

template <class T>
[[nodiscard]] inline T atan2_of(const T& y, const T& x) {
  if constexpr (std::is_same_v<T, double>) {
    return portable_math::atan2(y, x);
  } else {
    using std::atan2;
    return atan2(y, x);
  }
}

}  // namespace detail

/// Phase angle in degrees, in [0, 180] (Eq. 21), of continuous motion; NaN where phi > phi_lim or
/// phi < 0. T is double or a type that carries derivatives (ceres::Jet).
template <class T>
[[nodiscard]] T phase_deg(const ResponseConstants& c, const T& force_ratio) {
  if (!(force_ratio >= 0.0) || force_ratio > c.limit_force_ratio) {
    return T(std::numeric_limits<double>::quiet_NaN());
  }
  using std::sqrt;
  const T u_phi = c.u * force_ratio;
  const T phi_x0 = force_ratio * sqrt(c.v * c.v - u_phi * u_phi);
  const T phi_squared = force_ratio * force_ratio;
  const T real = c.a0 + c.a1 * phi_x0 + c.a2 * phi_squared;
  const T imaginary = c.b1 * phi_x0 + c.b2 * phi_squared;
  const T angle = detail::atan2_of(imaginary, real);
  return (angle < 0.0 ? T(-angle) : angle) * (180.0 / std::numbers::pi);
}

}  // namespace friction
