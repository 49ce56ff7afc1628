// Integrals over a noise level and its conditional quantiles against incomplete gamma functions.

#include <boost/math/special_functions/expint.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/noise_conditional.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using estimation::Interval;
using estimation::log_noise_integral;
using estimation::NoiseConditional;

constexpr double tolerance = 1e-11;

double transformed(double misfit, double sigma) {
  return misfit / (2.0 * sigma * sigma);
}

/// The integral with t = S / (2 sigma^2): 1/2 (S/2)^-k times the integral of t^(k-1) e^-t, k =
/// (n-1)/2.
double closed_form(int count, const Interval& noise, double misfit) {
  const double low = transformed(misfit, noise.upper);
  const double high = transformed(misfit, noise.lower);
  if (count == 1) {
    return std::log(0.5 * (boost::math::expint(1, low) - boost::math::expint(1, high)));
  }
  const double k = 0.5 * (count - 1.0);
  const double upper_difference = boost::math::gamma_q(k, low) - boost::math::gamma_q(k, high);
  const double lower_difference = boost::math::gamma_p(k, high) - boost::math::gamma_p(k, low);
  const double probability = low > k ? upper_difference : lower_difference;
  return std::log(0.5) - k * std::log(0.5 * misfit) + std::lgamma(k) + std::log(probability);
}

/// P(sigma <= s | S).
double conditional_cdf(int count, const Interval& noise, double misfit, double s) {
  return std::exp(closed_form(count, {noise.lower, s}, misfit) - closed_form(count, noise, misfit));
}

}  // namespace

TEST_CASE("the integral over the noise level is the closed form", "[estimation]") {
  const Interval noise{0.001, 10.0};
  for (const int count : {1, 2, 3, 10, 11, 100, 2000}) {
    for (const double scale : {1e-4, 0.01, 1.0, 30.0, 3000.0}) {
      const double misfit = scale * count;
      CAPTURE(count, misfit);
      const double expected = closed_form(count, noise, misfit);
      if (std::isfinite(expected)) {
        const double rounding = 1e-13 * (10.0 + std::fabs(expected));
        CHECK_THAT(log_noise_integral(static_cast<std::size_t>(count), noise, misfit),
                   WithinAbs(expected, rounding));
      }
    }
  }
}

TEST_CASE("the integral over the noise level at the edges", "[estimation]") {
  const Interval noise{0.5, 2.0};
  CHECK_THAT(log_noise_integral(1, noise, 0.0), WithinAbs(std::log(std::log(4.0)), tolerance));
  CHECK_THAT(log_noise_integral(3, noise, 0.0), WithinAbs(std::log(0.5 * (4.0 - 0.25)), tolerance));
  // Bound by the upper end: S / (2 b^2) = 1e8 and 1e32; the density falls off with the rate S /
  // b^3.
  for (const double misfit : {8e8, 8e32}) {
    const double expected = -misfit / 8.0 - 10.0 * std::log(2.0) - std::log(misfit / 8.0);
    CHECK_THAT(log_noise_integral(10, noise, misfit), WithinRel(expected, 1e-12));
  }
}

TEST_CASE("the smallest noise level that matters", "[estimation]") {
  CHECK_THAT(estimation::smallest_noise(10, {0.001, 10.0}, 0.0, 50.0), WithinRel(0.001, tolerance));
  const double sigma = estimation::smallest_noise(11, {0.001, 10.0}, 100.0, 50.0);
  const auto log_density = [](double s) { return -10.0 * std::log(s) - 50.0 / (s * s); };
  CHECK_THAT(log_density(std::sqrt(10.0)) - log_density(sigma), WithinAbs(50.0, 1e-9));
}

TEST_CASE("conditional quantiles invert the conditional distribution function", "[estimation]") {
  const double accuracy = 1e-10;
  struct Case {
    int count;
    Interval noise;
    double misfit;
  };
  const Case cases[] = {{10, {0.001, 10.0}, 61.0}, {10, {0.001, 10.0}, 900.0}, {10, {0.001, 1.5}, 61.0},
                        {10, {3.0, 10.0}, 61.0},   {10, {2.0, 2.1}, 61.0},     {1, {0.001, 10.0}, 5.0},
                        {1, {0.001, 10.0}, 1e-3},  {2, {0.001, 10.0}, 0.3},    {2000, {0.001, 10.0}, 8000.0}};
  for (const Case& c : cases) {
    CAPTURE(c.count, c.noise.lower, c.noise.upper, c.misfit);
    const NoiseConditional conditional(static_cast<std::size_t>(c.count), c.noise, 0.5 * c.misfit,
                                       2.0 * c.misfit);
    double previous = c.noise.lower;
    for (const double p : {1e-6, 0.01, 0.3, 0.5, 0.9, 0.9999}) {
      const double sigma = conditional.quantile(c.misfit, p);
      CHECK(sigma > previous);
      previous = sigma;
      CHECK_THAT(conditional_cdf(c.count, c.noise, c.misfit, sigma), WithinAbs(p, accuracy));
    }
  }
}

TEST_CASE("conditional quantiles without residuals, and pressed against the upper bound", "[estimation]") {
  const NoiseConditional exact_fit(3, {0.5, 2.0}, 0.0, 1.0);
  for (const double p : {0.001, 0.4, 0.99}) {  // P(sigma <= s) = (4 - 1/s^2) / (4 - 1/4)
    CHECK_THAT(exact_fit.quantile(0.0, p), WithinRel(1.0 / std::sqrt(4.0 - 3.75 * p), tolerance));
  }
  const double misfit =
      2e4;  // S / (2 b^2) = 1e6: the distance from the bound is exponential with mean b^3 / S
  const NoiseConditional pressed(10, {1e-4, 0.1}, misfit, misfit + 1.0);
  CHECK_THAT((0.1 - pressed.quantile(misfit, 0.5)) / (0.001 / misfit), WithinRel(std::log(2.0), 1e-4));
}
