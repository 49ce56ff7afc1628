#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "errors/invalid_value.hpp"
#include "estimation/posterior_predictive.hpp"
#include "portable_math/normal_quantile.hpp"

using namespace estimation;
using Catch::Matchers::WithinAbs;

namespace {

const friction::Physics physics{};
constexpr double ratio = 0.8;

/// Draws of a known force, with the errors at equal steps of probability: their quantiles are those
/// of the normal distribution, to 3e-3.
std::vector<PredictiveDraw> draws_at(double friction_force_n, double phase_noise_deg, int n = 4001) {
  std::vector<PredictiveDraw> draws;
  for (int i = 0; i < n; ++i) {
    const double z = portable_math::normal_quantile((i + 0.5) / n);
    draws.push_back({{friction_force_n, 3.0, phase_noise_deg, 0.02}, z, -z});
  }
  return draws;
}

double phase_at(double friction_force_n) {
  return friction::phase_deg(friction::response_constants(ratio, physics),
                             friction_force_n / physics.driving_force_n);
}

}  // namespace

TEST_CASE("with known parameters the band of a phase is that of its noise", "[predictive]") {
  const auto band = phase_band(draws_at(1.0, 2.0), ratio, physics);
  CHECK_THAT(band.median, WithinAbs(phase_at(1.0), 1e-12));
  CHECK_THAT(band.model_low, WithinAbs(phase_at(1.0), 1e-12));
  CHECK_THAT(band.low, WithinAbs(phase_at(1.0) - 2.0 * 1.959964, 6e-3));
  CHECK_THAT(band.high, WithinAbs(phase_at(1.0) + 2.0 * 1.959964, 6e-3));
  CHECK(band.share == 1.0);
}

TEST_CASE("with known parameters the band of a frequency ratio is that of its noise", "[predictive]") {
  const auto band = ratio_band(draws_at(1.0, 2.0), 2.4);
  CHECK_THAT(band.median, WithinAbs(0.8, 1e-12));
  CHECK_THAT(band.low, WithinAbs(0.8 - 0.02 * 1.959964, 6e-5));
  CHECK_THAT(band.high, WithinAbs(0.8 + 0.02 * 1.959964, 6e-5));
}

TEST_CASE("draws without continuous motion are left out of a band", "[predictive]") {
  auto draws = draws_at(1.0, 2.0, 100);
  const auto stuck = draws_at(2.4999, 2.0, 300);
  draws.insert(draws.end(), stuck.begin(), stuck.end());
  const auto band = phase_band(draws, ratio, physics);
  CHECK(band.share == 0.25);
  CHECK_THAT(band.median, WithinAbs(phase_at(1.0), 1e-12));
  const auto none = phase_band(stuck, ratio, physics);
  CHECK(none.share == 0.0);
  CHECK(std::isnan(none.low));
  CHECK(std::isnan(phase_probability(stuck, ratio, 20.0, physics)));
}

TEST_CASE("the probability of an observation is its normal distribution function", "[predictive]") {
  const auto draws = draws_at(1.0, 2.0, 10);
  CHECK_THAT(phase_probability(draws, ratio, phase_at(1.0) + 2.0, physics),
             WithinAbs(0.841344746068543, 1e-12));
  CHECK_THAT(phase_probability(draws, ratio, phase_at(1.0) + 2.0 - 360.0, physics),
             WithinAbs(0.841344746068543, 1e-12));  // the same angle
  CHECK_THAT(ratio_probability(draws, 2.4, 0.8 - 0.02), WithinAbs(0.158655253931457, 1e-12));
}

TEST_CASE("what cannot be predicted is refused", "[predictive]") {
  CHECK_THROWS_AS(phase_band({}, ratio, physics), errors::InvalidValue);
  CHECK_THROWS_AS(ratio_band({}, 2.0), errors::InvalidValue);
  CHECK_THROWS_AS(phase_band(draws_at(1.0, 2.0, 3), 1.0, physics), errors::InvalidValue);
}
