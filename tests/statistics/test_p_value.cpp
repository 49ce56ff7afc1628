#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "errors/invalid_value.hpp"
#include "statistics/counts.hpp"
#include "statistics/p_value.hpp"
#include "tmcmc/random.hpp"

using namespace statistics;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

std::vector<double> ramp(int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

}  // namespace

TEST_CASE("Monte Carlo p-values count the value itself", "[p_value]") {
  const auto null = ramp(99);
  CHECK_THAT(two_sided_p(null, 50.0).value, WithinAbs(1.0, 1e-15));
  CHECK_THAT(two_sided_p(null, 0.0).value, WithinAbs(2.0 / 100.0, 1e-15));
  CHECK_THAT(two_sided_p(null, 200.0).value, WithinAbs(2.0 / 100.0, 1e-15));
  CHECK_THAT(two_sided_p(null, 5.0).value, WithinAbs(2.0 * 6.0 / 100.0, 1e-15));
  CHECK_THAT(two_sided_p(null, 5.5).value, WithinAbs(2.0 * 6.0 / 100.0, 1e-15));
  CHECK_THAT(upper_p(null, 99.0).value, WithinAbs(2.0 / 100.0, 1e-15));
  CHECK_THAT(upper_p(null, 99.5).value, WithinAbs(1.0 / 100.0, 1e-15));
  SECTION("rounding makes ties of what prints alike") {
    CHECK_THAT(two_sided_p(null, 99.4, 0.5).value, WithinAbs(2.0 * 2.0 / 100.0, 1e-15));
    CHECK_THAT(two_sided_p(null, 99.6, 0.5).value, WithinAbs(2.0 * 1.0 / 100.0, 1e-15));
  }
}

TEST_CASE("quantiles and central intervals", "[p_value]") {
  const auto values = ramp(5);
  CHECK(sample_quantile(values, 0.0) == 1.0);
  CHECK(sample_quantile(values, 1.0) == 5.0);
  CHECK_THAT(sample_quantile(values, 0.3), WithinAbs(2.2, 1e-14));
  const auto interval = central_95(ramp(1001));
  CHECK_THAT(interval.low, WithinAbs(26.0, 1e-9));
  CHECK_THAT(interval.high, WithinAbs(976.0, 1e-9));
}

TEST_CASE("the standard error of a p-value is that of the draws", "[p_value]") {
  const auto null = ramp(99);
  CHECK_THAT(upper_p(null, 80.5).standard_error, WithinRel(std::sqrt(0.2 * 0.8 / 100.0), 1e-13));
  CHECK_THAT(two_sided_p(null, 80.5).standard_error, WithinRel(2.0 * std::sqrt(0.2 * 0.8 / 100.0), 1e-13));
  CHECK(upper_p(null, 1000.0).standard_error > 0.0);  // none of the draws is not no chance
}

TEST_CASE("Holm's adjustment", "[p_value]") {
  const auto adjusted = holm({{0.01, 0.001}, {0.04, 0.002}, {0.03, 0.003}, {0.005, 0.004}});
  CHECK_THAT(adjusted[3].value, WithinRel(0.02, 1e-12));
  CHECK_THAT(adjusted[0].value, WithinRel(0.03, 1e-12));
  CHECK_THAT(adjusted[2].value, WithinRel(0.06, 1e-12));
  CHECK_THAT(adjusted[1].value, WithinRel(0.06, 1e-12));  // monotone
  CHECK_THAT(adjusted[3].standard_error, WithinRel(4.0 * 0.004, 1e-12));
  CHECK_THAT(adjusted[0].standard_error, WithinRel(3.0 * 0.001, 1e-12));
  CHECK_THAT(adjusted[2].standard_error, WithinRel(2.0 * 0.003, 1e-12));
  CHECK_THAT(adjusted[1].standard_error, WithinRel(2.0 * 0.003, 1e-12));  // of the value that it takes over
  const auto capped = holm({{0.9, 0.1}, {0.8, 0.1}});
  CHECK(capped[0].value == 1.0);
  CHECK(capped[1].value == 1.0);
}

