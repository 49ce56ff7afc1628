#include "friction/time_integration.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "errors/invalid_value.hpp"
#include "portable_math/elementary.hpp"

namespace friction {

namespace {

using portable_math::sin_cos;
using std::numbers::pi;

template <class T>
void require(bool valid, const char* field, T value, const char* expected) {
  if (!valid) throw errors::InvalidValue(field, value, expected);
}

void validate(double frequency_ratio, double force_ratio, const TimeIntegrationOptions& options) {
  const auto between = [](double value, double low, double high) { return value >= low && value <= high; };
  require(between(frequency_ratio, 1e-3, 1e3), "frequency_ratio", frequency_ratio,
          "a ratio from 1e-3 to 1e3");
  require(force_ratio >= 0.0 && std::isfinite(force_ratio), "force_ratio", force_ratio,
          "a finite number, zero or more");
  require(options.steps_per_period >= 8, "steps_per_period", options.steps_per_period, "8 or more");
  require(between(options.event_tolerance, 1e-15, 1e-3), "event_tolerance", options.event_tolerance,
          "a number from 1e-15 to 1e-3");
  require(between(options.periodicity_tolerance, 1e-15, 1e-3), "periodicity_tolerance",
          options.periodicity_tolerance, "a number from 1e-15 to 1e-3");
  require(options.maximum_periods >= 1, "maximum_periods", options.maximum_periods, "1 or more");
}

class Motion {
 public:
  /// \param trace  takes the points of the motion; null: none
  Motion(double r, double phi, double x, double velocity, const TimeIntegrationOptions& options,
         std::vector<MotionPoint>* trace = nullptr)
      : r_(r),
        phi_(phi),
        tolerance_(options.event_tolerance),
        nominal_step_(2.0 * pi * std::min(1.0, r) / options.steps_per_period),
        state_{x, velocity, 0.0, 0.0},
        trace_(trace) {
    note(false);
  }

