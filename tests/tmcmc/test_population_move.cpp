// The chains of a stage: which states are kept, when a stage ends, and how the scale adapts.

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "tmcmc/chains.hpp"
#include "tmcmc/detail/population_move.hpp"
#include "tmcmc/replicates.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using problems::by_rows;
using replicates::gamma_normal;
using statistics::standard_errors;
using tmcmc::FixedScale;
using tmcmc::Index;
using tmcmc::Options;
using tmcmc::Population;
using tmcmc::Problem;
using tmcmc::ResampleMove;
using tmcmc::Result;
using tmcmc::StageRecord;
using tmcmc::State;
using tmcmc::TargetAcceptance;
using tmcmc::Walkers;
using tmcmc::WasteFree;
using tmcmc::detail::MetropolisKernel;
using tmcmc::detail::StageKernels;
using tmcmc::detail::StageMoves;

/// Moves `count` walkers, all at 0, under a standard normal target.
struct Stage {
  tmcmc::LogLikelihood log_likelihood = by_rows([](const auto& x) { return -0.5 * x[0] * x[0]; });
  tmcmc::BoxPrior prior{Eigen::VectorXd::Constant(1, -50.0), Eigen::VectorXd::Constant(1, 50.0)};
  StageKernels kernels{.kernels = {MetropolisKernel{}}, .rows = {}};
  MetropolisKernel& kernel = kernels.kernels.front();
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
    tmcmc::detail::Mover mover(log_likelihood, prior, {.seed = 51}, 1, 0);
    tmcmc::detail::StageMoveWorkspace work;
    return tmcmc::detail::move_population(options, kernels, {}, steps, most_steps, walkers, mover, work);
  }
};

Options with(const tmcmc::Move& move) {
  Options options;
  options.move = move;
  return options;
}

double rate(const tmcmc::detail::MoveCounts& counts) {
  return static_cast<double>(counts.accepted) / static_cast<double>(counts.proposals);
}

}  // namespace

TEST_CASE("waste-free keeps every state of each chain, the start included, chain by chain",
          "[tmcmc][stage_moves]") {
  constexpr Index chains = 70;
  constexpr Index steps = 6;
  Stage stage(chains, 0.5);
  const Population starts = stage.walkers.points;
  const StageMoves moves = stage.move(with(WasteFree{}), steps, steps);
  CHECK(moves.steps == steps);
  CHECK(moves.counts.evaluations == chains * steps);
  REQUIRE(stage.walkers.points.rows() == chains * (steps + 1));
  CHECK((stage.walkers.points.topRows(chains) == starts));
  // The states after k steps are those of resample-move with k steps.
  for (Index k = 1; k <= steps; ++k) {
    CAPTURE(k);
    Stage shorter(chains, 0.5);
    CHECK(shorter.move(with(ResampleMove{}), k, k).steps == k);
    CHECK((stage.walkers.points.middleRows(k * chains, chains) == shorter.walkers.points));
    CHECK((stage.walkers.log_likelihood.segment(k * chains, chains) == shorter.walkers.log_likelihood));
  }
}

TEST_CASE("a stage of resample-move ends when its chains have mixed, within its limits",
          "[tmcmc][stage_moves]") {
  Options options = with(ResampleMove{.mixing_correlation = 0.3});
  Stage slow(2000, 0.3);
  const Population starts = slow.walkers.points;
  const Index steps = slow.move(options, 3, 1000).steps;
  CHECK(steps > 10);
  CHECK(steps < 100);
  CHECK(tmcmc::detail::largest_correlation(starts, slow.walkers.points) <= 0.3);
  Stage shorter(2000, 0.3);  // one step less was not enough
  CHECK(shorter.move(options, steps - 1, steps - 1).steps == steps - 1);
  CHECK(tmcmc::detail::largest_correlation(starts, shorter.walkers.points) > 0.3);
  CHECK(Stage(2000, 0.3).move(options, 3, steps - 1).steps == steps - 1);
  CHECK(Stage(2000, 0.3).move(options, steps + 5, 1000).steps == steps + 5);
  options.move = ResampleMove{.mixing_correlation = 0.99};
  CHECK(Stage(2000, 2.4).move(options, 1, 1000).steps == 1);
}

