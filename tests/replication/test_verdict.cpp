#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "errors/invalid_value.hpp"
#include "replication/published.hpp"
#include "replication/verdict.hpp"
#include "tmcmc/random.hpp"

using namespace replication;
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
  CHECK_THROWS_WITH(rounding_half_width("abc"), Contains("= abc:"));
  CHECK_THROWS_WITH(rounding_half_width("1.5x"), Contains("= 1.5x:"));
}

TEST_CASE("Monte Carlo p-values count the value itself", "[verdict]") {
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

TEST_CASE("quantiles and central intervals", "[verdict]") {
  const auto values = ramp(5);
  CHECK(sample_quantile(values, 0.0) == 1.0);
  CHECK(sample_quantile(values, 1.0) == 5.0);
  CHECK_THAT(sample_quantile(values, 0.3), WithinAbs(2.2, 1e-14));
  const auto interval = central_95(ramp(1001));
  CHECK_THAT(interval.low, WithinAbs(26.0, 1e-9));
  CHECK_THAT(interval.high, WithinAbs(976.0, 1e-9));
}

TEST_CASE("the standard error of a p-value is that of the draws", "[verdict]") {
  const auto null = ramp(99);
  CHECK_THAT(upper_p(null, 80.5).standard_error, WithinRel(std::sqrt(0.2 * 0.8 / 100.0), 1e-13));
  CHECK_THAT(two_sided_p(null, 80.5).standard_error, WithinRel(2.0 * std::sqrt(0.2 * 0.8 / 100.0), 1e-13));
  CHECK(upper_p(null, 1000.0).standard_error > 0.0);  // none of the draws is not no chance
}

TEST_CASE("Holm's adjustment", "[verdict]") {
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

TEST_CASE("words for numbers, with bounds at 5 % and 1 %", "[verdict]") {
  CHECK(judge_number({0.5, 0.01}) == Typicality::reproduced);
  CHECK(judge_number({0.05, 0.0}) == Typicality::reproduced);
  CHECK(judge_number({0.0499, 0.0}) == Typicality::untypical);
  CHECK(judge_number({0.01, 0.0}) == Typicality::untypical);
  CHECK(judge_number({0.0099, 0.0}) == Typicality::not_reproduced);
  CHECK(judge_number({0.0, 0.004}) == Typicality::not_reproduced);
  CHECK(judge_number({0.0, 0.006}) == Typicality::untypical);
  CHECK(judge_number({0.0480, 0.001}) == Typicality::untypical);
  CHECK(judge_number({0.0481, 0.001}) == Typicality::undecided);
  CHECK(judge_number({0.0519, 0.001}) == Typicality::undecided);
  CHECK(judge_number({0.0520, 0.001}) == Typicality::reproduced);
  CHECK(judge_number({0.0081, 0.001}) == Typicality::untypical);
  CHECK(judge_number({0.0080, 0.001}) == Typicality::not_reproduced);
  CHECK(name_of(Typicality::not_reproduced) == "not reproduced");
  CHECK(name_of(Typicality::undecided) == "undecided");
}

TEST_CASE("a number on a bound is undecided, whatever the seed; one far from it never", "[verdict]") {
  int undecided = 0, far_undecided = 0;
  constexpr int seeds = 400;
  constexpr int draws = 1000;
  for (int seed = 0; seed < seeds; ++seed) {
    std::vector<double> null;
    for (int i = 0; i < draws; ++i) {
      null.push_back(tmcmc::uniform_open(tmcmc::random_words({.seed = static_cast<std::uint64_t>(seed)},
                                                             {.row = static_cast<std::uint64_t>(i)})[0]));
    }
    undecided += judge_number(two_sided_p(null, 0.025)) == Typicality::undecided ? 1 : 0;
    far_undecided += judge_number(two_sided_p(null, 0.06)) == Typicality::undecided ? 1 : 0;
    CHECK(judge_number(two_sided_p(null, 0.2)) == Typicality::reproduced);
  }
  // 95 % intervals hold the bound in 95 % of the seeds
  CHECK_THAT(undecided, WithinAbs(0.95 * seeds, 4.0 * std::sqrt(seeds * 0.95 * 0.05)));
  CHECK(far_undecided < seeds / 50);
}

TEST_CASE("ratios of equals, against all pairs", "[verdict]") {
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

TEST_CASE("the p-value of a ratio and its standard error, over many samples", "[verdict]") {
  // log-Normal with sd 0.3 of the logarithm: log ratios have sd 0.3 sqrt 2; at 2.0 the tail is 0.0511
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

TEST_CASE("multinomial probability in closed form", "[verdict]") {
  const std::map<std::int64_t, double> fair = {{0, 0.5}, {1, 0.5}};
  CHECK_THAT(log_multinomial({{0, 2}, {1, 2}}, fair), WithinRel(std::log(6.0 / 16.0), 1e-13));
  CHECK_THROWS_WITH(log_multinomial({{7, 1}}, fair), Contains("7"));
  const auto p = category_probabilities({{{9, 3}}, {{10, 5}}}, {{11, 0}});
  CHECK_THAT(p.at(9), WithinRel(3.5 / 9.5, 1e-13));
  CHECK_THAT(p.at(10), WithinRel(5.5 / 9.5, 1e-13));
  CHECK_THAT(p.at(11), WithinRel(0.5 / 9.5, 1e-13));
}

TEST_CASE("equivalence of medians", "[verdict]") {
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
  CHECK(judge_contrast({0.5, 0.01}, e) == Verdict::consistent_with_chance);
  CHECK(judge_contrast({0.01, 0.01}, e) == Verdict::not_supported);
  CHECK(judge_contrast({0.04, 0.006}, e) == Verdict::undecided);
  CHECK(judge_contrast({0.06, 0.006}, e) == Verdict::undecided);
  e.equivalent = false;
  e.different = true;
  e.ratio = 1.5;
  CHECK(judge_contrast({0.01, 0.0}, e) == Verdict::reproduced);
  e.ratio = 0.5;
  CHECK(judge_contrast({0.01, 0.0}, e) == Verdict::contradicted);
  e.different = false;
  CHECK(judge_contrast({0.5, 0.0}, e) == Verdict::not_supported);
  CHECK(name_of(Verdict::internally_contradictory) == "internally contradictory");
  CHECK(name_of(Verdict::undecided) == "undecided");
}

TEST_CASE("a printed number that is moved out of its interval flips the verdict", "[verdict]") {
  const std::map<tmcmc::Index, tmcmc::Index> counts = {{9, 2}, {10, 44}, {11, 4}};
  const auto studies = synthetic(400, 1.0, counts);
  const std::vector<PrintedCounts> good_counts = {{"A", {{9, 2}, {10, 44}, {11, 4}}},
                                                  {"B", {{9, 2}, {10, 44}, {11, 4}}}};
  for (const Null null : {Null::own_studies, Null::all_studies}) {
    const auto judge = [&](const char* area, const std::vector<PrintedCounts>& columns) {
      return judge_tables(studies, {{"A", 0, area}, {"B", 0, "0.150"}}, columns, null, {.tables = 20000});
    };
    const auto good = judge("0.150", good_counts);
    CHECK(good.areas[0].number == Typicality::reproduced);
    CHECK(good.areas[1].number == Typicality::reproduced);
    CHECK(good.counts->number == Typicality::reproduced);
    for (const char* out : {"0.210", "0.090"}) {
      const auto moved = judge(out, good_counts);
      CHECK(moved.areas[0].number ==
            Typicality::untypical);  // 400 draws and 3 numbers: p of 0.015 is the least
      CHECK(moved.areas[1].number == Typicality::reproduced);
      CHECK(moved.counts->number == Typicality::reproduced);
    }
    auto other = good_counts;
    other[1].counts = {{9, 2}, {10, 30}, {11, 18}};  // one column is enough, and either
    CHECK(judge("0.150", other).counts->number == Typicality::not_reproduced);
    CHECK(judge("0.150", {other[1], other[0]}).counts->number == Typicality::not_reproduced);
    CHECK(judge("0.150", {{"A", other[1].counts}}).counts->number == Typicality::not_reproduced);
    CHECK_FALSE(judge("0.150", {}).counts);
    CHECK_THROWS_WITH(judge_tables(studies, {{"C", 0, "0.15"}}, {}, null), Contains("sampler = C:"));
  }
}

TEST_CASE("studies of equal samplers are one null, of different ones two", "[verdict]") {
  const std::map<tmcmc::Index, tmcmc::Index> same = {{9, 2}, {10, 44}, {11, 4}};
  CHECK(null_of(synthetic(400, 1.0, same), "A", "B", 1) == Null::all_studies);
  CHECK(null_of(synthetic(400, 1.3, same), "A", "B", 1) == Null::own_studies);
  CHECK(null_of(synthetic(400, 1.0, {{7, 50}}), "A", "B", 1) == Null::own_studies);
  CHECK(null_of(synthetic(5, 1.0, same), "A", "B", 1) == Null::own_studies);  // too few to say
  const auto studies = synthetic(400, 2.0, same);
  const auto median = [&](Null null) {
    return judge_tables(studies, {{"A", 0, "0.15"}}, {}, null).areas[0].median;
  };
  CHECK(median(Null::own_studies) < 0.16);
  CHECK(median(Null::all_studies) > 0.19);
  CHECK(null_studies(studies, "A", Null::own_studies).size() == 400);
  CHECK(null_studies(studies, "A", Null::all_studies).size() == 800);
  CHECK_THROWS_WITH(null_studies(studies, "C", Null::all_studies), Contains("sampler = C:"));
}

TEST_CASE("samplers that differ are told apart, equal ones are equivalent", "[verdict]") {
  const std::map<tmcmc::Index, tmcmc::Index> same = {{9, 2}, {10, 44}, {11, 4}};
  const auto equal = synthetic(400, 1.0, same);
  const auto one = contrast_areas(equal, "A", "B", 0, 1.1, 1);
  CHECK(one.replicated.equivalent);
  CHECK(one.p.value > 0.5);
  CHECK(judge_contrast(one.p, one.replicated) == Verdict::consistent_with_chance);
  const auto double_area = synthetic(400, 2.0, same);
  const auto two = contrast_areas(double_area, "A", "B", 0, 2.0, 1);
  CHECK(two.replicated.different);
  CHECK(judge_contrast(two.p, two.replicated) == Verdict::reproduced);
  const auto fewer = synthetic(400, 1.0, {{7, 50}});
  const auto counts = contrast_iterations(fewer, {{10, 50}}, {{7, 50}}, "A", "B", 1, {.tables = 1000});
  CHECK(counts.replicated.different);
  CHECK(counts.replicated.ratio < 0.75);
}

TEST_CASE("the likelihood of the tables is that of a Normal and a multinomial", "[verdict]") {
  const auto studies = synthetic(100, 1.0, {{10, 50}});
  const auto at = [&](const char* area) {
    return log_likelihood_of_tables(studies, {{"A", 0, area}}, {{"A", {{9, 2}, {10, 44}, {11, 4}}}},
                                    Null::own_studies);
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
