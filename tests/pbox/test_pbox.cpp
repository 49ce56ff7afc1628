#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <vector>

#include "errors/invalid_value.hpp"
#include "pbox/pbox.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using pbox::Ecdf;

namespace {

constexpr double rounding = 1e-12;

using Samples = std::vector<double>;

std::vector<Ecdf> ecdfs_of(const std::vector<Samples>& samples) {
  return std::vector<Ecdf>(samples.begin(), samples.end());
}

double metric(const std::vector<Samples>& samples) {
  return pbox::area_metric(ecdfs_of(samples));
}

// A coarse grid makes ties within and between samples frequent. Plain mt19937_64 output, so that
// every standard library draws the same samples.
Samples random_samples(std::mt19937_64& random, std::size_t size, bool tied) {
  Samples samples(size);
  for (double& x : samples) {
    const auto bits = random() >> 11U;
    x = tied ? static_cast<double>(bits % 12U) : static_cast<double>(bits) * 0x1p-53 * 10.0 - 5.0;
  }
  return samples;
}

double brute_fraction(const Samples& samples, double x) {
  const auto below = std::count_if(samples.begin(), samples.end(), [x](double s) { return s <= x; });
  return static_cast<double>(below) / static_cast<double>(samples.size());
}

}  // namespace

TEST_CASE("an ECDF counts the samples that are not larger", "[pbox]") {
  const Ecdf ecdf({3.0, 1.0, 2.0, 2.0});
  CHECK(std::vector(ecdf.sorted().begin(), ecdf.sorted().end()) == Samples{1.0, 2.0, 2.0, 3.0});
  CHECK(ecdf(0.999) == 0.0);
  CHECK(ecdf(1.0) == 0.25);
  CHECK(ecdf(std::nextafter(2.0, 0.0)) == 0.25);
  CHECK(ecdf(2.0) == 0.75);
  CHECK(ecdf(3.0) == 1.0);
  CHECK(ecdf(std::numeric_limits<double>::infinity()) == 1.0);
}

TEST_CASE("an ECDF refuses no samples and samples that are not finite", "[pbox]") {
  CHECK_THROWS_AS(Ecdf({}), errors::InvalidValue);
  CHECK_THROWS_AS(Ecdf({1.0, std::numeric_limits<double>::quiet_NaN()}), errors::InvalidValue);
  CHECK_THROWS_AS(Ecdf({std::numeric_limits<double>::infinity()}), errors::InvalidValue);
  CHECK_THROWS_AS(Ecdf({-std::numeric_limits<double>::infinity(), 0.0}), errors::InvalidValue);
}

TEST_CASE("the area metric has its known values", "[pbox]") {
  const Samples six{1.0, 2.68, 7.52, 7.73, 9.44, 3.66};
  CHECK(metric({{1, 2, 3}, {1, 2, 3}}) == 0.0);
  CHECK_THAT(metric({{1}, {3, 3, 3}}), WithinAbs(2.0, rounding));
  CHECK_THAT(metric({{1}, {5}}), WithinAbs(4.0, rounding));
  CHECK_THAT(metric({{1, 2, 3}, {3, 3, 3, 5, 6, 7}}), WithinAbs(2.5, rounding));
  CHECK_THAT(metric({six, {1.52, 2.98, 7.67, 8.35, 9.99, 4.58}}), WithinAbs(0.51, rounding));
  CHECK_THAT(metric({six, {3.5, 6.9, 6.1, 2.8, 3.5, 6.5, 0.15, 4.5, 7.1}}),
             WithinAbs(1.266111111111111, rounding));
}

TEST_CASE("one ECDF is its own p-box, of area zero", "[pbox]") {
  const std::vector<Ecdf> one = ecdfs_of({{2, 1, 2}});
  const pbox::PBox box = pbox::envelope(one);
  CHECK(box.x == Samples{1, 2});
  CHECK(box.lower == box.upper);
  CHECK(box.upper == Samples{1.0 / 3.0, 1.0});
  CHECK(pbox::area(box) == 0.0);
  CHECK(pbox::area_metric(one) == 0.0);
  CHECK(metric({{7}}) == 0.0);
  CHECK(metric({{4, 4, 4}, {4}}) == 0.0);
}

