#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "errors/invalid_value.hpp"
#include "portable_math/normal_quantile.hpp"
#include "statistics/predictive_band.hpp"

using namespace statistics;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double rounding = 1e-11;
constexpr double z_975 = 1.959963984540054;

double normal_cdf(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

/// n quantiles of the normal distribution, evenly spaced in probability.
std::vector<double> normal_draws(std::size_t n, double mean, double sd) {
  std::vector<double> draws;
  for (std::size_t i = 0; i < n; ++i) {
    draws.push_back(
        mean + sd * portable_math::normal_quantile((static_cast<double>(i) + 0.5) / static_cast<double>(n)));
  }
  return draws;
}

}  // namespace

TEST_CASE("draws that agree leave the noise alone", "[predictive]") {
  const auto band = predictive_band(std::vector<double>(7, 3.0), std::vector<double>(7, 0.5), 3.4);
  CHECK(band.median == 3.0);
  CHECK(band.model.low == 3.0);
  CHECK(band.model.high == 3.0);
  CHECK_THAT(band.measurement.low, WithinRel(3.0 - 0.5 * z_975, rounding));
  CHECK_THAT(band.measurement.high, WithinRel(3.0 + 0.5 * z_975, rounding));
  CHECK_THAT(band.standard_deviation, WithinRel(0.5, rounding));
  CHECK_THAT(band.probability_below, WithinRel(normal_cdf(0.8), rounding));
}

TEST_CASE("a single draw is a normal distribution", "[predictive]") {
  const auto band = predictive_band(std::vector<double>{-2.0}, std::vector<double>{0.1}, -2.0);
  CHECK(band.median == -2.0);
  CHECK_THAT(band.measurement.high, WithinRel(-2.0 + 0.1 * z_975, rounding));
  CHECK_THAT(band.probability_below, WithinRel(0.5, rounding));
}

TEST_CASE("normal outputs and noise give the normal distribution of their sum", "[predictive]") {
  // m ~ N(10, 3), sigma = 4: y ~ N(10, 5). The quantiles in the place of draws leave out 1e-4 of
  // the variance.
  constexpr std::size_t n = 20000;
  constexpr double left_out = 2e-4;
  constexpr double one_draw = 3.0 / (20000 * 0.0584);  // between the draws at the ends of the model's band
  const auto band = predictive_band(normal_draws(n, 10.0, 3.0), std::vector<double>(n, 4.0), 14.0);
  CHECK_THAT(band.median, WithinAbs(10.0, 1e-9));
  CHECK_THAT(band.model.low, WithinAbs(10.0 - 3.0 * z_975, one_draw));
  CHECK_THAT(band.model.high, WithinAbs(10.0 + 3.0 * z_975, one_draw));
  CHECK_THAT(band.measurement.low, WithinAbs(10.0 - 5.0 * z_975, 5.0 * left_out));
  CHECK_THAT(band.measurement.high, WithinAbs(10.0 + 5.0 * z_975, 5.0 * left_out));
  CHECK_THAT(band.standard_deviation, WithinAbs(5.0, 5.0 * left_out));
  CHECK_THAT(band.probability_below, WithinAbs(normal_cdf(0.8), left_out));
}

TEST_CASE("each draw has its own noise", "[predictive]") {
  // Half of the draws around 0 with 1, half around 100 with 10: between them is nothing.
  const std::vector<double> outputs{0.0, 100.0}, noise{1.0, 10.0};
  const auto band = predictive_band(outputs, noise, 30.0);
  CHECK_THAT(band.probability_below, WithinAbs(0.5, 1e-11));
  CHECK_THAT(normal_cdf(band.measurement.low) + normal_cdf((band.measurement.low - 100.0) / 10.0),
             WithinAbs(0.05, rounding));
  CHECK_THAT(normal_cdf(band.measurement.high) + normal_cdf((band.measurement.high - 100.0) / 10.0),
             WithinAbs(1.95, rounding));
  CHECK_THAT(band.standard_deviation, WithinRel(std::sqrt(2500.0 + 50.5), rounding));
  CHECK(band.median == 50.0);
}

TEST_CASE("the band moves and stretches with the unit", "[predictive]") {
  const std::vector<double> outputs{1.0, 2.0, 4.0}, noise{0.5, 0.1, 1.0};
  const auto band = predictive_band(outputs, noise, 3.0);
  for (const double scale : {1e-9, 1e9}) {
    std::vector<double> scaled, scaled_noise;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      scaled.push_back(scale * outputs[i]);
      scaled_noise.push_back(scale * noise[i]);
    }
    const auto of_unit = predictive_band(scaled, scaled_noise, scale * 3.0);
    CHECK_THAT(of_unit.measurement.low, WithinRel(scale * band.measurement.low, rounding));
    CHECK_THAT(of_unit.measurement.high, WithinRel(scale * band.measurement.high, rounding));
    CHECK_THAT(of_unit.standard_deviation, WithinRel(scale * band.standard_deviation, rounding));
    CHECK_THAT(of_unit.probability_below, WithinRel(band.probability_below, rounding));
  }
}

TEST_CASE("a noise that is tiny against the spread leaves the quantiles of the outputs", "[predictive]") {
  constexpr std::size_t n = 1000;
  std::vector<double> outputs;
  for (std::size_t i = 0; i < n; ++i) {
    outputs.push_back(static_cast<double>(i));
  }
  const auto band = predictive_band(outputs, std::vector<double>(n, 1e-6), 500.25);
  CHECK(band.measurement.low >= 24.0);
  CHECK(band.measurement.low <= 25.0);
  CHECK(band.measurement.high >= 974.0);
  CHECK(band.measurement.high <= 975.0);
  CHECK_THAT(band.probability_below, WithinAbs(0.501, rounding));
}

TEST_CASE("bands of nothing or of numbers that are none are refused", "[predictive]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  using Numbers = std::vector<double>;
  CHECK_THROWS_AS(predictive_band(Numbers{}, Numbers{}, 0.0), errors::InvalidValue);
  CHECK_THROWS_AS(predictive_band(Numbers{1.0, 2.0}, Numbers{1.0}, 0.0), errors::InvalidValue);
  for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK_THROWS_AS(predictive_band(Numbers{1.0, bad}, Numbers{1.0, 1.0}, 0.0), errors::InvalidValue);
    CHECK_THROWS_AS(predictive_band(Numbers{1.0, 2.0}, Numbers{1.0, bad}, 0.0), errors::InvalidValue);
    CHECK_THROWS_AS(predictive_band(Numbers{1.0, 2.0}, Numbers{1.0, 1.0}, bad), errors::InvalidValue);
  }
  CHECK_THROWS_AS(predictive_band(Numbers{1.0}, Numbers{0.0}, 0.0), errors::InvalidValue);
  CHECK_THROWS_AS(predictive_band(Numbers{1.0}, Numbers{-1.0}, 0.0), errors::InvalidValue);
}
