/// \file
/// The model one point at a time in long double, from Eqs. 12-24 as they stand: what the batch is
/// measured against. It shares nothing with the library but the frequency ratios and the choice of
/// a phase rule.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "friction/response.hpp"

namespace long_double {

constexpr long double pi = std::numbers::pi_v<long double>;

/// The phase angle at one frequency ratio.
class Phase {
 public:
  Phase(double frequency_ratio, friction::PhaseRule rule)
      : r_(frequency_ratio),
        u_(std::sin(pi / r_) / (r_ * (1.0L + std::cos(pi / r_)))),
        v_(1.0L / (1.0L - r_ * r_)),
        rule_(rule) {
    constexpr int bin = 30;
    constexpr int samples = 901;  // thirty periods of thirty steps, the end point repeated
    for (int j = 0; j < samples; ++j) {
      const auto rotation = std::polar(1.0L, -2.0L * pi * ((bin * j) % samples) / samples);
      const long double tau = pi * (j % 15) / 15.0L;
      const long double sign = (j / 15) % 2 == 0 ? 1.0L : -1.0L;
      cosine_ += sign * std::cos(tau) * rotation;
      sine_ += sign * std::sin(tau) * rotation;
      friction_ += sign * (1.0L - std::cos(tau / r_) - u_ * r_ * std::sin(tau / r_)) * rotation;
    }
  }

  /// In deg, from the force ratio.
  [[nodiscard]] long double operator()(long double phi) const {
    const long double x0 = std::sqrt(v_ * v_ - phi * phi * u_ * u_);
    std::complex<long double> lag;
    if (rule_ == friction::PhaseRule::fourier_coefficient) {
      lag = {v_ + 4.0L / pi * u_ * phi * phi, 4.0L / pi * phi * x0};
    } else {
      // Eq. 15
      const auto x = x0 * cosine_ + phi * u_ * sine_ + phi * friction_;
      // cos(tau + eta), Eqs. 19-20
      const auto y = x0 / v_ * cosine_ + phi * u_ / v_ * sine_;
      lag = y * std::conj(x);
    }
    return std::fabs(std::arg(lag)) * 180.0L / pi;
  }

 private:
  long double r_, u_, v_;
  friction::PhaseRule rule_;
  std::complex<long double> cosine_, sine_, friction_;
};

inline std::vector<Phase> phases(const std::vector<double>& frequency_ratios, friction::PhaseRule rule) {
  std::vector<Phase> all;
  for (const double r : frequency_ratios) {
    all.emplace_back(r, rule);
  }
  return all;
}

}  // namespace long_double
