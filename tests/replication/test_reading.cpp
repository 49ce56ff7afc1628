// The readings of the paper differ in the options that their table names, and in no other.

#include <catch2/catch.hpp>
#include <limits>
#include <set>
#include <string>

#include "errors/invalid_value.hpp"
#include "names/names.hpp"
#include "replication/friction_study.hpp"
#include "tmcmc/option_table.hpp"

namespace {

using Catch::Matchers::Contains;
using replication::Reading;
using replication::reading;
using replication::ReadingName;

using Names = std::set<std::string>;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Options that have a meaning in both and differ.
void compare(const tmcmc::Options& a, const tmcmc::Options& b, Names& names) {
  for (const auto& option : tmcmc::option_table()) {
    const auto of_a = tmcmc::option_value(a, option.name);
    const auto of_b = tmcmc::option_value(b, option.name);
    if (of_a && of_b && *of_a != *of_b) {
      names.insert(std::string(option.name));
    }
  }
}

Names differences(const Reading& a, const Reading& b) {
  Names names;
  compare(a.sampler, b.sampler, names);
  const auto note = [&](const char* name, bool equal) {
    if (!equal) {
      names.insert(name);
    }
  };
  note("driving_force_n", a.physics.driving_force_n == b.physics.driving_force_n);
  note("limit", a.physics.limit == b.physics.limit);
  note("phase", a.physics.phase == b.physics.phase);
  note("infeasible_log_likelihood", a.infeasible_log_likelihood == b.infeasible_log_likelihood);
  note("natural_frequency_lower_hz", a.natural_frequency_lower_hz == b.natural_frequency_lower_hz);
  return names;
}

}  // namespace

TEST_CASE("the corrected reading is the defaults of the libraries, with a true zero", "[study][reading]") {
  Reading defaults;
  defaults.infeasible_log_likelihood = -infinity;
  defaults.sampler.diagnose = false;
  const Reading corrected = reading(ReadingName::corrected);
  CHECK(differences(corrected, defaults).empty());
  CHECK(corrected.sampler.samples == 1000);
  CHECK(std::get<tmcmc::ResampleMove>(corrected.sampler.move).steps == 3);
  CHECK(std::get<tmcmc::FixedScale>(corrected.sampler.scale_rule).scale == 0.2);
  CHECK(corrected.sampler.centre == tmcmc::Centre::weighted_mean);
  CHECK(std::holds_alternative<tmcmc::MetropolisProposal>(corrected.sampler.proposal));
  CHECK(corrected.sampler.criterion.deviation == tmcmc::Deviation::population);
  CHECK(corrected.sampler.criterion.counted == tmcmc::Counted::feasible);
  CHECK(corrected.physics.limit == friction::LimitRule::supremum);
  CHECK(corrected.physics.phase == friction::PhaseRule::fourier_coefficient);
  CHECK(corrected.physics.driving_force_n == 2.5);
}

TEST_CASE(
    "the published reading: N - 1, all samples, redraw, penalty, grid, discrete bin, prior from 0.001 Hz",
    "[study][reading]") {
  const Reading published = reading(ReadingName::as_published);
  CHECK(differences(published, reading(ReadingName::corrected)) ==
        Names{"deviation", "counted", "boundary", "limit", "phase", "infeasible_log_likelihood",
              "natural_frequency_lower_hz"});
  CHECK(published.sampler.criterion.deviation == tmcmc::Deviation::sample);
  CHECK(published.sampler.criterion.counted == tmcmc::Counted::all);
  CHECK(std::holds_alternative<tmcmc::RedrawnWalk>(published.sampler.proposal));
  CHECK(published.physics.limit == friction::LimitRule::grid);
  CHECK(published.physics.phase == friction::PhaseRule::discrete_bin);
  CHECK(published.infeasible_log_likelihood == -1e10);
  CHECK(published.natural_frequency_lower_hz == 0.001);
}

