#include "friction/response.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <complex>

#include "errors/invalid_value.hpp"

namespace friction {

namespace {

using portable_math::sin_cos;
using portable_math::sin_cos_turns;
using std::numbers::pi;

double s_quotient(double r, double u, double tau) {
  const auto slow = sin_cos(tau);
  const auto fast = sin_cos(tau / r);
  return (r * fast.sin + u * r * r * (slow.cos - fast.cos)) / slow.sin;
}

/// Supremum on (0, pi): the limit 1 at tau -> 0, or a larger maximum between, bracketed on a grid
/// that resolves the oscillation with period 2 pi r and polished.
double s_supremum(double r, double u) {
  const int points = 32 * static_cast<int>(std::clamp(std::ceil(1.0 / r), 8.0, 1e5));
  const double step = pi / points;
  double best = 1.0;
  double left = 1.0;
  double middle = s_quotient(r, u, step);
  for (int j = 2; j < points; ++j) {
    const double right = s_quotient(r, u, step * j);
    if (middle > left && middle >= right && 1.001 * middle > best) {
      const auto peak = boost::math::tools::brent_find_minima(
          [&](double tau) { return -s_quotient(r, u, tau); }, step * (j - 2) + 1e-3 * step, step * j, 40);
      best = std::max(best, -peak.second);
    }
    left = middle;
    middle = right;
  }
  return best;
}

double s_grid(double r, double u) {
  double best = -std::numeric_limits<double>::infinity();
  for (int j = 1; j <= 14; ++j) {
    best = std::max(best, s_quotient(r, u, pi * j / 15.0));
  }
  return best;
}

using Complex = std::complex<double>;

struct Bins {
  Complex cosine;    // of cos tau
  Complex sine;      // of sin tau
  Complex friction;  // of 1 - cos(tau/r) - U r sin(tau/r), continued antiperiodically
};

Bins discrete_bins(double r, double u) {
  constexpr int steps_per_half_period = 15;
  constexpr int samples = 901;
  constexpr int bin = 30;
  Bins sums{};
  for (int j = 0; j < samples; ++j) {
    const int half_period = j / steps_per_half_period;
    const double tau = pi * (j % steps_per_half_period) / steps_per_half_period;
    const double sign = half_period % 2 == 0 ? 1.0 : -1.0;
    const auto twiddle = sin_cos_turns(static_cast<double>((bin * j) % samples) / samples);
    const Complex rotation(twiddle.cos, -twiddle.sin);
    const auto slow = sin_cos(tau);
    const auto fast = sin_cos(tau / r);
    sums.cosine += sign * slow.cos * rotation;
    sums.sine += sign * slow.sin * rotation;
    sums.friction += sign * (1.0 - fast.cos - u * r * fast.sin) * rotation;
  }
  return sums;
}

}  // namespace

bool is_singular_ratio(double frequency_ratio) {
  const double inverse = 1.0 / frequency_ratio;
  const double nearest_odd = 2.0 * std::floor(0.5 * inverse) + 1.0;
  return std::fabs(inverse - nearest_odd) <= 1e-9 * nearest_odd;
}

double response_function_u(double frequency_ratio) {
  const auto half = sin_cos(0.5 * pi / frequency_ratio);
  return half.sin / (half.cos * frequency_ratio);
}

double response_function_s(double frequency_ratio, LimitRule rule) {
  const double u = response_function_u(frequency_ratio);
  return rule == LimitRule::grid ? s_grid(frequency_ratio, u) : s_supremum(frequency_ratio, u);
}

ResponseConstants response_constants(double frequency_ratio, const Physics& physics) {
  const double r = frequency_ratio;
  if (!(r > 1e-4 && r < 1e6)) {
    throw errors::InvalidValue("frequency_ratio", r, "a ratio between 1e-4 and 1e6");
  }
  if (is_singular_ratio(r)) {
    throw errors::InvalidValue("frequency_ratio", r,
                               "a ratio other than 1, 1/3, 1/5, ..., where the response is unbounded");
  }
  ResponseConstants c{};
  c.frequency_ratio = r;
  c.u = response_function_u(r);
  c.v = 1.0 / ((1.0 - r) * (1.0 + r));
  const double s_over_r2 = response_function_s(r, physics.limit) / (r * r);
  c.limit_force_ratio = std::fabs(c.v) / std::sqrt(c.u * c.u + s_over_r2 * s_over_r2);
  if (physics.phase == PhaseRule::fourier_coefficient) {
    constexpr double four_over_pi = 4.0 / pi;
    c.a0 = c.v;
    c.a2 = four_over_pi * c.u;
    c.b1 = four_over_pi;
    return c;
  }
  // X = s x0 + t phi and Y = p x0 + q phi; the phase is the angle of Y conj(X).
  const Bins bins = discrete_bins(r, c.u);
  const Complex s = bins.cosine;
  const Complex t = c.u * bins.sine + bins.friction;
  const Complex p = bins.cosine / c.v;
  const Complex q = c.u * bins.sine / c.v;
  const Complex square = p * std::conj(s);
  const Complex mixed = p * std::conj(t) + q * std::conj(s);
  const Complex friction = q * std::conj(t) - c.u * c.u * square;  // x0^2 = V^2 - (phi U)^2
  c.a0 = square.real() * c.v * c.v;
  c.a1 = mixed.real();
  c.b1 = mixed.imag();
  c.a2 = friction.real();
  c.b2 = friction.imag();
  return c;
}

double response(const ResponseConstants& c, double force_ratio, double tau) {
  const bool second_half = tau >= pi;
  const double t = second_half ? tau - pi : tau;
  const double x0 = std::sqrt(c.v * c.v - c.u * c.u * force_ratio * force_ratio);
  const auto slow = sin_cos(t);
  const auto fast = sin_cos(t / c.frequency_ratio);
  const double x = x0 * slow.cos + force_ratio * c.u * slow.sin +
                   force_ratio * (1.0 - fast.cos - c.u * c.frequency_ratio * fast.sin);
  return second_half ? -x : x;
}

double base_phase(const ResponseConstants& c, double force_ratio) {
  const double x0 = std::sqrt(c.v * c.v - c.u * c.u * force_ratio * force_ratio);
  return portable_math::atan2(-force_ratio * c.u / c.v, x0 / c.v);
}

}  // namespace friction
