#include "friction/time_integration.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "errors/invalid_value.hpp"
#include "friction/motion.hpp"
#include "portable_math/elementary.hpp"

namespace friction {

namespace {

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

/// A point (x, r x') of the half-period map, with the value of the map there.
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

/// Newton's step to the fixed point; none where the map is practically singular.
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
  // Near resonance the residual is flat between rest and a distant solution, so the first steps
  // need not reduce it. If they do not arrive, the search starts again and takes only those that
  // do.
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
