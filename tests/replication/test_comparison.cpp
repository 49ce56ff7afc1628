// Printed numbers beside ours, among replicated studies; effects of the readings.

#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>

#include "data/columns.hpp"
#include "errors/invalid_value.hpp"
#include "replication/comparison.hpp"
#include "replication/reading_effects.hpp"

using namespace replication;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

/// Studies k = 0 ... 99 of samplers A and B: areas 0.1 (1 + k/100) and a permuted tenth of it, 40 +
/// k % 5 runs of 10 iterations.
std::vector<StudySummary> studies() {
  std::vector<StudySummary> list;
  for (int k = 0; k < 100; ++k) {
    for (const char* sampler : {"A", "B"}) {
      StudySummary s;
      s.study = static_cast<std::uint32_t>(k);
      s.sampler = sampler;
      s.areas = {0.1 * (1.0 + k / 100.0), 0.01 * (1.0 + (k * 37 % 100) / 100.0)};
      s.iterations = {{10, 40 + k % 5}, {11, 10 - k % 5}};
      s.means = {1.0 + k, 2.0};
      s.log_evidence_mean = -3.0;
      list.push_back(s);
    }
  }
  return list;
}

const std::vector<PrintedArea> areas = {
    {"A", 0, "0.150"}, {"A", 1, "0.0150"}, {"B", 0, "0.150"}, {"B", 1, "0.5"}};
const std::vector<PrintedCounts> counts = {{"A", {{10, 42}, {11, 8}}}, {"B", {{10, 42}, {11, 8}}}};

}  // namespace

TEST_CASE("cells have their places among the studies, and all together their tests", "[comparison]") {
  std::vector<ComparedCell> cells(4);
  cells[0] = {"Table 3", "A", "force", 0.150, 0.1};
  cells[1] = {"Table 3", "B", "frequency", 0.5, 0.015};
  cells[2] = {"Table 4", "10", "A", 42, 41};
  cells[3] = {"Table 1", "1", "phase", 2, 3};
  place_among_studies(cells, studies(), areas, counts, Null::all_studies, {"force", "frequency"});
  CHECK_THAT(cells[0].printed_percentile, WithinAbs(51.0, 1.0));
  CHECK_THAT(cells[0].our_percentile, WithinAbs(1.5, 0.1));  // the least of 200: two draws and itself
  CHECK_THAT(cells[0].median, WithinAbs(0.1495, 1e-12));
  CHECK(cells[0].verdict == "compatible");
  CHECK(cells[1].verdict == "undecided");  // 2/201 is as little as 200 draws can say
  CHECK(cells[2].median == 42.0);
  CHECK(std::isnan(cells[2].p.value));
  CHECK(cells[2].verdict.empty());
  CHECK(std::isnan(cells[3].median));
  REQUIRE(cells.size() == 9);
  CHECK(cells[4].row == "areas");
  CHECK(cells[4].verdict == "undecided");  // none of the pairs of 200 studies: an error of 1/100
  CHECK(cells[5].row == "counts");
  CHECK(cells[5].verdict == "compatible");
  CHECK(cells[6].row == "A");
  CHECK(cells[6].verdict.empty());
  CHECK(cells[8].row == "all");
  CHECK(cells[8].verdict == "undecided");
  CHECK(cells[8].p.value < 1e-4);
  const auto text = comparison_markdown(cells);
  CHECK_THAT(
      text, Contains("| Table 3 | A, force | 0.15 |") && Contains("| Table 4 | 10 iterations | A 42 |") &&
                Contains("| jointly | A: areas and iterations |") && Contains("| **all printed numbers** |"));
  const auto listed = comparison_text(cells);
  CHECK_THAT(listed, Contains("\nTable 3\n") && Contains("studies 0.1495 (") && Contains(": compatible\n") &&
                         Contains("\njoint\n"));
  CHECK(listed.find("nan") == std::string::npos);
}