TEST_CASE("crossing ECDFs give a p-box that follows neither", "[pbox]") {
  // {0, 10} and {4, 5} cross: one is above on [0, 4) and [5, 10) takes the other.
  const pbox::PBox box = pbox::envelope(ecdfs_of({{0, 10}, {4, 5}}));
  CHECK(box.x == Samples{0, 4, 5, 10});
  CHECK(box.lower == Samples{0, 0.5, 0.5, 1});
  CHECK(box.upper == Samples{0.5, 0.5, 1, 1});
  CHECK(pbox::area(box) == 4 * 0.5 + 5 * 0.5);
}

TEST_CASE("a p-box is evaluated from the right, and beyond its ends", "[pbox]") {
  const pbox::PBox box = pbox::envelope(ecdfs_of({{0, 10}, {4, 5}}));
  const auto check = [&box](double x, double lower, double upper) {
    const pbox::Bounds bounds = pbox::evaluate(box, x);
    CAPTURE(x);
    CHECK(bounds.lower == lower);
    CHECK(bounds.upper == upper);
  };
  check(-1.0, 0.0, 0.0);
  check(0.0, 0.0, 0.5);
  check(3.9, 0.0, 0.5);
  check(5.0, 0.5, 1.0);
  check(std::nextafter(10.0, 0.0), 0.5, 1.0);
  check(10.0, 1.0, 1.0);
  check(1e300, 1.0, 1.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(pbox::evaluate(box, nan).lower));
  CHECK(std::isnan(pbox::evaluate(box, nan).upper));
  CHECK(std::isnan(pbox::Ecdf({1.0, 2.0})(nan)));
}

TEST_CASE("empty sets and inconsistent p-boxes are refused", "[pbox]") {
  CHECK_THROWS_AS(pbox::envelope({}), errors::InvalidValue);
  CHECK_THROWS_AS(pbox::area_metric({}), errors::InvalidValue);
  CHECK_THROWS_AS(pbox::area({}), errors::InvalidValue);
  CHECK_THROWS_AS(pbox::evaluate({}, 0.0), errors::InvalidValue);
  CHECK_THROWS_AS(pbox::area({{0, 1}, {0}, {1, 1}}), errors::InvalidValue);
}

TEST_CASE("the envelope is the minimum and maximum over all ECDFs at every breakpoint", "[pbox]") {
  std::mt19937_64 random(20030101);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Samples> sets(1 + random() % 7);
    for (Samples& set : sets) set = random_samples(random, 1 + random() % 40, trial % 2 == 0);
    const pbox::PBox box = pbox::envelope(ecdfs_of(sets));

    Samples breakpoints;
    for (const Samples& set : sets) breakpoints.insert(breakpoints.end(), set.begin(), set.end());
    std::sort(breakpoints.begin(), breakpoints.end());
    breakpoints.erase(std::unique(breakpoints.begin(), breakpoints.end()), breakpoints.end());
    REQUIRE(box.x == breakpoints);

    double expected_area = 0.0;
    for (std::size_t i = 0; i < breakpoints.size(); ++i) {
      double lower = 1.0;
      double upper = 0.0;
      for (const Samples& set : sets) {
        lower = std::min(lower, brute_fraction(set, breakpoints[i]));
        upper = std::max(upper, brute_fraction(set, breakpoints[i]));
      }
      REQUIRE(box.lower[i] == lower);
      REQUIRE(box.upper[i] == upper);
      if (i + 1 < breakpoints.size())
        expected_area += (upper - lower) * (breakpoints[i + 1] - breakpoints[i]);
    }
    CHECK(box.lower.back() == 1.0);
    CHECK_THAT(pbox::area(box), WithinAbs(expected_area, rounding));
    CHECK_THAT(metric(sets), WithinAbs(expected_area, rounding));
  }
}

