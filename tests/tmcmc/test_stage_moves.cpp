// The chains of a stage: which states are kept, when a stage ends, how the scale adapts, and what the budget allows.

#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tmcmc/chains.hpp"
#include "tmcmc/replicates.hpp"
#include "tmcmc/stage_moves.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using problems::by_rows;
using replicates::gamma_normal;
using statistics::standard_errors;
using tmcmc::Index;
using tmcmc::MetropolisKernel;
using tmcmc::MoveKind;
using tmcmc::Options;
using tmcmc::Population;
using tmcmc::Problem;
using tmcmc::Result;
using tmcmc::ScaleRule;
using tmcmc::StageMoves;
using tmcmc::StageRecord;
using tmcmc::State;
using tmcmc::StopReason;
using tmcmc::Walkers;

/// Moves `count` walkers, all at 0, under a standard normal target.
struct Stage {
  tmcmc::LogLikelihood log_likelihood = by_rows([](const auto& x) { return -0.5 * x[0] * x[0]; });
  tmcmc::BoxPrior prior{Eigen::VectorXd::Constant(1, -50.0), Eigen::VectorXd::Constant(1, 50.0)};
  MetropolisKernel kernel{};
  Walkers walkers{};

  explicit Stage(Index count, double scale) {
    kernel.factor = Eigen::MatrixXd::Ones(1, 1);
    kernel.scale = scale;
    walkers.points = Population::Zero(count, 1);
    statistics::Uniforms uniform(51);
    for (double& x : walkers.points.col(0)) {
      x = uniform.normal();
    }
    walkers.log_likelihood = -0.5 * walkers.points.col(0).array().square();
  }

  StageMoves move(const Options& options, Index steps, Index most_steps) {
    tmcmc::Mover mover(log_likelihood, prior, {.seed = 51}, 1, 0);
    tmcmc::StageMoveWorkspace work;
    return tmcmc::move_population(options, kernel, {}, steps, most_steps, walkers, mover, work);
  }
};

Options with(MoveKind move) {
  Options options;
  options.move = move;
  return options;
}

double rate(const tmcmc::MoveCounts& counts) {
  return static_cast<double>(counts.accepted) / static_cast<double>(counts.proposals);
}

}  // namespace

TEST_CASE("waste-free keeps every state of each chain, the start included, chain by chain",
          "[tmcmc][stage_moves]") {
  constexpr Index chains = 70;
  constexpr Index steps = 6;
  Stage stage(chains, 0.5);
  const Population starts = stage.walkers.points;
  const StageMoves moves = stage.move(with(MoveKind::waste_free), steps, steps);
  CHECK(moves.steps == steps);
  CHECK(moves.counts.evaluations == chains * steps);
  REQUIRE(stage.walkers.points.rows() == chains * (steps + 1));
  CHECK((stage.walkers.points.topRows(chains) == starts));
  // The states after k steps are those of resample-move with k steps.
  for (Index k = 1; k <= steps; ++k) {
    CAPTURE(k);
    Stage shorter(chains, 0.5);
    CHECK(shorter.move(with(MoveKind::resample_move), k, k).steps == k);
    CHECK((stage.walkers.points.middleRows(k * chains, chains) == shorter.walkers.points));
    CHECK((stage.walkers.log_likelihood.segment(k * chains, chains) == shorter.walkers.log_likelihood));
  }
}

TEST_CASE("a stage of resample-move ends when its chains have mixed, within its limits",
          "[tmcmc][stage_moves]") {
  Options options = with(MoveKind::resample_move);
  options.mixing_correlation = 0.3;
  Stage slow(2000, 0.3);
  const Population starts = slow.walkers.points;
  const Index steps = slow.move(options, 3, 1000).steps;
  CHECK(steps > 10);
  CHECK(steps < 100);
  CHECK(tmcmc::largest_correlation(starts, slow.walkers.points) <= 0.3);
  Stage shorter(2000, 0.3);  // one step less was not enough
  CHECK(shorter.move(options, steps - 1, steps - 1).steps == steps - 1);
  CHECK(tmcmc::largest_correlation(starts, shorter.walkers.points) > 0.3);
  CHECK(Stage(2000, 0.3).move(options, 3, steps - 1).steps == steps - 1);
  CHECK(Stage(2000, 0.3).move(options, steps + 5, 1000).steps == steps + 5);
  options.mixing_correlation = 0.99;
  CHECK(Stage(2000, 2.4).move(options, 1, 1000).steps == 1);
}

