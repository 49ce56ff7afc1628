/// \file
/// Reference distributions, and the bounds of the statistical tests. Seeds are fixed: a test that
/// passes once passes always, and the bounds say how unlikely a correct program would have been to
/// fail it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace statistics {

/// Bound on |estimate - truth| in Monte Carlo standard errors; chance exceeds it with probability
/// 6e-5.
constexpr double standard_errors = 4.0;

/// Bound on sqrt(n) D_n of Kolmogorov's test; chance exceeds it with probability 2 exp(-2 2.3^2) =
/// 5e-5.
constexpr double kolmogorov_bound = 2.3;

/// Uniform numbers from a generator that the library does not use.
class Uniforms {
 public:
  explicit Uniforms(std::uint64_t seed) : generator_(seed) {}

  /// In the open interval (0, 1).
  double operator()() { return (static_cast<double>(generator_() >> 12U) + 0.5) * 0x1p-52; }
  double operator()(double low, double high) { return low + (high - low) * (*this)(); }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log((*this)()));
    return radius * std::cos(6.283185307179586 * (*this)());
  }

 private:
  std::mt19937_64 generator_;
};

inline double normal_cdf(double z) {
  return 0.5 * std::erfc(-z * std::sqrt(0.5));
}

inline double normal_density(double z) {
  return std::exp(-0.5 * z * z) / std::sqrt(6.283185307179586);
}

/// sqrt(n) times the largest distance between the empirical distribution and cdf.
template <class Cdf>
double kolmogorov(std::vector<double> values, Cdf cdf) {
  std::sort(values.begin(), values.end());
  const double n = static_cast<double>(values.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double f = cdf(values[i]);
    distance = std::max({distance, f - static_cast<double>(i) / n, static_cast<double>(i + 1) / n - f});
  }
  return std::sqrt(n) * distance;
}

struct Estimate {
  double mean;
  double standard_deviation;
  /// Of the mean.
  double standard_error;

  /// Distance from the truth in standard errors.
  [[nodiscard]] double errors_from(double truth) const { return std::fabs(mean - truth) / standard_error; }
};

inline Estimate estimate(const std::vector<double>& values) {
  const double n = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double value : values) {
    mean += value / n;
  }
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - mean) * (value - mean);
  }
  const double deviation = std::sqrt(squares / (n - 1.0));
  return {mean, deviation, deviation / std::sqrt(n)};
}

/// Correlation times sqrt(n): standard normal for independent columns.
inline double scaled_correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const Estimate ex = estimate(x);
  const Estimate ey = estimate(y);
  const double n = static_cast<double>(x.size());
  double products = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    products += (x[i] - ex.mean) * (y[i] - ey.mean);
  }
  return products / (n - 1.0) / (ex.standard_deviation * ey.standard_deviation) * std::sqrt(n);
}

}  // namespace statistics
