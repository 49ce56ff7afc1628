// A run that is stopped after any stage and resumed ends with the bits of one that was not.

#include <functional>

#include "tmcmc/resumable.hpp"

namespace {

using Catch::Matchers::Contains;
using problems::few_samples;
using problems::ridge;
using resumable::check_same_bits;
using resumable::every_kind;
using resumable::run_whole;
using resumable::Whole;
using tmcmc::BridgeEvidence;
using tmcmc::BridgeSums;
using tmcmc::Options;
using tmcmc::Progress;
using tmcmc::StopReason;

}  // namespace

TEST_CASE("a run resumed after any stage is the run, for every kind of option", "[tmcmc][resume]") {
  for (auto [name, options] : every_kind()) {
    const Whole whole = run_whole(options);
    REQUIRE(whole.progress.size() == whole.result.stages.size() + 1);
    CHECK((whole.result.stop == StopReason::completed) == (name != "budget that ends early"));
    for (const int threads : {1, 3}) {
      for (std::size_t stage = 0; stage < whole.progress.size(); ++stage) {
        CAPTURE(name, threads, stage);
        options.threads = threads;
        options.batch_rows = threads == 1 ? 2048 : 37;
        check_same_bits(tmcmc::resume(ridge(), options, {.seed = 5}, whole.progress[stage]), whole.result);
      }
    }
  }
}

TEST_CASE("a resumed run with given steps takes those that are left", "[tmcmc][resume]") {
  const auto schedule = tmcmc::fixed_schedule({0.001, 0.01, 0.1, 0.4, 1.0});
  std::vector<Progress> progress;
  const auto result = tmcmc::run(
      ridge(), few_samples(), {.seed = 5}, [&](const Progress& p) { progress.push_back(p); }, schedule);
  REQUIRE(progress.size() == 6);
  for (const Progress& p : progress) {
    std::vector<tmcmc::Index> seen;
    check_same_bits(tmcmc::resume(
                        ridge(), few_samples(), {.seed = 5}, p,
                        [&](const Progress& next) { seen.push_back(next.state.stage); }, schedule),
                    result);
    CHECK(seen.size() == 5 - p.stages.size());
    CHECK((seen.empty() || seen.front() == p.state.stage + 1));
  }
}

TEST_CASE("a run that was stopped by max_stages goes on with more", "[tmcmc][resume]") {
  const Whole whole = run_whole(few_samples());
  Options options = few_samples();
  options.max_stages = 3;
  const Whole cut = run_whole(options);
  CHECK(cut.result.stop == StopReason::stage_limit);
  check_same_bits(tmcmc::resume(ridge(), options, {.seed = 5}, cut.progress.back()), cut.result);
  check_same_bits(tmcmc::resume(ridge(), few_samples(), {.seed = 5}, cut.progress.back()), whole.result);
  options.max_stages = 2;
  CHECK_THROWS_WITH(tmcmc::resume(ridge(), options, {.seed = 5}, cut.progress.back()),
                    Contains("state.stage: expected at most options.max_stages = 2, not 3"));
}

TEST_CASE("another key gives another run", "[tmcmc][resume]") {
  const Whole whole = run_whole(few_samples());
  const auto other = tmcmc::resume(ridge(), few_samples(), {.seed = 6}, whole.progress[2]);
  CHECK((other.final.points.array() != whole.result.final.points.array()).any());
}

TEST_CASE("a progress that does not hang together is refused by name", "[tmcmc][resume]") {
  const Whole whole = run_whole(few_samples());
  const auto bridge = [](const std::function<void(BridgeSums&)>& change) {
    return [change](Progress& p) {
      BridgeSums sums = p.bridge.sums();
      change(sums);
      p.bridge = BridgeEvidence(sums);
    };
  };
  const std::vector<std::pair<std::string, std::function<void(Progress&)>>> cases = {
      {"state.points: expected one column",
       [](Progress& p) { p.state.points.conservativeResize(Eigen::NoChange, 2); }},
      {"state.points: expected 203 rows",
       [](Progress& p) { p.state.points.conservativeResize(202, Eigen::NoChange); }},
      {"state.points: expected points inside", [](Progress& p) { p.state.points(7, 1) = 5.1; }},
      {"state.points: expected points inside", [](Progress& p) { p.state.points(7, 1) = std::nan(""); }},
      {"state.log_likelihood: expected 203",
       [](Progress& p) { p.state.log_likelihood.conservativeResize(9); }},
      {"state.log_likelihood: expected finite",
       [](Progress& p) { p.state.log_likelihood[5] = std::nan(""); }},
      {"state.beta: expected a number in", [](Progress& p) { p.state.beta = std::nan(""); }},
      {"state.beta: expected that of", [](Progress& p) { p.state.beta = 0.5; }},
      {"state.stage", [](Progress& p) { p.state.stage = -1; }},
      {"stages: expected 3", [](Progress& p) { p.stages.pop_back(); }},
      {"state.evaluations", [](Progress& p) { p.state.evaluations = 202; }},
      {"genealogy.chains", [](Progress& p) { p.state.genealogy.chains = 0; }},
      {"genealogy.chains", [](Progress& p) { p.state.genealogy.chains = 4; }},
      {"genealogy.parents: expected 3", [](Progress& p) { p.state.genealogy.parents.pop_back(); }},
      {"genealogy.parents[1]: expected 203", [](Progress& p) { p.state.genealogy.parents[1].pop_back(); }},
      {"genealogy.parents[1]: expected numbers", [](Progress& p) { p.state.genealogy.parents[1][3] = 203; }},
      {"genealogy.parents[1]: expected numbers", [](Progress& p) { p.state.genealogy.parents[1][3] = -1; }},
      {"bridge.influence: expected 4", bridge([](BridgeSums& s) { s.influence.pop_back(); })},
      {"bridge.influence[0]: expected 203", bridge([](BridgeSums& s) { s.influence[0].push_back(0.0); })},
      {"bridge.influence[3]: expected 203", bridge([](BridgeSums& s) { s.influence[3].pop_back(); })},
      {"genealogy.parents[0]: expected 202", bridge([](BridgeSums& s) { s.influence[1].pop_back(); })}};
  for (const auto& [message, spoil] : cases) {
    CAPTURE(message);
    Progress progress = whole.progress[3];
    CHECK_NOTHROW(tmcmc::require_valid(progress, ridge().prior, few_samples()));
    spoil(progress);
    CHECK_THROWS_WITH(tmcmc::resume(ridge(), few_samples(), {.seed = 5}, progress), Contains(message));
  }
  Options undiagnosed = few_samples();
  undiagnosed.diagnose = false;
  CHECK_THROWS_WITH(tmcmc::resume(ridge(), few_samples(), {.seed = 5}, run_whole(undiagnosed).progress[3]),
                    Contains("genealogy.parents: expected 3 entries, not 0"));
}
