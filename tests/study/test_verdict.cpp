#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "study/published.hpp"
#include "study/verdict.hpp"

using namespace study;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

std::vector<double> ramp(int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

/// Studies with areas base * (1 + k/n) and the given counts, for two samplers with a ratio between them.
std::vector<StudySummary> synthetic(int n, double ratio,
                                    const std::map<tmcmc::Index, tmcmc::Index>& second_counts) {
  std::vector<StudySummary> studies;
  for (int k = 0; k < n; ++k) {
    for (const char* sampler : {"A", "B"}) {
      StudySummary s;
      s.study = static_cast<std::uint32_t>(k);
      s.sampler = sampler;
      const bool second = s.sampler == "B";
      // the two samplers visit the same values in another order, so that pairs differ
      const int place = second ? (k * 37 + 11) % n : k;
      const double area = 0.1 * (1.0 + static_cast<double>(place) / n) * (second ? ratio : 1.0);
      s.areas = {area, 0.1 * area};
      const tmcmc::Index nines = k % 5;
      s.iterations = second ? second_counts
                            : std::map<tmcmc::Index, tmcmc::Index>{{9, nines}, {10, 46 - nines}, {11, 4}};
      studies.push_back(s);
    }
  }
  return studies;
}

}  // namespace

TEST_CASE("half a unit of the last printed digit", "[verdict]") {
  CHECK_THAT(rounding_half_width("0.08151"), WithinRel(5e-6, 1e-12));
  CHECK_THAT(rounding_half_width("0.008878"), WithinRel(5e-7, 1e-12));
  CHECK_THAT(rounding_half_width("9"), WithinRel(0.5, 1e-12));
  CHECK_THAT(rounding_half_width("10"), WithinRel(0.5, 1e-12));
  CHECK_THAT(rounding_half_width("8.915e-3"), WithinRel(5e-7, 1e-12));
  CHECK_THROWS_WITH(rounding_half_width("abc"), Contains("'abc'"));
  CHECK_THROWS_WITH(rounding_half_width("1.5x"), Contains("'1.5x'"));
}

TEST_CASE("Monte Carlo p-values count the value itself", "[verdict]") {
  const auto null = ramp(99);
  CHECK_THAT(two_sided_p(null, 50.0), WithinAbs(1.0, 1e-15));
  CHECK_THAT(two_sided_p(null, 0.0), WithinAbs(2.0 / 100.0, 1e-15));
  CHECK_THAT(two_sided_p(null, 200.0), WithinAbs(2.0 / 100.0, 1e-15));
  CHECK_THAT(two_sided_p(null, 5.0), WithinAbs(2.0 * 6.0 / 100.0, 1e-15));
  CHECK_THAT(two_sided_p(null, 5.5), WithinAbs(2.0 * 6.0 / 100.0, 1e-15));
  CHECK_THAT(upper_p(null, 99.0), WithinAbs(2.0 / 100.0, 1e-15));
  CHECK_THAT(upper_p(null, 99.5), WithinAbs(1.0 / 100.0, 1e-15));
  SECTION("rounding makes ties of what prints alike") {
    CHECK_THAT(two_sided_p(null, 99.4, 0.5), WithinAbs(2.0 * 2.0 / 100.0, 1e-15));
    CHECK_THAT(two_sided_p(null, 99.6, 0.5), WithinAbs(2.0 * 1.0 / 100.0, 1e-15));
  }
}

TEST_CASE("quantiles and central intervals", "[verdict]") {
  const auto values = ramp(5);
  CHECK(sample_quantile(values, 0.0) == 1.0);
  CHECK(sample_quantile(values, 1.0) == 5.0);
  CHECK_THAT(sample_quantile(values, 0.3), WithinAbs(2.2, 1e-14));
  const auto interval = central_95(ramp(1001));
  CHECK_THAT(interval.low, WithinAbs(26.0, 1e-9));
  CHECK_THAT(interval.high, WithinAbs(976.0, 1e-9));
}

