#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "errors/invalid_value.hpp"
#include "statistics/summary.hpp"

using namespace statistics;
using Catch::Matchers::WithinRel;

namespace {

constexpr double rounding = 1e-12;

}  // namespace

TEST_CASE("moments of given values", "[summary]") {
  const std::vector<double> values{1.0, 2.0, 4.0, 9.0};
  CHECK(moments(values).mean == 4.0);
  CHECK_THAT(moments(values).standard_deviation, WithinRel(std::sqrt(38.0 / 3.0), rounding));
  const std::vector<double> one{-3.5};
  CHECK(moments(one).mean == -3.5);
  CHECK(std::isnan(moments(one).standard_deviation));
  const std::vector<double> equal(100, 7.25);
  CHECK(moments(equal).standard_deviation == 0.0);
  const std::vector<double> far{1e9 + 1.0, 1e9 + 2.0, 1e9 + 3.0};
  CHECK_THAT(moments(far).standard_deviation, WithinRel(1.0, rounding));
  CHECK_THROWS_AS(moments({}), errors::InvalidValue);
}

TEST_CASE("the root mean square of given values", "[summary]") {
  const std::vector<double> values{3.0, -4.0, 0.0, 5.0};
  CHECK_THAT(root_mean_square(values), WithinRel(std::sqrt(12.5), rounding));
  CHECK(root_mean_square({}) == 0.0);
}

TEST_CASE("the error of estimates, by hand", "[summary]") {
  const std::vector<double> estimates{2.0, 4.0, 9.0};
  const auto error = error_of(estimates, 4.0);
  CHECK(error.mean == 5.0);
  CHECK(error.bias == 1.0);
  CHECK_THAT(error.spread, WithinRel(std::sqrt(13.0), rounding));
  CHECK_THAT(error.standard_error, WithinRel(std::sqrt(13.0 / 3.0), rounding));
  CHECK_THAT(error.root_mean_square, WithinRel(std::sqrt(29.0 / 3.0), rounding));
  const auto single = error_of(std::vector<double>{2.0}, 3.0);
  CHECK(single.root_mean_square == 1.0);
  CHECK(std::isnan(single.spread));
  CHECK_THROWS_AS(error_of({}, 0.0), errors::InvalidValue);
}

TEST_CASE("evenly spaced values have both ends, and the upper one exactly", "[summary]") {
  CHECK(evenly_spaced(-1.0, 1.0, 5) == std::vector<double>{-1.0, -0.5, 0.0, 0.5, 1.0});
  CHECK(evenly_spaced(0.1, 0.9, 4).back() == 0.9);
  CHECK(evenly_spaced(2.0, 3.0, 2) == std::vector<double>{2.0, 3.0});
  CHECK_THROWS_AS(evenly_spaced(0.0, 1.0, 1), errors::InvalidValue);
}

TEST_CASE("a histogram counts each value in the bin whose lower end it has reached", "[summary]") {
  const std::vector<double> values{-0.1, 0.0, 0.24, 0.25, 0.5, 0.99, 1.0, 7.0};
  CHECK(histogram(values, 0.0, 1.0, 4) == std::vector<long>{2, 1, 1, 1});
  CHECK(histogram({}, 0.0, 1.0, 2) == std::vector<long>{0, 0});
  CHECK_THROWS_AS(histogram(values, 1.0, 1.0, 4), errors::InvalidValue);
  CHECK_THROWS_AS(histogram(values, 0.0, 1.0, 0), errors::InvalidValue);
}

TEST_CASE("weighted moments and histograms count weights as repeated values", "[statistics]") {
  const std::vector<double> x{1.0, 2.0, 4.0}, w{3.0, 1.0, 2.0}, ones(3, 0.4), zeros(3, 0.0);
  const auto m = statistics::moments(x, w);
  CHECK(m.mean == Approx(13.0 / 6.0));
  // sum w (x - mean)^2 = 3 (7/6)^2 + (1/6)^2 + 2 (11/6)^2; W - sum w^2 / W = 6 - 14/6
  CHECK(m.standard_deviation == Approx(std::sqrt((147.0 + 1.0 + 242.0) / 36.0 / (6.0 - 14.0 / 6.0))));
  CHECK(statistics::moments(x, ones).standard_deviation == statistics::moments(x).standard_deviation);
  CHECK_THROWS_AS(statistics::moments(x, zeros), errors::InvalidValue);
  CHECK_THROWS_AS(statistics::moments(x, std::vector<double>{1.0}), errors::InvalidValue);
  CHECK(statistics::histogram(x, w, 0.0, 4.0, 2) == std::vector<double>{3.0, 1.0});
}