TEST_CASE("the largest correlation between two populations", "[tmcmc][stage_moves]") {
  Population a(4, 3);
  a << 1.0, 5.0, 2.0, 2.0, 5.0, -2.0, 3.0, 5.0, 2.0, 4.0, 5.0, -2.0;
  Population b(4, 3);
  b << -2.0, 1.0, 1.0, -4.0, 2.0, 1.0, -6.0, 3.0, -1.0, -8.0, 4.0, -1.0;
  CHECK_THAT(tmcmc::largest_correlation(a, b), WithinRel(1.0, 1e-14));  // of sign -, and a constant column
  CHECK_THAT(tmcmc::largest_correlation(a.rightCols(1), b.rightCols(1)), WithinAbs(0.0, 1e-14));
  CHECK(tmcmc::largest_correlation(a.middleCols(1, 1), b.middleCols(1, 1)) == 0.0);
}

TEST_CASE("the scale adapts until its random walks are accepted at the target rate", "[tmcmc][stage_moves]") {
  for (const double target : {0.2, 0.44, 0.7}) {
    for (const double independent : {0.0, 0.5}) {  // independent proposals say nothing of the scale
      CAPTURE(target, independent);
      Options options = with(MoveKind::resample_move);
      options.scale_rule = ScaleRule::target_acceptance;
      options.target_acceptance = target;
      Stage stage(4000, 10.0);
      stage.kernel.independent_fraction = independent;
      stage.kernel.centre = Eigen::VectorXd::Zero(1);
      stage.move(options, 150, 150);
      options.scale_rule = ScaleRule::fixed;
      const auto counts = stage.move(options, 20, 20).counts;
      const double reached = static_cast<double>(counts.accepted_walks) / static_cast<double>(counts.walks);
      CHECK_THAT(reached, WithinAbs(target, 0.02));
      CHECK((independent == 0.0 || rate(counts) > target + 0.1));
    }
  }
  Options fixed = with(MoveKind::waste_free);
  Stage stage(100, 10.0);
  stage.move(fixed, 10, 10);
  CHECK(stage.kernel.scale == 10.0);
  fixed.scale_rule = ScaleRule::target_acceptance;
  stage.move(fixed, 10, 10);
  CHECK(stage.kernel.scale < 10.0);
}

TEST_CASE("the rules for the scale over the stages of a run", "[tmcmc][stage_moves]") {
  Options options;
  options.samples = 2000;
  options.scale_rule = ScaleRule::dimension;
  const auto scales = [&] {
    std::vector<StageRecord> records = tmcmc::run(gamma_normal(), options, {.seed = 52}).stages;
    REQUIRE(records.size() > 3);
    return records;
  };
  for (const StageRecord& record : scales()) {
    CHECK(record.proposal_scale == 2.38);  // before the division by sqrt(2)
    CHECK(record.acceptance_rate > 0.25);
    CHECK(record.acceptance_rate < 0.5);
  }
  Options same = options;  // 2.38 / sqrt(2) as a fixed scale proposes the same but for rounding
  same.scale_rule = ScaleRule::fixed;
  same.proposal_scale = 2.38 / std::sqrt(2.0);
  const Result a = tmcmc::run(gamma_normal(), options, {.seed = 52});
  const Result b = tmcmc::run(gamma_normal(), same, {.seed = 52});
  CHECK_THAT(a.stages.front().acceptance_rate, WithinAbs(b.stages.front().acceptance_rate, 1e-3));

  options.scale_rule = ScaleRule::acceptance_linked;
  double expected = 1.0;
  for (const StageRecord& record : scales()) {
    CHECK_THAT(record.proposal_scale, WithinRel(expected, 1e-14));
    expected = 1.0 / 9.0 + 8.0 / 9.0 * record.acceptance_rate;
  }
  options.scale_rule = ScaleRule::target_acceptance;
  options.target_acceptance = 0.6;
  CHECK_THAT(scales().back().acceptance_rate, WithinAbs(0.6, 0.05));
}

