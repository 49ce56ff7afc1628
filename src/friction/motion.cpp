#include "friction/motion.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "portable_math/elementary.hpp"

namespace friction {

namespace {

using portable_math::sin_cos;
using std::numbers::pi;

/// A zero of the function between low and high, bracketed to within the tolerance.
template <class Function>
double root(Function function, double low, double high, double tolerance) {
  std::uintmax_t evaluations = 200;
  const auto narrow = [tolerance](double a, double b) { return std::fabs(b - a) <= tolerance; };
  const auto bracket = boost::math::tools::toms748_solve(function, low, high, narrow, evaluations);
  return 0.5 * (bracket.first + bracket.second);
}

}  // namespace

Motion::Motion(double r, double phi, double x, double velocity, const TimeIntegrationOptions& options,
               std::vector<MotionPoint>* trace)
    : r_(r),
      phi_(phi),
      tolerance_(options.event_tolerance),
      nominal_step_(2.0 * pi * std::min(1.0, r) / options.steps_per_period),
      state_{x, velocity, 0.0, 0.0},
      trace_(trace) {
  note(false);
}

HalfPeriod Motion::to_half_period() {
  double sign = state_[1] > 0.0 ? 1.0 : -1.0;
  if (state_[1] == 0.0) sign = set_off();
  while (tau_ < pi) {
    slide(sign);
    if (tau_ < pi) sign = set_off(sign);
  }
  result_.x = state_[0];
  result_.velocity = state_[1];
  result_.cosine_integral = state_[2];
  result_.sine_integral = state_[3];
  return result_;
}

/// r^2 x'' while sliding in the direction of sign.
double Motion::force(double tau, const State& state, double sign) const {
  return portable_math::cos(tau) - state[0] - sign * phi_;
}

void Motion::note(bool sticks) {
  if (trace_ != nullptr) trace_->push_back({tau_, state_[0], sticks});
}

Motion::State Motion::stepped(double sign, double length) {
  const double friction = sign * phi_;
  const double inverse_square = 1.0 / (r_ * r_);
  State end;
  stepper_.do_step(
      [&](const State& z, State& derivative, double tau) {
        const auto forcing = sin_cos(tau);
        derivative = {z[1], (forcing.cos - z[0] - friction) * inverse_square, z[0] * forcing.cos,
                      z[0] * forcing.sin};
      },
      state_, tau_, end, length);
  return end;
}

/// Length of the step to the first zero of velocity, if one lies within the step of the given
/// length.
std::optional<double> Motion::length_to_stop(double sign, double length, const State& end) {
  double beyond = length;
  if (sign * end[1] > 0.0) {
    // Velocity may touch zero and rise again within the step; then force changes sign from - to +.
    const bool dips = sign * state_[1] > 0.0 && sign * force(tau_, state_, sign) < 0.0 &&
                      sign * force(tau_ + length, end, sign) > 0.0;
    if (!dips) return std::nullopt;
    beyond = root([&](double h) { return sign * force(tau_ + h, stepped(sign, h), sign); }, 0.0, length,
                  tolerance_);
    if (sign * stepped(sign, beyond)[1] > 0.0) return std::nullopt;
  }
  return root([&](double h) { return sign * stepped(sign, h)[1]; }, 0.0, beyond, tolerance_);
}

/// Slides with one sign of velocity to the next stop or to the end of the half-period.
void Motion::slide(double sign) {
  const double tau_start = tau_;
  const double x_start = state_[0];
  bool stopped = false;
  while (!stopped && tau_ < pi) {
    const double steps = std::ceil((pi - tau_) / nominal_step_);
    double length = (pi - tau_) / steps;
    double tau_end = steps > 1.0 ? tau_ + length : pi;
    State end = stepped(sign, length);
    if (state_[1] == 0.0) {
      // A slide shorter than the step has no zero of velocity to bracket until the start is
      // resolved.
      while (sign * end[1] <= 0.0 && length > tolerance_) {
        length *= 0.5;
        tau_end = tau_ + length;
        end = stepped(sign, length);
      }
      if (sign * end[1] <= 0.0) {
        hold(std::min(tau_ + tolerance_, pi));
        break;
      }
    }
    if (const auto stop = length_to_stop(sign, length, end)) {
      end = stepped(sign, *stop);
      end[1] = 0.0;
      tau_end = std::min(tau_ + *stop, pi);
      stopped = true;
    }
    state_ = end;
    tau_ = tau_end;
    note(false);
  }
  result_.path += std::fabs(state_[0] - x_start);
  rotate_derivative((tau_ - tau_start) / r_);
}

/// At zero velocity: sticks as long as friction can hold the mass, and returns the direction in
/// which it then slides.
/// \param arrived  direction in which it came
double Motion::set_off(std::optional<double> arrived) {
  const double pull = force(tau_, state_, 0.0);
  if (std::fabs(pull) <= phi_) {
    // cos falls on (0, pi), so friction can only give way where cos(tau) = x - phi.
    const double limit = state_[0] - phi_;
    const double release =
        limit < -1.0 ? pi : portable_math::atan2(std::sqrt(std::max(0.0, 1.0 - limit * limit)), limit);
    const double until = std::clamp(release, tau_, pi);
    result_.sticking_time += until - tau_;
    if (arrived) ++result_.stops;
    hold(until);
    scale_velocity_derivative(0.0);
    return -1.0;
  }
  const double sign = pull > 0.0 ? 1.0 : -1.0;
  if (arrived) scale_velocity_derivative((pull - sign * phi_) / (pull - *arrived * phi_));
  return sign;
}

void Motion::hold(double until) {
  const auto from = sin_cos(tau_);
  const auto to = sin_cos(until);
  state_[2] += state_[0] * (to.sin - from.sin);
  state_[3] += state_[0] * (from.cos - to.cos);
  if (trace_ != nullptr) trace_->back().sticks = until > tau_;
  tau_ = until;
  note(false);
}

void Motion::rotate_derivative(double angle) {
  const auto a = sin_cos(angle);
  const auto d = result_.derivative;
  result_.derivative = {a.cos * d[0] + a.sin * d[2], a.cos * d[1] + a.sin * d[3], a.cos * d[2] - a.sin * d[0],
                        a.cos * d[3] - a.sin * d[1]};
}

void Motion::scale_velocity_derivative(double factor) {
  result_.derivative[2] *= factor;
  result_.derivative[3] *= factor;
}

}  // namespace friction