TEST_CASE("equal sizes: the rank formula is the area of the envelope", "[pbox]") {
  std::mt19937_64 random(50);
  for (const std::size_t size : {1U, 2U, 17U, 500U}) {
    for (const bool tied : {false, true}) {
      std::vector<Samples> sets;
      for (int r = 0; r < 20; ++r) sets.push_back(random_samples(random, size, tied));
      const std::vector<Ecdf> ecdfs = ecdfs_of(sets);
      CHECK_THAT(pbox::area_metric(ecdfs), WithinRel(pbox::area(pbox::envelope(ecdfs)), rounding));
    }
  }
}

TEST_CASE("shifting changes no area and scaling scales it", "[pbox]") {
  std::mt19937_64 random(7);
  for (const std::size_t second_size : {30U, 41U}) {
    const std::vector<Samples> sets{random_samples(random, 30, false),
                                    random_samples(random, second_size, false)};
    const auto transformed = [&sets](double factor, double shift) {
      std::vector<Samples> out = sets;
      for (Samples& set : out) {
        for (double& x : set) x = factor * x + shift;
      }
      return metric(out);
    };
    const double original = metric(sets);
    REQUIRE(original > 0.1);
    CHECK_THAT(transformed(1.0, 123.0), WithinRel(original, 1e-11));
    CHECK_THAT(transformed(1e-9, 0.0), WithinRel(1e-9 * original, rounding));
    CHECK_THAT(transformed(-3.0, 1.0), WithinRel(3.0 * original, rounding));
    CHECK(transformed(4.0, 0.0) == 4.0 * original);
  }
}

TEST_CASE("for two samples of equal size the area is their 1-Wasserstein distance", "[pbox]") {
  std::mt19937_64 random(11);
  Samples a = random_samples(random, 64, false);
  Samples b = random_samples(random, 64, false);
  const double area = metric({a, b});
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  const double transport = std::transform_reduce(a.begin(), a.end(), b.begin(), 0.0, std::plus<>(),
                                                 [](double x, double y) { return std::abs(x - y); });
  CHECK_THAT(area, WithinRel(transport / 64.0, rounding));
}

TEST_CASE("the order of the ECDFs does not change a bit, and more ECDFs never shrink the area", "[pbox]") {
  std::mt19937_64 random(13);
  std::vector<Samples> sets;
  double previous = 0.0;
  for (int r = 0; r < 10; ++r) {
    sets.push_back(random_samples(random, 10 + random() % 20, false));
    const double now = metric(sets);
    CHECK(now >= previous - rounding);
    previous = now;
  }
  std::vector<Samples> reversed(sets.rbegin(), sets.rend());
  CHECK(metric(reversed) == metric(sets));
}

TEST_CASE("an area is finite wherever a double holds it", "[pbox]") {
  const double largest = std::numeric_limits<double>::max();
  // Rank by rank: the sum over the ranks, and the width of a rank, exceed the largest double.
  CHECK_THAT(metric({Samples(8, 0.45 * largest), Samples(8, -0.45 * largest)}),
             WithinRel(0.9 * largest, rounding));
  CHECK_THAT(metric({{-0.75 * largest, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.75 * largest}}),
             WithinRel(0.375 * largest, rounding));
  CHECK_THAT(metric({{-0.9 * largest, 1.0, 2.0, 3.0}, {0.9 * largest, 1.0, 2.0, 3.0}}),
             WithinRel(0.45 * largest, rounding));
  // By the envelope: unequal sizes; widths where the bounds coincide count nothing.
  CHECK_THAT(metric({Samples(7, 0.45 * largest), Samples(3, -0.45 * largest)}),
             WithinRel(0.9 * largest, rounding));
  CHECK(metric({{-largest, largest}, {-largest, -largest, largest, largest}}) == 0.0);
  CHECK_THAT(pbox::area({{-largest, largest}, {0.25, 1.0}, {0.75, 1.0}}), WithinRel(largest, rounding));
  // What no double holds is infinite, and small samples keep their digits.
  CHECK(metric({{-largest}, {largest}}) == std::numeric_limits<double>::infinity());
  CHECK(metric({{0.0}, {5e-324}}) == 5e-324);
  CHECK(metric({{0.0, 1e-310}, {0.0}}) == 0.5e-310);
}