TEST_CASE("the bounds of Table 2 are compared one by one", "[comparison]") {
  const auto prior = [](double lower) {
    return tmcmc::Prior({{"a", "", tmcmc::Marginal::uniform(0.0, 1.0)},
                         {"b", "", tmcmc::Marginal::uniform(lower, 2.0)},
                         {"c", "", tmcmc::Marginal::uniform(0.0, 3.0)},
                         {"d", "", tmcmc::Marginal::uniform(0.0, 4.0)}});
  };
  std::vector<ComparedCell> cells;
  compare_bounds(cells, prior(0.5), prior(0.75));
  REQUIRE(cells.size() == 8);
  CHECK(cells[2].row == "natural_frequency_hz");
  CHECK(cells[2].column == "lower");
  CHECK(difference(cells[2]) == 0.25);
  CHECK(cells[7].ours == 4.0);
  CHECK(cells[7].printed == 4.0);
}

TEST_CASE("shares of studies by their runs of so many iterations add up to 1", "[comparison]") {
  const std::string sampler = "A";
  std::vector<StudySummary> studies(4);  // the last one of another sampler
  for (std::size_t k = 0; k < 3; ++k) {
    studies[k].sampler = sampler;
  }
  studies[0].iterations = {{9, 4}, {10, 46}};
  studies[1].iterations = {{10, 46}, {11, 4}};
  studies[2].iterations = {{10, 50}};
  studies[3].iterations = {{13, 50}};
  const auto shares = count_shares(studies, {"A", {{10, 42}, {12, 8}}});
  std::map<std::int64_t, double> sums;
  for (const auto& share : shares) {
    sums[share.iterations] += share.share_of_studies;
  }
  CHECK(sums.size() == 4);
  for (const auto& [iterations, sum] : sums) {
    CHECK(sum == Approx(1.0));
  }
  REQUIRE(shares.size() == 7);
  CHECK((shares[2].iterations == 10 && shares[2].runs == 46 && shares[2].printed == 42));
  CHECK(shares[2].share_of_studies == Approx(2.0 / 3.0));
  CHECK((shares[6].iterations == 12 && shares[6].runs == 0 && shares[6].printed == 8));
  CHECK_THROWS_AS(count_shares(studies, {"B", {}}), errors::InvalidValue);
}

TEST_CASE("each reading is named once and changes what it says", "[comparison]") {
  const auto variants = reading_variants(123);
  const auto base = reading(ReadingName::as_published);
  std::set<std::string> names;
  for (const auto& v : variants) {
    CHECK(v.reading.sampler.samples == 123);
    names.insert(v.name);
    if (v.name == "5 steps a move") CHECK(std::get<tmcmc::ResampleMove>(v.reading.sampler.move).steps == 5);
    if (v.name == "exact limit") CHECK(v.reading.physics.limit != base.physics.limit);
    if (v.name == "omega_n from 0.01 Hz") CHECK_FALSE(v.reading.natural_frequency_lower_hz.has_value());
  }
  CHECK(names.size() == variants.size());
}

TEST_CASE("effects of a reading are summaries of its studies", "[comparison]") {
  const auto effects = effects_of(studies(), areas, counts, {.tables = 1000, .resamples = 2});
  REQUIRE(effects.size() == 2);
  const auto& a = effects[0];
  CHECK(a.sampler == "A");
  CHECK_THAT(a.force.median, WithinAbs(0.1495, 1e-12));
  CHECK_THAT(a.share_10, WithinAbs(0.84, 1e-12));
  CHECK_THAT(a.share_from_11, WithinAbs(0.16, 1e-12));
  CHECK(a.share_up_to_9 == 0.0);
  CHECK_THAT(a.mean_force_n, WithinAbs(50.5, 1e-12));
  CHECK(a.mean_log_evidence == -3.0);
  CHECK(a.force.p > 0.9);
  CHECK(effects[1].frequency.p < 0.02);
  CHECK(a.log_likelihood == effects[1].log_likelihood);
}

TEST_CASE("random ratios scatter about the nominal ones by the stated noise", "[comparison]") {
  const auto o = test_data::table1();
  double squares = 0.0;
  for (std::uint32_t study = 0; study < 200; ++study) {
    const auto drawn = with_random_ratios(o, 1, study);
    for (std::size_t i = 0; i < o.size(); ++i) {
      const double z = (drawn.measured_ratio[i] - o.nominal_ratio[i]) / 0.01;
      squares += z * z;
    }
  }
  CHECK_THAT(squares / 2000.0, WithinAbs(1.0, 4.0 * std::sqrt(2.0 / 2000.0)));
}
