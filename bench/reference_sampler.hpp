/// \file
/// What the sampler is measured against: a straightforward loop for the published setting. One
/// point at a time, constants of each frequency ratio cached, the C library's functions, mt19937_64
/// and std::normal_distribution.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "friction/response.hpp"

namespace reference {

using Point = std::array<double, 4>;

struct Model {
  std::vector<friction::ResponseConstants> constants;
  std::vector<double> nominal_ratio, driving_frequency_hz, phase_deg;
  double driving_force_n = 2.5;

  [[nodiscard]] double phase(std::size_t n, double force_n) const {
    const auto& c = constants[n];
    const double phi = force_n / driving_force_n;
    if (phi > c.limit_force_ratio) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const double phi_x0 = phi * std::sqrt(c.v * c.v - c.u * c.u * phi * phi);
    return std::fabs(std::atan2(c.b1 * phi_x0 + c.b2 * phi * phi, c.a0 + c.a1 * phi_x0 + c.a2 * phi * phi)) *
           (180.0 / M_PI);
  }

  [[nodiscard]] double log_likelihood(const Point& theta) const {
    double sum = 0.0;
    for (std::size_t n = 0; n < constants.size(); ++n) {
      const double modelled = phase(n, theta[0]);
      if (std::isnan(modelled)) {
        return -1e10;
      }
      const double a = (phase_deg[n] - modelled) / theta[2];
      const double b = (nominal_ratio[n] - driving_frequency_hz[n] / theta[1]) / theta[3];
      sum -= 0.5 * (a * a + b * b) + std::log(theta[2]) + std::log(theta[3]) + std::log(2.0 * M_PI);
    }
    return sum;
  }
};

/// One run with the published options; returns the number of stages.
inline int run(const Model& model, const Point& lower, const Point& upper, std::size_t n, unsigned seed,
               std::vector<Point>& samples) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<Point> points(n), moved(n);
  std::vector<double> log_likelihood(n), moved_log_likelihood(n), weights(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      points[i][j] = lower[j] + (upper[j] - lower[j]) * uniform(generator);
    }
    log_likelihood[i] = model.log_likelihood(points[i]);
  }
  const auto cov = [&](double step) {
    const double largest = *std::max_element(log_likelihood.begin(), log_likelihood.end());
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      weights[i] = std::exp(step * (log_likelihood[i] - largest));
      sum += weights[i];
    }
    double squares = 0.0;
    for (const double w : weights) {
      squares += (w - sum / static_cast<double>(n)) * (w - sum / static_cast<double>(n));
    }
    return std::sqrt(squares / static_cast<double>(n - 1)) / (sum / static_cast<double>(n));
  };
  double beta = 0.0;
  int stages = 0;
  while (beta < 1.0) {
    double step = 1.0 - beta;
    if (cov(step) > 1.0) {  // bisection in log(step)
      double low = std::log(1e-12);
      double high = std::log(step);
      while (high - low > 1e-8) {
        const double middle = 0.5 * (low + high);
        (cov(std::exp(middle)) > 1.0 ? high : low) = middle;
      }
      step = std::exp(low);
      cov(step);
      beta += step;
    } else {
      beta = 1.0;
    }
    ++stages;
    double sum = 0.0;
    Point mean{};
    for (std::size_t i = 0; i < n; ++i) {
      sum += weights[i];
      for (std::size_t j = 0; j < 4; ++j) {
        mean[j] += weights[i] * points[i][j];
      }
    }
    std::array<Point, 4> factor{};
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k <= j; ++k) {
        double c = 0.0;
        for (std::size_t i = 0; i < n; ++i) {
          c += weights[i] * (points[i][j] - mean[j] / sum) * (points[i][k] - mean[k] / sum);
        }
        c *= 0.04 / sum;
        for (std::size_t l = 0; l < k; ++l) {
          c -= factor[j][l] * factor[k][l];
        }
        factor[j][k] = j == k ? std::sqrt(c) : c / factor[k][k];
      }
    }
    std::discrete_distribution<std::size_t> pick(weights.begin(), weights.end());
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t start = pick(generator);
      Point current = points[start];
      double current_log_likelihood = log_likelihood[start];
      for (int k = 0; k < 3; ++k) {
        Point candidate;
        bool inside = false;
        while (!inside) {
          const Point z = {normal(generator), normal(generator), normal(generator), normal(generator)};
          inside = true;
          for (std::size_t j = 0; j < 4; ++j) {
            candidate[j] = current[j];
            for (std::size_t l = 0; l <= j; ++l) {
              candidate[j] += factor[j][l] * z[l];
            }
            inside = inside && candidate[j] >= lower[j] && candidate[j] <= upper[j];
          }
        }
        const double value = model.log_likelihood(candidate);
        if (std::log(uniform(generator)) <= beta * (value - current_log_likelihood)) {
          current = candidate;
          current_log_likelihood = value;
        }
      }
      moved[i] = current;
      moved_log_likelihood[i] = current_log_likelihood;
    }
    points.swap(moved);
    log_likelihood.swap(moved_log_likelihood);
  }
  samples = points;
  return stages;
}

}  // namespace reference