TEST_CASE("a weighted ECDF has the fraction of the weight") {
  const pbox::Ecdf ecdf({3.0, 1.0, 2.0, 9.0}, std::vector<double>{2.0, 1.0, 1.0, 0.0});
  CHECK(ecdf(0.9) == 0.0);
  CHECK(ecdf(1.0) == 0.25);
  CHECK(ecdf(2.5) == 0.5);
  CHECK(ecdf(3.0) == 1.0);
  CHECK(ecdf.size() == 3);
  CHECK(ecdf.is_weighted());
}

TEST_CASE("weights count as repeated samples do") {
  const std::vector<double> a{1.0, 2.0, 4.0};
  const std::vector<pbox::Ecdf> weighted{{a, std::vector<double>{3.0, 1.0, 2.0}},
                                         pbox::Ecdf({1.5, 3.0, 3.5})};
  const std::vector<pbox::Ecdf> repeated{pbox::Ecdf({1.0, 1.0, 1.0, 2.0, 4.0, 4.0}),
                                         pbox::Ecdf({1.5, 3.0, 3.5})};
  CHECK(pbox::area_metric(weighted) == Approx(pbox::area_metric(repeated)).epsilon(1e-14));
  const auto box = pbox::envelope(weighted);
  const auto same = pbox::envelope(repeated);
  for (const double x : {0.5, 1.0, 1.7, 2.0, 3.2, 4.0, 5.0}) {
    CAPTURE(x);
    CHECK(pbox::evaluate(box, x).lower == Approx(pbox::evaluate(same, x).lower).epsilon(1e-14));
    CHECK(pbox::evaluate(box, x).upper == Approx(pbox::evaluate(same, x).upper).epsilon(1e-14));
  }
}

TEST_CASE("equal weights give the unweighted area to the last bit; the scale of weights does not matter") {
  const std::vector<double> a{0.1, 0.7, 0.3}, b{0.2, 0.9, 0.4}, ones(3, 0.7), w{1.0, 2.0, 3.0},
      large{1e300, 2e300, 3e300};
  CHECK(pbox::area_metric(std::vector<pbox::Ecdf>{{a, ones}, {b, ones}}) ==
        pbox::area_metric(std::vector<pbox::Ecdf>{pbox::Ecdf(a), pbox::Ecdf(b)}));
  CHECK(pbox::Ecdf(a, w)(0.3) == Approx(pbox::Ecdf(a, large)(0.3)).epsilon(1e-14));
}

TEST_CASE("bad weights are refused") {
  const auto make = [](std::vector<double> samples, const std::vector<double>& weights) {
    return pbox::Ecdf(std::move(samples), weights);
  };
  CHECK_THROWS_AS(make({1.0, 2.0}, {1.0}), errors::InvalidValue);
  CHECK_THROWS_AS(make({1.0, 2.0}, {1.0, -1.0}), errors::InvalidValue);
  CHECK_THROWS_AS(make({1.0, 2.0}, {0.0, 0.0}), errors::InvalidValue);
  CHECK_THROWS_AS(make({1.0, 2.0}, {1.0, std::nan("")}), errors::InvalidValue);
  CHECK_THROWS_AS(make({}, {}), errors::InvalidValue);
  CHECK_THROWS_AS(make({1.0, std::nan("")}, {1.0, 2.0}), errors::InvalidValue);
}
