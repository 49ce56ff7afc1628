#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "errors/invalid_value.hpp"
#include "replication/published.hpp"
#include "replication/verdict.hpp"
#include "tmcmc/random.hpp"

using namespace replication;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Studies with areas base * (1 + k/n) and the given counts, for two samplers with a ratio between
/// them.
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

TEST_CASE("words for numbers and contrasts, with bounds at 5 % and 1 %", "[verdict]") {
  CHECK(judge_number({0.01, 0.0}) == Compatibility::compatible);
  CHECK(judge_number({0.0099, 0.0}) == Compatibility::not_compatible);
  CHECK(judge_number({0.0119, 0.001}) == Compatibility::undecided);
  CHECK(judge_number({0.0120, 0.001}) == Compatibility::compatible);
  CHECK(judge_number({0.0081, 0.001}) == Compatibility::undecided);
  CHECK(judge_number({0.0080, 0.001}) == Compatibility::not_compatible);
  CHECK(name_of(Compatibility::not_compatible) == "not compatible");
  CHECK(judge_chance({0.05, 0.0}) == Chance::ordinary);
  CHECK(judge_chance({0.0499, 0.0}) == Chance::unlikely);
  CHECK(judge_chance({0.01, 0.0}) == Chance::unlikely);
  CHECK(judge_chance({0.0099, 0.0}) == Chance::very_unlikely);
  CHECK(judge_chance({0.0, 0.006}) == Chance::unlikely);
  CHECK(judge_chance({0.0480, 0.001}) == Chance::unlikely);
  CHECK(judge_chance({0.0481, 0.001}) == Chance::undecided);
  CHECK(judge_chance({0.0519, 0.001}) == Chance::undecided);
  CHECK(judge_chance({0.0520, 0.001}) == Chance::ordinary);
  CHECK(name_of(Chance::very_unlikely) == "very unlikely by chance");
  CHECK(name_of(Chance::undecided) == "undecided");
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
    undecided += judge_chance(two_sided_p(null, 0.025)) == Chance::undecided ? 1 : 0;
    far_undecided += judge_chance(two_sided_p(null, 0.06)) == Chance::undecided ? 1 : 0;
    CHECK(judge_chance(two_sided_p(null, 0.2)) == Chance::ordinary);
  }
  // 95 % intervals hold the bound in 95 % of the seeds
  CHECK_THAT(undecided, WithinAbs(0.95 * seeds, 4.0 * std::sqrt(seeds * 0.95 * 0.05)));
  CHECK(far_undecided < seeds / 50);
}

TEST_CASE("verdicts on contrasts", "[verdict]") {
  Equivalence e{};
  e.equivalent = true;
  CHECK(judge_contrast(e) == Verdict::contradicted);
  e.equivalent = false;
  e.different = true;
  e.ratio = 1.5;
  CHECK(judge_contrast(e) == Verdict::holds);
  e.ratio = 0.5;
  CHECK(judge_contrast(e) == Verdict::contradicted);
  e.different = false;
  CHECK(judge_contrast(e) == Verdict::not_supported);
  CHECK(name_of(Verdict::internally_contradictory) == "internally contradictory");
  CHECK(name_of(Verdict::cannot_be_tested) == "cannot be tested");
  CHECK(name_of(Verdict::true_and_uninformative) == "true, and uninformative");
}

TEST_CASE("a printed number that is moved out of its interval flips the word", "[verdict]") {
  const std::map<tmcmc::Index, tmcmc::Index> counts = {{9, 2}, {10, 44}, {11, 4}};
  const auto studies = synthetic(400, 1.0, counts);
  const std::vector<PrintedCounts> good_counts = {{"A", {{9, 2}, {10, 44}, {11, 4}}},
                                                  {"B", {{9, 2}, {10, 44}, {11, 4}}}};
  for (const Null null : {Null::own_studies, Null::all_studies}) {
    const auto judge = [&](const char* area) {
      return judge_areas(studies, {{"A", 0, area}, {"B", 0, "0.150"}}, null);
    };
    CHECK(judge("0.150")[0].number == Compatibility::compatible);
    CHECK_THAT(judge("0.150")[0].percentile, WithinAbs(50.0, 2.0));
    for (const char* out : {"0.210", "0.090"}) {
      const auto moved = judge(out);
      // 400 draws: p of 2/401 with an error as large
      CHECK(moved[0].number ==
            (null == Null::own_studies ? Compatibility::undecided : Compatibility::not_compatible));
      CHECK(moved[1].number == Compatibility::compatible);
    }
    const auto p_of = [&](const std::vector<PrintedCounts>& columns) {
      return judge_counts(studies, columns, null, {.tables = 20000}).back().p.value;
    };
    CHECK(p_of(good_counts) > 0.3);
    auto other = good_counts;
    other[1].counts = {{9, 2}, {10, 30}, {11, 18}};  // one column is enough, and either
    CHECK(p_of(other) < 0.001);
    CHECK(p_of({other[1], other[0]}) < 0.001);
    CHECK(p_of({{"A", other[1].counts}}) < 0.001);
    CHECK(judge_counts(studies, {other[1], other[0]}, null, {.tables = 2000}).size() == 3);
    CHECK_THROWS_WITH(judge_areas(studies, {{"C", 0, "0.15"}}, null), Contains("sampler = C:"));
  }
}

TEST_CASE("studies of equal samplers are one null, of different ones two", "[verdict]") {
  const std::map<tmcmc::Index, tmcmc::Index> same = {{9, 2}, {10, 44}, {11, 4}};
  CHECK(null_of(synthetic(400, 1.0, same), "A", "B", 1) == Null::all_studies);
  CHECK(null_of(synthetic(400, 1.3, same), "A", "B", 1) == Null::own_studies);
  CHECK(null_of(synthetic(400, 1.0, {{7, 50}}), "A", "B", 1) == Null::own_studies);
  CHECK(null_of(synthetic(5, 1.0, same), "A", "B", 1) == Null::own_studies);  // too few to say
  const auto studies = synthetic(400, 2.0, same);
  const auto median = [&](Null null) { return judge_areas(studies, {{"A", 0, "0.15"}}, null)[0].median; };
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
  CHECK(judge_contrast(one.replicated) == Verdict::contradicted);
  const auto double_area = synthetic(400, 2.0, same);
  const auto two = contrast_areas(double_area, "A", "B", 0, 2.0, 1);
  CHECK(two.replicated.different);
  CHECK(judge_contrast(two.replicated) == Verdict::holds);
  const auto fewer = synthetic(400, 1.0, {{7, 50}});
  const auto counts = contrast_iterations(fewer, {{10, 50}}, {{7, 50}}, "A", "B", {.tables = 1000});
  CHECK(counts.replicated.different);
  CHECK(counts.replicated.ratio < 0.75);
}
