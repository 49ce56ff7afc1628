// The search for settings that made the printed tables: it finds a difference that is there, and
// little where there is none.

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "data/columns.hpp"
#include "errors/invalid_value.hpp"
#include "replication/forensics.hpp"
#include "replication/friction_study.hpp"
#include "tmcmc/random.hpp"

using namespace replication;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

/// Studies with log-Normal areas around `area` and 50 runs that take 10 or, with probability
/// `eleven`, 11 iterations.
std::vector<StudySummary> drawn(int n, std::uint32_t arm, double area, double eleven) {
  std::vector<StudySummary> studies;
  for (int k = 0; k < n; ++k) {
    const auto word = [&](std::uint64_t row) {
      return tmcmc::random_words({.seed = 23, .study = static_cast<std::uint32_t>(k), .arm = arm},
                                 {.row = row});
    };
    const auto w = word(0);
    const auto z = tmcmc::normal_pair(w[0], w[1]);
    StudySummary s;
    s.areas = {area * std::exp(0.2 * z.first), 0.01 * std::exp(0.1 * z.second)};
    for (std::uint64_t run = 1; run <= 50; ++run) {
      ++s.iterations[tmcmc::uniform_open(word(run)[0]) < eleven ? 11 : 10];
    }
    studies.push_back(s);
  }
  return studies;
}

const std::vector<std::string> names = {"one", "two", "three"};

std::vector<std::vector<StudySummary>> three_settings() {
  return {drawn(200, 0, 0.1, 0.1), drawn(200, 1, 0.2, 0.1), drawn(200, 2, 0.1, 0.5)};
}

}  // namespace

TEST_CASE("two settings that made the columns are found, and the search is significant", "[forensics]") {
  const auto found =
      compare_settings(three_settings(), names,
                       {{"A", {0.2, 0.01}, {{10, 45}, {11, 5}}}, {"B", {0.1, 0.01}, {{10, 25}, {11, 25}}}});
  REQUIRE(found.pairs.size() == 9);
  REQUIRE(found.settings.size() == 9);
  const auto best = std::max_element(found.pairs.begin(), found.pairs.end(),
                                     [](const auto& a, const auto& b) { return a.weight < b.weight; });
  CHECK(best->first == 1);
  CHECK(best->second == 2);
  CHECK(best->p.value > 0.3);
  CHECK(best->weight > 0.9);
  CHECK(found.pairs.front().p.value < 0.001);
  CHECK(found.gain > 10.0);
  CHECK(found.search_p.value < 0.01);
  // counted from beta_0, each run takes one more: the columns are then out of reach
  CHECK(found.settings[0].shift == 0);
  CHECK(found.settings[1].shift == 1);
  CHECK(found.settings[1].columns[0].log_density < found.settings[0].columns[0].log_density - 50.0);
  double sum = 0.0;
  for (const auto& p : found.pairs) sum += p.weight;
  CHECK_THAT(sum, WithinAbs(1.0, 1e-12));
  const auto statistics = search_statistics(found, names, 40);
  const auto value = [&](const std::string& quantity) {
    return std::find_if(statistics.begin(), statistics.end(),
                        [&](const auto& s) { return s.quantity == quantity; })
        ->value;
  };
  CHECK(value("studies of each setting") == "40");
  CHECK(value("best first") == "two");
  CHECK(value("best second") == "three");
  CHECK(std::stod(value("gain")) == found.gain);
  CHECK(std::stod(value("p of the best pair")) == best->p.value);
  CHECK(std::stod(value("p of the search")) == found.search_p.value);
}

TEST_CASE("columns of one sampler give a search that finds nothing", "[forensics]") {
  const auto settings = three_settings();
  const auto usual = compare_settings(
      settings, names, {{"A", {0.1, 0.01}, {{10, 45}, {11, 5}}}, {"B", {0.11, 0.01}, {{10, 44}, {11, 6}}}});
  CHECK(usual.gain == 0.0);
  CHECK(usual.search_p.value > 0.9);
  // fresh columns of the first setting: p-values of the search below 0.2 in at most a fifth, by its
  // definition
  const auto fresh = drawn(120, 9, 0.1, 0.1);
  double below = 0.0;
  for (std::size_t i = 0; i + 1 < fresh.size(); i += 2) {
    const auto column = [](const StudySummary& s) {
      return PrintedColumn{"A", s.areas, {s.iterations.begin(), s.iterations.end()}};
    };
    below += compare_settings(settings, names, {column(fresh[i]), column(fresh[i + 1])}).search_p.value < 0.2;
  }
  CHECK(below / 60.0 < 0.2 + 4.0 * std::sqrt(0.2 * 0.8 / 60.0));
}

TEST_CASE("settings are named once, and the first one is that of the published scripts", "[forensics]") {
  const auto settings = forensic_settings(100);
  std::set<std::string> different;
  for (const auto& s : settings) {
    different.insert(s.name);
    CHECK(s.reading.sampler.samples == 100);
  }
  CHECK(different.size() == settings.size());
  const auto& first = settings.front().reading.sampler;
  CHECK(std::get<tmcmc::ResampleMove>(first.move).steps == 3);
  CHECK(std::holds_alternative<tmcmc::RedrawnWalk>(first.proposal));
  CHECK_THROWS_AS(compare_settings({}, {}, {}), errors::InvalidValue);
}

TEST_CASE("a stitched study has runs of two settings", "[forensics]") {
  Setting stitched = forensic_settings(60).front();
  stitched.second = stitched.reading;
  stitched.second->sampler.samples = 80;
  const auto problem_of = [](const Reading& r) {
    return problem(r, test_data::table1(), test_data::table2(r));
  };
  int calls = 0;
  const StudyOptions options{.runs = 5, .seed = 4, .threads = 1};
  const auto studies = run_setting(stitched, problem_of, 3, 2, options, [&] { ++calls; });
  REQUIRE(studies.size() == 2);
  CHECK(calls == 2);
  for (const auto& s : studies) {
    CHECK(total_of({s.iterations.begin(), s.iterations.end()}) == 5);
  }
  CHECK(studies[0].areas != studies[1].areas);
  Setting plain = stitched;
  plain.second.reset();
  CHECK(run_setting(plain, problem_of, 3, 1, options, [] {})[0].areas != studies[0].areas);
}