TEST_CASE("ratios of equals, against all pairs", "[p_value]") {
  const std::vector<double> sample = {1.0, 1.5, 0.7, 2.4, 1.1, 1.9, 0.4, 1.2};
  std::vector<double> ratios;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    for (std::size_t j = 0; j < sample.size(); ++j) {
      if (i != j) {
        ratios.push_back(sample[j] / sample[i]);
      }
    }
  }
  std::sort(ratios.begin(), ratios.end());
  for (const double printed : {1.3, 2.0, 5.0}) {
    CAPTURE(printed);
    const auto above = static_cast<double>(
        std::count_if(ratios.begin(), ratios.end(), [=](double r) { return r >= printed; }));
    const double tail = (above / 56.0 * 4.0 + 1.0) / 5.0;  // 8 numbers are 4 independent pairs
    CHECK_THAT(test_ratio_of_equals(sample, printed).p.value, WithinRel(std::min(1.0, 2.0 * tail), 1e-12));
    CHECK_THAT(test_ratio_of_equals(sample, 1.0 / printed).p.value,
               WithinRel(std::min(1.0, 2.0 * tail), 1e-12));
  }
  CHECK(test_ratio_of_equals(sample, 1.0).p.value == 1.0);
  CHECK(test_ratio_of_equals(sample, 100.0).p.standard_error > 0.0);
  const auto interval = test_ratio_of_equals(sample, 2.0).interval;
  CHECK_THAT(interval.high, WithinRel(ratios[54], 1e-12));  // 1 of 56 is beyond: the first share below 2.5 %
  CHECK_THAT(interval.low, WithinRel(1.0 / ratios[54], 1e-12));
  CHECK_THROWS_AS(test_ratio_of_equals({1.0}, 2.0), errors::InvalidValue);
  CHECK_THROWS_AS(test_ratio_of_equals({1.0, 0.0}, 2.0), errors::InvalidValue);
  CHECK_THROWS_AS(test_ratio_of_equals({1.0, 2.0}, -1.0), errors::InvalidValue);
}

TEST_CASE("the p-value of a ratio and its standard error, over many samples", "[p_value]") {
  // log-Normal with sd 0.3 of the logarithm: log ratios have sd 0.3 sqrt 2; at 2.0 the tail is
  // 0.0511
  constexpr int samples = 300;
  std::vector<double> p, error;
  for (int k = 0; k < samples; ++k) {
    std::vector<double> draws;
    for (int i = 0; i < 400; ++i) {
      const auto w = tmcmc::random_words({.seed = 11, .study = static_cast<std::uint32_t>(k)},
                                         {.row = static_cast<std::uint64_t>(i)});
      draws.push_back(std::exp(0.3 * tmcmc::normal_pair(w[0], w[1]).first));
    }
    const auto test = test_ratio_of_equals(draws, 2.0);
    p.push_back(test.p.value);
    error.push_back(test.p.standard_error);
  }
  const auto m = moments(p);
  const double exact = std::erfc(std::log(2.0) / (0.3 * std::sqrt(2.0)) / std::sqrt(2.0));
  const double with_own = (exact * 200.0 + 2.0) / 201.0;  // the printed pair counts
  CHECK_THAT(m.mean, WithinAbs(with_own, 4.0 * m.standard_deviation / std::sqrt(samples)));
  // the sd of an sd of 300 is 4 %
  CHECK_THAT(moments(error).mean, WithinRel(m.standard_deviation, 0.16));
}

TEST_CASE("multinomial probability in closed form", "[p_value]") {
  const std::map<std::int64_t, double> fair = {{0, 0.5}, {1, 0.5}};
  CHECK_THAT(log_multinomial({{0, 2}, {1, 2}}, fair), WithinRel(std::log(6.0 / 16.0), 1e-13));
  CHECK_THROWS_WITH(log_multinomial({{7, 1}}, fair), Contains("7"));
  const auto p = category_probabilities({{{9, 3}}, {{10, 5}}}, {{11, 0}});
  CHECK_THAT(p.at(9), WithinRel(3.5 / 9.5, 1e-13));
  CHECK_THAT(p.at(10), WithinRel(5.5 / 9.5, 1e-13));
  CHECK_THAT(p.at(11), WithinRel(0.5 / 9.5, 1e-13));
}