TEST_CASE("the largest correlation between two populations", "[tmcmc][stage_moves]") {
  Population a(4, 3);
  a << 1.0, 5.0, 2.0, 2.0, 5.0, -2.0, 3.0, 5.0, 2.0, 4.0, 5.0, -2.0;
  Population b(4, 3);
  b << -2.0, 1.0, 1.0, -4.0, 2.0, 1.0, -6.0, 3.0, -1.0, -8.0, 4.0, -1.0;
  CHECK_THAT(tmcmc::detail::largest_correlation(a, b),
             WithinRel(1.0, 1e-14));  // of sign -, and a constant column
  CHECK_THAT(tmcmc::detail::largest_correlation(a.rightCols(1), b.rightCols(1)), WithinAbs(0.0, 1e-14));
  CHECK(tmcmc::detail::largest_correlation(a.middleCols(1, 1), b.middleCols(1, 1)) == 0.0);
}

TEST_CASE("the scale adapts until its random walks are accepted at the target rate", "[tmcmc][stage_moves]") {
  for (const double target : {0.2, 0.44, 0.7}) {
    for (const double independent : {0.0, 0.5}) {  // independent proposals say nothing of the scale
      CAPTURE(target, independent);
      Options options = with(ResampleMove{});
      options.scale_rule = TargetAcceptance{target};
      Stage stage(4000, 10.0);
      stage.kernel.independent_fraction = independent;
      stage.kernel.centre = Eigen::VectorXd::Zero(1);
      stage.move(options, 150, 150);
      options.scale_rule = FixedScale{};
      const auto counts = stage.move(options, 20, 20).counts;
      const double reached = static_cast<double>(counts.accepted_walks) / static_cast<double>(counts.walks);
      CHECK_THAT(reached, WithinAbs(target, 0.02));
      CHECK((independent == 0.0 || rate(counts) > target + 0.1));
    }
  }
  Options fixed = with(WasteFree{});
  Stage stage(100, 10.0);
  stage.move(fixed, 10, 10);
  CHECK(stage.kernel.scale == 10.0);
  fixed.scale_rule = TargetAcceptance{};
  stage.move(fixed, 10, 10);
  CHECK(stage.kernel.scale < 10.0);
}

TEST_CASE("cross-fitting: the proposals of each half are shaped by the other half", "[tmcmc][stage_moves]") {
  // Even chains are a hundred times as wide as odd ones, and the likelihood is flat.
  const Problem flat = {
      by_rows([](const auto&) { return 0.0; }),
      tmcmc::BoxPrior(Eigen::VectorXd::Constant(1, -50.0), Eigen::VectorXd::Constant(1, 50.0))};
  for (const bool waste_free : {false, true}) {
    CAPTURE(waste_free);
    Options options = with(ResampleMove{.steps = 1});
    if (waste_free) options.move = WasteFree{1000};
    options.samples = 2000;
    options.cross_fit = true;
    State from = tmcmc::init(flat, options, {.seed = 56});
    statistics::Uniforms uniform(56);
    for (Index i = 0; i < 2000; ++i) {
      from.points(i, 0) = (i % 2 == 0 ? 1.0 : 0.01) * uniform.normal();
    }
    const State to = tmcmc::step(flat, options, {.seed = 56}, tmcmc::fixed_schedule({1.0})(from), from).state;
    const Index chains = to.genealogy.chains;
    std::vector<double> steps[2];
    for (Index c = 0; c < chains; ++c) {
      const Index row = to.genealogy.parents.back()[static_cast<std::size_t>(c)];
      const Index after = waste_free ? c + chains : c;
      steps[row % 2].push_back(to.points(after, 0) - from.points(row, 0));
    }
    // About 500 steps or more from each half: standard deviations to 3.2 %, as of the half they
    // were fitted to.
    CHECK_THAT(statistics::estimate(steps[0]).standard_deviation,
               WithinRel(0.2 * 0.01, standard_errors * 0.045));
    CHECK_THAT(statistics::estimate(steps[1]).standard_deviation,
               WithinRel(0.2 * 1.0, standard_errors * 0.045));
  }
}

