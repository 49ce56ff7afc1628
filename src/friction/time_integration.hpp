/// \file
/// Steady response of the Coulomb oscillator by integration in time, through sliding and sticking:
///
///     r^2 x'' + x + phi sgn(x') = cos(tau)                                                  (Eq. 10)
///
/// with Filippov's set-valued sign at x' = 0: the mass sticks while |cos(tau) - x| <= phi and then
/// slides in the direction in which cos(tau) - x points. No formula of Den Hartog's solution
/// (response.hpp) is used, and the motion need not be continuous, so this both checks that solution
/// and goes beyond its limit.
///
/// Everything is dimensionless: displacement in base amplitudes Y_b, time tau = omega_b t in
/// radians, energy in k Y_b^2. The forcing is cos(tau): here tau = 0 is the maximum of the base
/// motion, not that of x.
#pragma once

#include <array>
#include <vector>

namespace friction {

/// The defaults give the phase to about 1e-9 deg in well under a millisecond, except near
/// resonance.
struct TimeIntegrationOptions {
  /// Steps of the order-8 Runge-Kutta-Fehlberg method per shorter one of the forcing period and the
  /// natural period, 2 pi min(1, r); 8 or more. Steps end at stops, so that the sign of the
  /// velocity is constant in each step.
  int steps_per_period = 64;
  /// Width in tau, rad, to which a zero of velocity is bracketed; 1e-15 to 1e-3.
  double event_tolerance = 1e-13;
  /// Largest estimated distance from the periodic motion, relative to its size; 1e-15 to 1e-3.
  double periodicity_tolerance = 1e-11;
  /// Largest number of forcing periods to integrate, 1 or more; a steady response rarely takes more
  /// than ten.
  int maximum_periods = 200;
};

/// Motion over half a forcing period, 0 <= tau <= pi.
struct HalfPeriod {
  /// Displacement at tau = pi.
  double x;
  /// dx/dtau at tau = pi; exactly 0 if the mass sticks then.
  double velocity;
  /// Integral of x cos(tau).
  double cosine_integral;
  /// Integral of x sin(tau).
  double sine_integral;
  /// Integral of |x'|.
  double path;
  /// Time spent sticking, rad.
  double sticking_time;
  /// Intervals of sticking that begin after tau = 0.
  int stops;
  /// Derivative of (x, r x') at tau = pi with respect to (x, r x') at tau = 0, by rows. Neither
  /// stops nor reversals expand: the distance between two motions in these coordinates never grows.
  std::array<double, 4> derivative;
};

/// Integrates Eq. 10 from (x, velocity) at tau = 0 to tau = pi.
/// \param frequency_ratio  r = omega_b / omega_n, from 1e-3 to 1e3
/// \param force_ratio      phi = F_mu / (k Y_b), zero or more
/// \param velocity         dx/dtau
/// \throws errors::InvalidValue for arguments or options out of range.
[[nodiscard]] HalfPeriod integrate_half_period(double frequency_ratio, double force_ratio, double x,
                                               double velocity, const TimeIntegrationOptions& options = {});

/// One point of a motion.
struct MotionPoint {
  /// Rad.
  double tau;
  /// Displacement.
  double x;
  /// Whether the mass sticks from here to the next point.
  bool sticks;
};

/// The motion of integrate_half_period from tau = 0 to tau = pi as points: the ends of its steps
/// and of its intervals of sticking.
/// \throws as integrate_half_period.
[[nodiscard]] std::vector<MotionPoint> trace_half_period(double frequency_ratio, double force_ratio, double x,
                                                         double velocity,
                                                         const TimeIntegrationOptions& options = {});

/// How the search for the steady response ended.
enum class SteadyState {
  /// A periodic motion was found to periodicity_tolerance.
  periodic,
  /// The mass never leaves x = 0 (phi >= 1): no phase is defined.
  at_rest,
  /// None found in maximum_periods: motion is unbounded (r = 1 and phi < pi/4), not unique (phi = 0
  /// and r = 1/3, 1/5, ...), or too close to either case for the tolerance.
  not_periodic
};

/// Steady response. The numbers describe the periodic motion; if there is none they are NaN, and
/// counts are 0.
struct SteadyResponse {
  /// How the search ended.
  SteadyState state;
  /// Lag of the first harmonic of x behind cos(tau), in [0, 180] (Eq. 21).
  double phase_deg;
  /// Amplitude of the first harmonic of x (0 at rest).
  double amplitude;
  /// Periodic and the mass never sticks.
  bool continuous;
  /// Intervals of sticking that begin in a period.
  int stops_per_period;
  /// Share of the period in which the mass sticks (1 at rest).
  double sticking_fraction;
  /// Displacement at tau = 0, from which the motion repeats.
  double x;
  /// dx/dtau at tau = 0.
  double velocity;
  /// Work of the forcing over a period, pi times the sine coefficient of x.
  double work;
  /// Dissipation by friction over a period, phi times the path.
  double dissipation;
  /// Estimated distance from the periodic motion, relative to its size.
  double periodicity_error;
  /// In steps of one half.
  double periods_integrated;
};

/// Steady response to Eq. 10, starting from rest at x = 0.
///
/// Seeks the motion with x(tau + pi) = -x(tau) as the fixed point of the map from (x, r x') at tau
/// = 0 to minus its value half a period later. The map never increases the distance of two points,
/// so that iterating it amounts to integrating the transient; steps of Newton's method replace
/// iterations where they can. The sine and cosine integrals are components of the integrated state,
/// in closed form during sticking. Results are bit-identical on every machine (portable_math).
/// Where the map is close to singular, near r = 1, its inverse amplifies errors of rounding and of
/// the integrator; periodicity_error includes the rounding errors.
/// \param frequency_ratio  r = omega_b / omega_n, from 1e-3 to 1e3
/// \param force_ratio      phi = F_mu / (k Y_b), zero or more
/// \throws errors::InvalidValue for arguments or options out of range.
[[nodiscard]] SteadyResponse integrate_steady_response(double frequency_ratio, double force_ratio,
                                                       const TimeIntegrationOptions& options = {});

}  // namespace friction
