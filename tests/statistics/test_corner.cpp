#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "errors/invalid_value.hpp"
#include "statistics/corner.hpp"

using namespace statistics;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double rounding = 1e-12;

}  // namespace

TEST_CASE("a weighted quantile is the first value with enough weight at or below it", "[corner]") {
  const std::vector<double> values{3.0, 1.0, 2.0, 4.0};
  CHECK(weighted_quantile(values, {}, 0.5) == 2.0);
  CHECK(weighted_quantile(values, {}, 0.0) == 1.0);
  CHECK(weighted_quantile(values, {}, 1.0) == 4.0);
  const std::vector<double> weights{1.0, 0.0, 1.0, 6.0};
  CHECK(weighted_quantile(values, weights, 0.0) == 2.0);
  CHECK(weighted_quantile(values, weights, 0.25) == 3.0);
  CHECK(weighted_quantile(values, weights, 0.26) == 4.0);
  CHECK_THROWS_AS(weighted_quantile({}, {}, 0.5), errors::InvalidValue);
  CHECK_THROWS_AS(weighted_quantile(values, std::vector<double>{1.0}, 0.5), errors::InvalidValue);
  CHECK_THROWS_AS(weighted_quantile(values, std::vector<double>(4, 0.0), 0.5), errors::InvalidValue);
  CHECK_THROWS_AS(weighted_quantile(values, std::vector<double>{1.0, -1.0, 1.0, 1.0}, 0.5),
                  errors::InvalidValue);
}

TEST_CASE("the range of a panel holds the weight and stays within the values", "[corner]") {
  std::vector<double> values(2001);
  std::iota(values.begin(), values.end(), 0.0);
  const auto inner = panel_range(values, {});
  CHECK(inner.low == 0.0);
  CHECK(inner.high == 2000.0);
  values.push_back(1e9);  // one value far away does not decide the range
  CHECK(panel_range(values, {}).high < 2200.0);
  const std::vector<double> constant(5, 7.0);
  CHECK_THAT(panel_range(constant, {}).low, WithinAbs(6.965, rounding));
  CHECK_THAT(panel_range(constant, {}).high, WithinAbs(7.035, rounding));
  CHECK(panel_range(std::vector<double>(2, 0.0), {}).low == -0.5);
}

TEST_CASE("tics are a round distance apart, about a third of the range", "[corner]") {
  CHECK(tick_spacing({0.0, 3.0}) == 1.0);
  CHECK(tick_spacing({-1.0, 4.4}) == 2.0);
  CHECK(tick_spacing({0.0, 12.0}) == 5.0);
  CHECK(tick_spacing({0.0, 24.0}) == 10.0);
  CHECK(tick_spacing({0.981, 0.9872}) == 0.002);
  CHECK(tick_spacing({1e5, 7e5}) == 200000.0);
  for (double width = 1e-7; width < 1e7; width *= 1.03) {
    const double tics = width / tick_spacing({0.0, width});
    CHECK((tics > 2.0 && tics < 5.3));  // thirds from 0.7 to 1.75 times the distance
  }
  CHECK_THROWS_AS(tick_spacing({1.0, 1.0}), errors::InvalidValue);
}

TEST_CASE("a marginal density has the weight of its bins, and the upper end belongs to the last",
          "[corner]") {
  const std::vector<double> values{0.0, 0.5, 1.5, 2.0, 9.0};
  const std::vector<double> weights{1.0, 1.0, 2.0, 3.0, 1.0};
  const auto density = marginal_density(values, weights, {0.0, 2.0}, 2);
  REQUIRE(density.size() == 2);
  CHECK_THAT(density[0], WithinRel(2.0 / 8.0, rounding));
  CHECK_THAT(density[1], WithinRel(5.0 / 8.0, rounding));
  CHECK_THROWS_AS(marginal_density(values, weights, {2.0, 2.0}, 2), errors::InvalidValue);
  CHECK_THROWS_AS(marginal_density(values, weights, {0.0, 2.0}, 0), errors::InvalidValue);
}

TEST_CASE("the level of a cell is the probability of all cells at least as dense", "[corner]") {
  const std::vector<double> x{0.5, 0.5, 0.5, 1.5, 1.5, 0.5};
  const std::vector<double> y{1.0, 1.0, 1.0, 1.0, 3.0, 3.0};
  const auto pair = pair_density(x, y, {}, {0.0, 2.0}, {0.0, 4.0}, 2);
  REQUIRE(pair.level.size() == 4);  // (0, 0), (1, 0), (0, 1), (1, 1)
  CHECK_THAT(pair.level[0], WithinRel(0.5, rounding));
  for (const std::size_t equal : {1U, 2U, 3U}) {  // one sample each
    CHECK_THAT(pair.level[equal], WithinRel(1.0, rounding));
  }
  CHECK_THAT(pair.density[0], WithinRel(0.5 / 2.0, rounding));
  const std::vector<double> weights{0.0, 0.0, 0.0, 1.0, 0.0, 3.0};
  const auto weighted = pair_density(x, y, weights, {0.0, 2.0}, {0.0, 4.0}, 2);
  CHECK_THAT(weighted.level[2], WithinRel(0.75, rounding));
  CHECK(weighted.level[0] == 1.0);
  CHECK(weighted.density[0] == 0.0);
  CHECK_THROWS_AS(pair_density(x, std::vector<double>{1.0}, {}, {0.0, 2.0}, {0.0, 4.0}, 2),
                  errors::InvalidValue);
}