TEST_CASE("Holm's adjustment", "[verdict]") {
  const auto adjusted = holm({0.01, 0.04, 0.03, 0.005});
  CHECK_THAT(adjusted[3], WithinRel(0.02, 1e-12));
  CHECK_THAT(adjusted[0], WithinRel(0.03, 1e-12));
  CHECK_THAT(adjusted[2], WithinRel(0.06, 1e-12));
  CHECK_THAT(adjusted[1], WithinRel(0.06, 1e-12));  // monotone
  CHECK(holm({0.9, 0.8}) == std::vector<double>{1.0, 1.0});
}

TEST_CASE("multinomial statistics in closed form", "[verdict]") {
  const std::map<std::int64_t, double> fair = {{0, 0.5}, {1, 0.5}};
  CHECK_THAT(deviance({{0, 5}, {1, 5}}, fair), WithinAbs(0.0, 1e-13));
  CHECK_THAT(deviance({{0, 10}, {1, 0}}, fair), WithinRel(20.0 * std::log(2.0), 1e-13));
  CHECK_THAT(log_multinomial({{0, 2}, {1, 2}}, fair), WithinRel(std::log(6.0 / 16.0), 1e-13));
  CHECK_THROWS_WITH(deviance({{7, 1}}, fair), Contains("7"));
  // two samples: 2 (5 log 2 + 5 log 2) for complete separation, 0 for equality
  CHECK_THAT(two_sample_deviance({{0, 5}}, {{1, 5}}), WithinRel(20.0 * std::log(2.0), 1e-13));
  CHECK_THAT(two_sample_deviance({{0, 3}, {1, 2}}, {{0, 6}, {1, 4}}), WithinAbs(0.0, 1e-12));
  const auto p = category_probabilities({{{9, 3}}, {{10, 5}}}, {{11, 0}});
  CHECK_THAT(p.at(9), WithinRel(3.5 / 9.5, 1e-13));
  CHECK_THAT(p.at(10), WithinRel(5.5 / 9.5, 1e-13));
  CHECK_THAT(p.at(11), WithinRel(0.5 / 9.5, 1e-13));
}

TEST_CASE("equivalence of medians", "[verdict]") {
  const auto base = ramp(200);
  std::vector<double> near, far;
  for (const double x : base) {
    near.push_back(x + 100.0);
    far.push_back(2.0 * (x + 100.0));
  }
  const auto same = median_ratio_equivalence(near, near, 0.1, 1);
  CHECK(same.equivalent);
  CHECK_FALSE(same.different);
  CHECK_THAT(same.ratio, WithinAbs(1.0, 1e-15));
  const auto twice = median_ratio_equivalence(near, far, 0.1, 1);
  CHECK_FALSE(twice.equivalent);
  CHECK(twice.different);
  CHECK_THAT(twice.ratio, WithinRel(2.0, 1e-14));
  CHECK((twice.interval.low < 2.0 && twice.interval.high > 2.0));
  CHECK_THROWS_AS(median_ratio_equivalence({}, near, 0.1, 1), std::invalid_argument);
  CHECK_THROWS_AS(median_ratio_equivalence(std::vector<double>{0.0}, near, 0.1, 1), std::invalid_argument);
  // The bootstrap interval of a median of n Normal-like values has the width 2 * 1.96 * 1.2533 sd / sqrt(n).
  std::vector<double> normal;
  for (int i = 0; i < 400; ++i) {
    const auto w = tmcmc::random_words({.seed = 5}, {.row = static_cast<std::uint64_t>(i)});
    normal.push_back(10.0 + tmcmc::normal_pair(w[0], w[1]).first);
  }
  const auto against_constant = median_ratio_equivalence(std::vector<double>{10.0}, normal, 0.1, 2);
  const double width = against_constant.interval.high - against_constant.interval.low;
  CHECK_THAT(width, WithinRel(2.0 * 1.96 * 1.2533 * 0.1 / 20.0, 0.35));
}