  HalfPeriod to_half_period() {
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

 private:
  using State = std::array<double, 4>;  // x, x', integral of x cos(tau), integral of x sin(tau)

  /// r^2 x'' while sliding in the direction of sign.
  [[nodiscard]] double force(double tau, const State& state, double sign) const {
    return portable_math::cos(tau) - state[0] - sign * phi_;
  }

  void note(bool sticks) {
    if (trace_ != nullptr) trace_->push_back({tau_, state_[0], sticks});
  }

  [[nodiscard]] State stepped(double sign, double length) {
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

  template <class Function>
  [[nodiscard]] double root(Function function, double low, double high) const {
    std::uintmax_t evaluations = 200;
    const auto narrow = [this](double a, double b) { return std::fabs(b - a) <= tolerance_; };
    const auto bracket = boost::math::tools::toms748_solve(function, low, high, narrow, evaluations);
    return 0.5 * (bracket.first + bracket.second);
  }

  /// Length of the step to the first zero of velocity, if one lies within the step of the given length.
  [[nodiscard]] std::optional<double> length_to_stop(double sign, double length, const State& end) {
    double beyond = length;
    if (sign * end[1] > 0.0) {
      // Velocity may touch zero and rise again within the step; then force changes sign from - to +.
      const bool dips = sign * state_[1] > 0.0 && sign * force(tau_, state_, sign) < 0.0 &&
                        sign * force(tau_ + length, end, sign) > 0.0;
      if (!dips) return std::nullopt;
      beyond = root([&](double h) { return sign * force(tau_ + h, stepped(sign, h), sign); }, 0.0, length);
      if (sign * stepped(sign, beyond)[1] > 0.0) return std::nullopt;
    }
    return root([&](double h) { return sign * stepped(sign, h)[1]; }, 0.0, beyond);
  }

  /// Slides with one sign of velocity to the next stop or to the end of the half-period.
  void slide(double sign) {
    const double tau_start = tau_;
    const double x_start = state_[0];
    bool stopped = false;
    while (!stopped && tau_ < pi) {
      const double steps = std::ceil((pi - tau_) / nominal_step_);
      double length = (pi - tau_) / steps;
      double tau_end = steps > 1.0 ? tau_ + length : pi;
      State end = stepped(sign, length);
      if (state_[1] == 0.0) {
        // A slide shorter than the step has no zero of velocity to bracket until the start is resolved.
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

  /// At zero velocity: sticks as long as friction can hold the mass, and returns the direction in which it
  /// then slides.
  /// \param arrived  direction in which it came
  double set_off(std::optional<double> arrived = std::nullopt) {
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

  void hold(double until) {
    const auto from = sin_cos(tau_);
    const auto to = sin_cos(until);
    state_[2] += state_[0] * (to.sin - from.sin);
    state_[3] += state_[0] * (from.cos - to.cos);
    if (trace_ != nullptr) trace_->back().sticks = until > tau_;
    tau_ = until;
    note(false);
  }

  void rotate_derivative(double angle) {
    const auto a = sin_cos(angle);
    const auto d = result_.derivative;
    result_.derivative = {a.cos * d[0] + a.sin * d[2], a.cos * d[1] + a.sin * d[3],
                          a.cos * d[2] - a.sin * d[0], a.cos * d[3] - a.sin * d[1]};
  }

  void scale_velocity_derivative(double factor) {
    result_.derivative[2] *= factor;
    result_.derivative[3] *= factor;
  }

  double r_, phi_, tolerance_, nominal_step_;
  double tau_ = 0.0;
  State state_;
  std::vector<MotionPoint>* trace_;
  HalfPeriod result_{0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0, {1.0, 0.0, 0.0, 1.0}};
  boost::numeric::odeint::runge_kutta_fehlberg78<State> stepper_;
};

/// A point (x, r x') of the half-period map and what the map does there.
struct Point {
  double x, w;
  HalfPeriod motion;
  double image_x, image_w;  // minus the state half a period later
  double residual;          // distance to the image
};

Point evaluate(double r, double phi, double x, double w, const TimeIntegrationOptions& options) {
  const HalfPeriod motion = Motion(r, phi, x, w / r, options).to_half_period();
  Point p{x, w, motion, -motion.x, -r * motion.velocity, 0.0};
  p.residual = std::sqrt((p.image_x - x) * (p.image_x - x) + (p.image_w - w) * (p.image_w - w));
  return p;
}

struct NewtonStep {
  double dx, dw;  // to the fixed point
  double x, w;    // where it leads
  double error;   // its length, and what rounding can make of it, relative to the size of the motion
};

/// Newton's step to the fixed point; none where the map is as good as singular.
std::optional<NewtonStep> newton_step(const Point& p) {
  const auto& d = p.motion.derivative;
  const double a = 1.0 + d[0];
  const double b = 1.0 + d[3];
  const double determinant = a * b - d[1] * d[2];
  const double largest = std::max({std::fabs(a), std::fabs(b), std::fabs(d[1]), std::fabs(d[2])});
  const double amplification = largest / std::fabs(determinant);
  if (!(amplification < 1e8)) return std::nullopt;
  const double ex = p.image_x - p.x;
  const double ew = p.image_w - p.w;
  const double dx = (b * ex - d[1] * ew) / determinant;
  const double dw = (a * ew - d[2] * ex) / determinant;
  const double size = std::max(std::sqrt(p.x * p.x + p.w * p.w), p.motion.path);
  const double error = std::sqrt(dx * dx + dw * dw) / size;
  // image + derivative * step rather than point + step: a velocity that is exactly 0 stays so.
  return NewtonStep{dx, dw, p.image_x - (d[0] * dx + d[1] * dw), p.image_w - (d[2] * dx + d[3] * dw),
                    error + amplification * std::numeric_limits<double>::epsilon()};
}

SteadyResponse periodic_response(double r, double phi, const Point& p) {
  const HalfPeriod& h = p.motion;
  const double c = h.cosine_integral;
  const double s = h.sine_integral;
  SteadyResponse response{};
  response.state = SteadyState::periodic;
  response.phase_deg = std::fabs(portable_math::atan2(s, c)) * (180.0 / pi);
  response.amplitude = std::sqrt(c * c + s * s) * (2.0 / pi);
  response.continuous = h.sticking_time == 0.0;
  response.stops_per_period = 2 * h.stops;
  response.sticking_fraction = h.sticking_time / pi;
  response.x = p.x;
  response.velocity = p.w / r;
  response.work = 2.0 * s;
  response.dissipation = 2.0 * phi * h.path;
  return response;
}

}  // namespace

HalfPeriod integrate_half_period(double frequency_ratio, double force_ratio, double x, double velocity,
                                 const TimeIntegrationOptions& options) {
  validate(frequency_ratio, force_ratio, options);
  require(std::isfinite(x), "x", x, "a finite number");
  require(std::isfinite(velocity), "velocity", velocity, "a finite number");
  return Motion(frequency_ratio, force_ratio, x, velocity, options).to_half_period();
}

std::vector<MotionPoint> trace_half_period(double frequency_ratio, double force_ratio, double x,
                                           double velocity, const TimeIntegrationOptions& options) {
  validate(frequency_ratio, force_ratio, options);
  require(std::isfinite(x), "x", x, "a finite number");
  require(std::isfinite(velocity), "velocity", velocity, "a finite number");
  std::vector<MotionPoint> trace;
  static_cast<void>(Motion(frequency_ratio, force_ratio, x, velocity, options, &trace).to_half_period());
  return trace;
}

SteadyResponse integrate_steady_response(double frequency_ratio, double force_ratio,
                                         const TimeIntegrationOptions& options) {
  validate(frequency_ratio, force_ratio, options);
  const double r = frequency_ratio;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  SteadyResponse none{SteadyState::not_periodic, nan, nan, false, 0, nan, nan, nan, nan, nan, nan, 0.0};

  const Point start = evaluate(r, force_ratio, 0.0, 0.0, options);
  if (start.motion.path == 0.0) {
    return {SteadyState::at_rest, nan, 0.0, false, 0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5};
  }
  // Near resonance the residual is flat between rest and a distant solution, so the first steps need not
  // reduce it. If they do not arrive, the search starts again and takes only those that do.
  constexpr int first_evaluations = 20;
  const int most = 2 * std::min(options.maximum_periods, 1000000000);
  bool descending = false;
  Point point = start;
  for (int evaluations = 1;;) {
    if (!descending && evaluations >= first_evaluations) {
      descending = true;
      point = start;
    }
    const auto newton = newton_step(point);
    if (newton && newton->error <= options.periodicity_tolerance) {
      SteadyResponse response = periodic_response(r, force_ratio, point);
      response.periodicity_error = newton->error;
      response.periods_integrated = 0.5 * evaluations;
      return response;
    }
    if (evaluations >= most) {
      none.periods_integrated = 0.5 * evaluations;
      return none;
    }
    bool accepted = false;
    double share = newton ? std::min(1.0, 1.0 / newton->error) : 0.0;  // at most the size of the motion
    for (int attempt = 0; newton && !accepted && attempt < 5 && evaluations < most; ++attempt) {
      const bool full = share == 1.0;
      const Point candidate = evaluate(r, force_ratio, full ? newton->x : point.x + share * newton->dx,
                                       full ? newton->w : point.w + share * newton->dw, options);
      ++evaluations;
      accepted = !descending || candidate.residual < point.residual;
      if (accepted) point = candidate;
      share *= 0.25;
    }
    if (accepted || evaluations >= most) continue;
    point = evaluate(r, force_ratio, point.image_x, point.image_w, options);
    ++evaluations;
  }
}

}  // namespace friction