TEST_CASE(
    "the worded reading: all samples, growing chains of one step, plain mean, penalty, grid, discrete bin",
    "[study][reading]") {
  const Reading worded = reading(ReadingName::as_worded);
  CHECK(differences(worded, reading(ReadingName::corrected)) ==
        Names{"counted", "move", "centre", "limit", "phase", "infeasible_log_likelihood"});
  CHECK(worded.sampler.criterion.counted == tmcmc::Counted::all);
  CHECK(std::holds_alternative<tmcmc::GrowingChains>(worded.sampler.move));
  CHECK(worded.sampler.centre == tmcmc::Centre::plain_mean);
  CHECK(worded.physics.limit == friction::LimitRule::grid);
  CHECK(worded.physics.phase == friction::PhaseRule::discrete_bin);
  CHECK(worded.infeasible_log_likelihood == -1e10);
  CHECK_FALSE(worded.natural_frequency_lower_hz.has_value());
}

TEST_CASE("names of the readings and back", "[study][reading]") {
  CHECK(names::all<ReadingName>() == std::vector<std::string>{"as_published", "as_worded", "corrected"});
  CHECK(replication::parse_reading("as_published") == ReadingName::as_published);
  CHECK(replication::parse_reading("as_worded") == ReadingName::as_worded);
  CHECK(replication::parse_reading("corrected") == ReadingName::corrected);
  for (const char* bad : {"", "published", "Corrected", "corrected "}) {
    CHECK_THROWS_AS(replication::parse_reading(bad), errors::InvalidValue);
    CHECK_THROWS_WITH(replication::parse_reading(bad), Contains("as_published, as_worded or corrected"));
  }
}

TEST_CASE("the paper's two samplers differ in the criterion alone", "[study][reading]") {
  for (const ReadingName name : {ReadingName::as_published, ReadingName::as_worded, ReadingName::corrected}) {
    const Reading r = reading(name);
    const auto arms = replication::paper_arms(r);
    REQUIRE(arms.size() == 2);
    CHECK(arms[0].name == "TMCMC");
    CHECK(arms[1].name == "TMCMC-II");
    CHECK(std::get<tmcmc::CoefficientOfVariation>(arms[0].options.criterion.rule).target == 1.0);
    CHECK(std::get<tmcmc::EffectiveSampleSize>(arms[1].options.criterion.rule).fraction == 0.5);
    Names between;
    compare(arms[0].options, arms[1].options, between);
    CHECK(between == Names{"criterion"});
    for (const auto& arm : arms) {  // the rest is the reading's, and penalised draws count as infeasible
      CHECK_NOTHROW(arm.options.validate());
      CHECK(arm.options.infeasible_level == r.infeasible_log_likelihood);
      Names changed;
      compare(arm.options, r.sampler, changed);
      for (const char* allowed : {"criterion", "cov_target", "infeasible_level"}) {
        changed.erase(allowed);
      }
      CHECK(changed.empty());
    }
  }
  const auto arms = replication::paper_arms(reading(ReadingName::corrected), 0.7, 0.9);
  CHECK(std::get<tmcmc::CoefficientOfVariation>(arms[0].options.criterion.rule).target == 0.7);
  CHECK(std::get<tmcmc::EffectiveSampleSize>(arms[1].options.criterion.rule).fraction == 0.9);
}

TEST_CASE("a problem carries the reading's physics and penalty", "[study][reading]") {
  Eigen::MatrixXd points(2, 4);
  points << 1.52, 3.0, 2.0, 0.02,  // between the exact limit, 1.501 N, and that of the grid, 1.544 N
      5.0, 3.0, 2.0, 0.02;
  Eigen::VectorXd values(2);
  test_data::paper_problem(reading(ReadingName::as_published)).log_likelihood(points, values);
  CHECK(values[0] > -1000.0);
  CHECK(values[1] == -1e10);
  test_data::paper_problem(reading(ReadingName::corrected)).log_likelihood(points, values);
  CHECK(values[0] == -infinity);
  CHECK(values[1] == -infinity);
  friction::Observations broken = test_data::table1();
  broken.phase_deg.pop_back();
  const Reading r = reading(ReadingName::corrected);
  CHECK_THROWS_AS(replication::problem(r, broken, test_data::table2(r)), errors::InvalidValue);
}