TEST_CASE("verdicts on contrasts", "[verdict]") {
  Equivalence e{};
  e.equivalent = true;
  CHECK(judge_contrast(0.5, e) == Verdict::consistent_with_chance);
  CHECK(judge_contrast(0.01, e) == Verdict::not_supported);
  e.equivalent = false;
  e.different = true;
  e.ratio = 1.5;
  CHECK(judge_contrast(0.01, e) == Verdict::reproduced);
  e.ratio = 0.5;
  CHECK(judge_contrast(0.01, e) == Verdict::contradicted);
  e.different = false;
  CHECK(judge_contrast(0.5, e) == Verdict::not_supported);
  CHECK(name_of(Verdict::internally_contradictory) == "internally contradictory");
}

TEST_CASE("a printed number that is moved out of its interval flips the verdict", "[verdict]") {
  const std::map<tmcmc::Index, tmcmc::Index> counts = {{9, 2}, {10, 44}, {11, 4}};
  const auto studies = synthetic(200, 1.0, counts);
  const std::vector<PrintedCounts> good_counts = {{"A", {{9, 2}, {10, 44}, {11, 4}}},
                                                  {"B", {{9, 2}, {10, 44}, {11, 4}}}};
  const auto good = judge_tables(studies, {{"A", 0, "0.150"}, {"B", 0, "0.150"}}, good_counts);
  CHECK(good.areas[0].reproduced);
  CHECK(good.areas[1].reproduced);
  CHECK(good.counts[0].reproduced);
  const auto moved = judge_tables(studies, {{"A", 0, "0.210"}, {"B", 0, "0.150"}}, good_counts);
  CHECK_FALSE(moved.areas[0].reproduced);
  CHECK(moved.areas[1].reproduced);
  const auto below = judge_tables(studies, {{"A", 0, "0.090"}, {"B", 0, "0.150"}}, good_counts);
  CHECK_FALSE(below.areas[0].reproduced);
  const auto other_counts = judge_tables(studies, {{"A", 0, "0.150"}}, {{"A", {{9, 2}, {10, 30}, {11, 18}}}});
  CHECK_FALSE(other_counts.counts[0].reproduced);
  CHECK_THROWS_WITH(judge_tables(studies, {{"C", 0, "0.15"}}, {}), Contains("'C'"));
}

TEST_CASE("samplers that differ are told apart, equal ones are equivalent", "[verdict]") {
  const std::map<tmcmc::Index, tmcmc::Index> same = {{9, 2}, {10, 44}, {11, 4}};
  const auto equal = synthetic(400, 1.0, same);
  const auto one = contrast_areas(equal, "A", "B", 0, 1.1, 0.1, 1);
  CHECK(one.replicated.equivalent);
  CHECK(one.p > 0.5);
  CHECK(judge_contrast(one.p, one.replicated) == Verdict::consistent_with_chance);
  const auto double_area = synthetic(400, 2.0, same);
  const auto two = contrast_areas(double_area, "A", "B", 0, 2.0, 0.1, 1);
  CHECK(two.replicated.different);
  CHECK(judge_contrast(two.p, two.replicated) == Verdict::reproduced);
  const auto fewer = synthetic(400, 1.0, {{7, 50}});
  const auto counts = contrast_iterations(fewer, {{10, 50}}, {{7, 50}}, "A", "B", 0.02, 1);
  CHECK(counts.replicated.different);
  CHECK(counts.replicated.ratio < 0.75);
}

TEST_CASE("the likelihood of the tables is that of a Normal and a multinomial", "[verdict]") {
  const auto studies = synthetic(100, 1.0, {{10, 50}});
  const auto at = [&](const char* area) {
    return log_likelihood_of_tables(studies, {{"A", 0, area}}, {{"A", {{9, 2}, {10, 44}, {11, 4}}}});
  };
  // Normal in log(area): the ratio of two values follows from mean and sd of the logs.
  std::vector<double> logs;
  for (const auto& s : studies_of(studies, "A")) {
    logs.push_back(std::log(s.areas[0]));
  }
  const auto m = moments(logs);
  const auto density = [&](double area) {
    const double z = (std::log(area) - m.mean) / m.standard_deviation;
    return -0.5 * z * z;
  };
  CHECK_THAT(at("0.2") - at("0.15"), WithinAbs(density(0.2) - density(0.15), 1e-10));
}
