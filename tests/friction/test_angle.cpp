// Residuals of angles: whole turns do not count, and a residual inside a half turn is not touched.

#include <boost/math/differentiation/autodiff.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "friction/angle.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using friction::angle_residual_deg;
using friction::within_a_turn_deg;

constexpr double rounding = 1e-13;  // of numbers up to 540

}  // namespace

TEST_CASE("the residual of an angle is the shortest rotation", "[friction][angle]") {
  CHECK(angle_residual_deg(10.0, 4.0) == 6.0);
  CHECK(angle_residual_deg(-179.0, 179.0) == 2.0);
  CHECK(angle_residual_deg(359.0, 1.0) == -2.0);
  CHECK(angle_residual_deg(-359.0, 1.0) == 0.0);
  CHECK(angle_residual_deg(180.0, 0.0) == 180.0);
  CHECK(angle_residual_deg(-180.0, 0.0) == 180.0);  // the half turn has one sign
  CHECK(angle_residual_deg(std::nextafter(180.0, 360.0), 0.0) < -179.9);
  CHECK(std::isnan(angle_residual_deg(10.0, std::nan(""))));
}

TEST_CASE("a residual within a half turn keeps every bit", "[friction][angle]") {
  std::mt19937_64 random(3);
  for (int i = 0; i < 10000; ++i) {
    const double modelled = 180.0 * static_cast<double>(random() >> 11U) * 0x1p-53;
    const double observed = modelled - 179.99 + 359.98 * static_cast<double>(random() >> 11U) * 0x1p-53;
    REQUIRE(angle_residual_deg(observed, modelled) == observed - modelled);
  }
}

TEST_CASE("a whole turn more or less is the same measurement", "[friction][angle]") {
  for (double modelled = 0.0; modelled <= 180.0; modelled += 7.5) {
    for (double observed = 0.25; observed < 360.0; observed += 11.0) {
      const double residual = angle_residual_deg(observed, modelled);
      CHECK_THAT(angle_residual_deg(observed - 360.0, modelled), WithinAbs(residual, rounding));
      CHECK(residual > -180.0);
      CHECK(residual <= 180.0);
    }
  }
}

TEST_CASE("the derivative of a residual is that of the model, across the half turn too",
          "[friction][angle]") {
  const auto modelled = boost::math::differentiation::make_fvar<double, 1>(170.0);
  for (const double observed : {160.0, -175.0, 355.0}) {
    const auto residual = angle_residual_deg(observed, modelled);
    CHECK(residual.derivative(1U) == -1.0);
    CHECK(residual.derivative(0U) == angle_residual_deg(observed, 170.0));
  }
}

TEST_CASE("a measured angle is kept as it is up to a turn and reduced beyond", "[friction][angle]") {
  for (const double kept : {0.0, 180.1, -179.9, 360.0, -360.0}) {
    CHECK(within_a_turn_deg(kept) == kept);
  }
  CHECK(within_a_turn_deg(370.0) == 10.0);
  CHECK(within_a_turn_deg(-541.0) == 179.0);
  CHECK(within_a_turn_deg(7200.5) == 0.5);
}
