/// \file
/// One motion of the Coulomb oscillator over half a forcing period: the building block of
/// time_integration.hpp. This header is not installed.
#pragma once

#include <array>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <optional>
#include <vector>

#include "friction/time_integration.hpp"

namespace friction {

/// Alternates slides, which end at zeros of the velocity, and phases of sticking, which end where
/// friction gives way.
class Motion {
 public:
  /// Starts from (x, velocity) at tau = 0; the arguments are those of integrate_half_period,
  /// already checked.
  /// \param trace  receives the points of the motion; null: no trace
  Motion(double r, double phi, double x, double velocity, const TimeIntegrationOptions& options,
         std::vector<MotionPoint>* trace = nullptr);

  /// Continues the motion to tau = pi. To be called once.
  [[nodiscard]] HalfPeriod to_half_period();

 private:
  using State = std::array<double, 4>;  // x, x', integral of x cos(tau), integral of x sin(tau)

  [[nodiscard]] double force(double tau, const State& state, double sign) const;
  void note(bool sticks);
  [[nodiscard]] State stepped(double sign, double length);
  [[nodiscard]] std::optional<double> length_to_stop(double sign, double length, const State& end);
  void slide(double sign);
  double set_off(std::optional<double> arrived = std::nullopt);
  void hold(double until);
  void rotate_derivative(double angle);
  void scale_velocity_derivative(double factor);

  double r_, phi_, tolerance_, nominal_step_;
  double tau_ = 0.0;
  State state_;
  std::vector<MotionPoint>* trace_;
  HalfPeriod result_{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, {1.0, 0.0, 0.0, 1.0}};
  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper_;
};

}  // namespace friction