TEST_CASE("waste-free in a run: N rows, M (N/M - 1) evaluations a stage", "[tmcmc][stage_moves]") {
  Options options = with(MoveKind::waste_free);
  options.samples = 600;
  options.chains = 30;
  options.coordinates = tmcmc::Coordinates::unbounded;  // no proposal outside the box
  options.scale_rule = ScaleRule::dimension;
  Population before = tmcmc::initial_state(gamma_normal(), options, {.seed = 53}).points;
  Index founders = 600;
  const Result result =
      tmcmc::run(gamma_normal(), options, {.seed = 53}, [&](const StageRecord& record, const State& state) {
        CHECK(state.points.rows() == 600);
        CHECK(record.evaluations == 30 * 19);
        CHECK(record.move_steps == 19);
        CHECK(state.genealogy.chains == 30);
        REQUIRE(state.genealogy.ancestors.size() == static_cast<std::size_t>(record.stage));
        Index same_chain = 0;
        for (Index c = 0; c < 30; ++c) {
          // Starts are rows of the population before, of the chain that the genealogy names.
          const Index parent = state.genealogy.ancestors.back()[static_cast<std::size_t>(c)];
          bool found = false;
          for (Index row = parent; row < 600; row += founders) {
            found = found || before.row(row) == state.points.row(c);
          }
          CHECK(found);
          for (Index k = 1; k < 20; ++k) {  // a rejected step repeats the state
            same_chain += state.points.row(c + 30 * k) == state.points.row(c + 30 * (k - 1)) ? 1 : 0;
          }
        }
        CHECK_THAT(static_cast<double>(same_chain) / (30 * 19),
                   WithinAbs(1.0 - record.acceptance_rate, 1e-12));
        before = state.points;
        founders = 30;
      });
  CHECK(result.final.evaluations == 600 + 570 * static_cast<Index>(result.stages.size()));
}

TEST_CASE("a budget of evaluations is kept, and the last stage uses it up", "[tmcmc][stage_moves]") {
  std::atomic<Index> rows{0};
  const Problem counting = {
      [&](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
        rows += points.rows();
        gamma_normal().log_likelihood(points, values);
      },
      gamma_normal().prior};
  Index completed = 0;
  for (const MoveKind move : {MoveKind::resample_move, MoveKind::waste_free}) {
    for (const double mixing : {0.0, 0.4}) {
      for (const Index budget : {301, 500, 2000, 3333, 9999, 30000}) {
        CAPTURE(static_cast<int>(move), mixing, budget);
        Options options = with(move);
        options.samples = 300;
        options.chains = 20;
        options.coordinates = tmcmc::Coordinates::unbounded;
        options.scale_rule = ScaleRule::dimension;
        options.evaluation_budget = budget;
        options.mixing_correlation = move == MoveKind::waste_free ? 0.0 : mixing;
        rows = 0;
        const Result result = tmcmc::run(counting, options, {.seed = 54});
        CHECK(result.final.evaluations == rows);
        CHECK(rows <= budget);
        if (result.stop == StopReason::completed) {
          ++completed;
          CHECK(budget - rows < (move == MoveKind::waste_free ? 20 : 300));
          CHECK(result.final.points.rows() ==
                (move == MoveKind::waste_free ? 20 * (result.stages.back().move_steps + 1) : 300));
        } else {
          CHECK(result.stop == StopReason::budget);
          CHECK(result.final.beta < 1.0);
          CHECK(result.final.stage == static_cast<Index>(result.stages.size()));
        }
        CHECK((result.stop == StopReason::completed || budget < 10000));
        CHECK((result.stop == StopReason::budget || budget > 1000));
      }
    }
  }
  CHECK(completed > 8);
}

TEST_CASE("the recommended options keep their budget", "[tmcmc][stage_moves]") {
  CHECK_NOTHROW(tmcmc::recommended_options().validate());
  for (const Index budget : {500, 5000, 31000}) {
    CAPTURE(budget);
    const Options options = tmcmc::recommended_options(budget);
    CHECK_NOTHROW(options.validate());
    CHECK(options.evaluation_budget == budget);
    const Result result = tmcmc::run(gamma_normal(), options, {.seed = 55});
    CHECK(result.stop == StopReason::completed);
    CHECK(result.final.evaluations <= budget);
    CHECK(budget - result.final.evaluations < 10);
  }
  CHECK_THROWS_AS(tmcmc::recommended_options(499), std::invalid_argument);
}