TEST_CASE("equivalence of medians", "[p_value]") {
  const auto base = ramp(200);
  std::vector<double> near, far;
  for (const double x : base) {
    near.push_back(x + 400.0);  // the ratio of two medians has an sd of 0.02, far within the margin
    far.push_back(2.0 * (x + 400.0));
  }
  const auto same = median_ratio_equivalence(near, near, 0.1, 1);
  CHECK(same.equivalent);
  CHECK_FALSE(same.different);
  CHECK_THAT(same.ratio, WithinAbs(1.0, 1e-15));
  CHECK_THAT(
      median_ratio_equivalence(std::vector<double>{2.0}, std::vector<double>{9.0, 2.0, 3.0, 1.0}, 0.1, 1)
          .ratio,
      WithinRel(1.25, 1e-14));
  const auto twice = median_ratio_equivalence(near, far, 0.1, 1);
  CHECK_FALSE(twice.equivalent);
  CHECK(twice.different);
  CHECK_THAT(twice.ratio, WithinRel(2.0, 1e-14));
  CHECK((twice.interval.low < 2.0 && twice.interval.high > 2.0));
  CHECK_THROWS_AS(median_ratio_equivalence({}, near, 0.1, 1), errors::InvalidValue);
  CHECK_THROWS_AS(median_ratio_equivalence(std::vector<double>{0.0}, near, 0.1, 1), errors::InvalidValue);
  // The bootstrap interval of a median of n Normal-like values has the width 2 * 1.96 * 1.2533 sd /
  // sqrt(n).
  std::vector<double> normal;
  for (int i = 0; i < 400; ++i) {
    const auto w = tmcmc::random_words({.seed = 5}, {.row = static_cast<std::uint64_t>(i)});
    normal.push_back(10.0 + tmcmc::normal_pair(w[0], w[1]).first);
  }
  const auto against_constant = median_ratio_equivalence(std::vector<double>{10.0}, normal, 0.1, 2);
  const double width = against_constant.interval.high - against_constant.interval.low;
  CHECK_THAT(width, WithinRel(2.0 * 1.96 * 1.2533 * 0.1 / 20.0, 0.35));
}

TEST_CASE("the percentile counts the value itself, and ties by rounding", "[p_value]") {
  const auto null = ramp(99);
  CHECK_THAT(percentile(null, 49.5), WithinAbs(50.0, 1e-12));
  CHECK_THAT(percentile(null, 0.0), WithinAbs(1.0, 1e-12));
  CHECK_THAT(percentile(null, 100.0), WithinAbs(100.0, 1e-12));
  CHECK_THAT(percentile(null, 49.6, 0.5), WithinAbs(51.0, 1e-12));
}

TEST_CASE("equivalence of means", "[p_value]") {
  // means 2 and 2.02, variances of the means 0.01/4 and 0.01/2
  const std::vector<double> first = {1.9, 2.1, 1.9, 2.1};
  const std::vector<double> second = {1.92, 2.12};
  const auto e = mean_ratio_equivalence(first, second, 0.2);
  CHECK_THAT(e.ratio, WithinRel(1.01, 1e-13));
  const double relative = std::sqrt(4.0 / 3.0 * 0.01 / 4.0 / 4.0 + 2.0 * 0.01 / 2.0 / (2.02 * 2.02));
  CHECK_THAT(e.interval.high - e.interval.low, WithinRel(2.0 * 1.96 * 1.01 * relative, 1e-12));
  CHECK(e.equivalent);
  CHECK_FALSE(e.different);
  CHECK_FALSE(mean_ratio_equivalence(first, second, 0.05).equivalent);
  CHECK_THROWS_AS(mean_ratio_equivalence(std::vector<double>{1.0}, second, 0.1), errors::InvalidValue);
  CHECK_THROWS_AS(mean_ratio_equivalence(first, std::vector<double>{1.0, 0.0}, 0.1), errors::InvalidValue);
}
