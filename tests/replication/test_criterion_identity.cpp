// The two criteria on the populations of whole runs.
#include <catch2/catch.hpp>

#include "friction_study.hpp"
#include "replication/criterion_identity.hpp"

using namespace replication;

namespace {

constexpr tmcmc::Index samples = 200;

/// Runs of the paper's samplers on Table 1, with the population standard deviation.
std::vector<RunUnderBothRules> runs_of(double ess_fraction) {
  auto reading = test_data::small_reading(ReadingName::as_published, samples);
  reading.sampler.criterion.deviation = tmcmc::Deviation::population;
  const auto problem = test_data::paper_problem(reading);
  const auto arms = paper_arms(reading, 1.0, ess_fraction);
  std::vector<RunUnderBothRules> runs;
  for (std::uint32_t run = 0; run < 3; ++run) {
    runs.push_back(run_under_both_rules(problem, arms[0].options, arms[1].options, {.seed = 1, .run = run}));
  }
  return runs;
}

}  // namespace

TEST_CASE("CoV = 100 % and N_eff = N/2 choose one step from each population, and whole runs are the same",
          "[study]") {
  const auto runs = runs_of(0.5);
  const auto largest = rule_differences(runs);
  CHECK(largest.of_steps < 1e-9);
  CHECK(largest.of_identity < 1e-12);
  CHECK(largest.of_paths < 1e-9);
  CHECK(largest.same_paths == runs.size());
  CHECK(largest.stages == runs[0].stages.size() + runs[1].stages.size() + runs[2].stages.size());
  for (const auto& run : runs) {
    CHECK(run.stages.front().beta == 0.0);
    CHECK(run.stages.back().beta_tmcmc == 1.0);
    CHECK(run.stages[1].beta == run.stages[0].beta_tmcmc);
  }
}

TEST_CASE("with the standard deviation of N - 1 CoV = 100 % is N_eff = N / (2 - 1/N)", "[study]") {
  const auto runs = runs_of(0.5);
  for (const auto& run : runs) {
    for (std::size_t i = 0; i + 1 < run.stages.size(); ++i) {  // the last step ends at beta = 1
      constexpr auto n = static_cast<double>(samples);
      CHECK(run.stages[i].effective_sample_size_sample == Approx(n / (2.0 - 1.0 / n)).epsilon(1e-9));
    }
  }
  CHECK(rule_differences(runs).of_sample_deviation > 1e-4);
}

TEST_CASE("rules that are not the same equation differ in steps and in whole runs", "[study]") {
  const auto runs = runs_of(0.4);
  const auto largest = rule_differences(runs);
  CHECK(largest.of_steps > 0.01);
  CHECK(largest.of_identity < 1e-12);
  CHECK(largest.of_paths > 0.01);
  CHECK(largest.same_paths == 0);
}