TEST_CASE("the rules for the scale over the stages of a run", "[tmcmc][stage_moves]") {
  Options options;
  options.samples = 2000;
  options.scale_rule = tmcmc::DimensionScale{};
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
  same.scale_rule = FixedScale{2.38 / std::sqrt(2.0)};
  const Result a = tmcmc::run(gamma_normal(), options, {.seed = 52});
  const Result b = tmcmc::run(gamma_normal(), same, {.seed = 52});
  CHECK_THAT(a.stages.front().acceptance_rate, WithinAbs(b.stages.front().acceptance_rate, 1e-3));

  options.scale_rule = tmcmc::AcceptanceLinked{};
  double expected = 1.0;
  for (const StageRecord& record : scales()) {
    CHECK_THAT(record.proposal_scale, WithinRel(expected, 1e-14));
    expected = 1.0 / 9.0 + 8.0 / 9.0 * record.acceptance_rate;
  }
  options.scale_rule = TargetAcceptance{0.6};
  CHECK_THAT(scales().back().acceptance_rate, WithinAbs(0.6, 0.05));
}

TEST_CASE("waste-free in a run: N rows, M (N/M - 1) evaluations a stage", "[tmcmc][stage_moves]") {
  Options options = with(WasteFree{});
  options.samples = 600;
  options.move = WasteFree{30};
  options.proposal =
      tmcmc::MetropolisProposal{.coordinates = tmcmc::Coordinates::unbounded};  // no proposal outside the box
  options.scale_rule = tmcmc::DimensionScale{};
  Population before = tmcmc::init(gamma_normal(), options, {.seed = 53}).points;
  Index founders = 600;
  const Result result =
      tmcmc::run(gamma_normal(), options, {.seed = 53}, [&](const tmcmc::Progress& progress) {
        if (progress.stages.empty()) {
          return;
        }
        const StageRecord& record = progress.stages.back();
        const State& state = progress.state;
        CHECK(state.points.rows() == 600);
        CHECK(record.evaluations == 30 * 19);
        CHECK(record.move_steps == 19);
        CHECK(state.genealogy.chains == 30);
        REQUIRE(state.genealogy.parents.size() == static_cast<std::size_t>(record.stage));
        Index same_chain = 0;
        for (Index c = 0; c < 30; ++c) {
          // Starts are rows of the population before, of the chain that the genealogy names.
          const Index parent = state.genealogy.parents.back()[static_cast<std::size_t>(c)];
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

TEST_CASE("every chain of waste-free gets its share of the next starts", "[tmcmc][stage_moves]") {
  // Equal weights, and a distance between starts (N / M = 60) that is a multiple of the number of
  // chains.
  const Problem flat = {by_rows([](const auto&) { return 0.0; }), chains::unit_box(1)};
  Options options = with(WasteFree{});
  options.samples = 600;
  options.move = WasteFree{10};
  options.resampling = tmcmc::Resampling::systematic;
  const Result result =
      tmcmc::run(flat, options, {.seed = 57}, {}, tmcmc::fixed_schedule({0.25, 0.5, 0.75, 1.0}));
  for (std::size_t stage = 1; stage < 4; ++stage) {
    std::vector<Index> expected(10);
    std::iota(expected.begin(), expected.end(), Index{0});
    CHECK(result.final.genealogy.parents[stage] == expected);
  }
  CHECK(result.stages.back().distinct_ancestors == 10);
}
