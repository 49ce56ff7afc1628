// A result depends on problem, options and seed alone: not on threads, batches or a constant in the
// likelihood.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tmcmc/parallel.hpp"
#include "tmcmc/problems.hpp"
#include "tmcmc/sampler.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using problems::by_rows;
using problems::few_samples;
using problems::ridge;
using problems::run_ridge;
using tmcmc::BoxPrior;
using tmcmc::fixed_schedule;
using tmcmc::Index;
using tmcmc::Options;
using tmcmc::Problem;
using tmcmc::Result;
using tmcmc::StageRecord;
using tmcmc::State;
using tmcmc::StopReason;
using tmcmc::StreamKey;

constexpr double rounding = 1e-12;

/// The ridge with values on a grid of 2^-20, so that a constant can be added without rounding.
Problem ridge_on_a_grid(double constant) {
  const Problem exact = ridge();
  return {
      [exact, constant](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
        exact.log_likelihood(points, values);
        for (double& value : values) {
          value = std::round(value * 0x1p20) * 0x1p-20 + constant;
        }
      },
      exact.prior};
}

void check_same_bits(const Result& a, const Result& b) {
  CHECK((a.final.points == b.final.points));
  CHECK((a.final.log_likelihood == b.final.log_likelihood));
  CHECK(a.final.log_evidence == b.final.log_evidence);
  REQUIRE(a.stages.size() == b.stages.size());
  for (std::size_t s = 0; s < a.stages.size(); ++s) {
    CHECK(a.stages[s].beta == b.stages[s].beta);
    CHECK(a.stages[s].acceptance_rate == b.stages[s].acceptance_rate);
    CHECK(a.stages[s].evaluations == b.stages[s].evaluations);
    CHECK(a.stages[s].redraws == b.stages[s].redraws);
  }
}

}  // namespace

TEST_CASE("neither threads nor batches change a bit of a run", "[tmcmc][sampler]") {
  for (const tmcmc::Move& move : {tmcmc::Move(tmcmc::ResampleMove{}), tmcmc::Move(tmcmc::GrowingChains{})}) {
    for (const bool redraw : {false, true}) {
      Options options = few_samples();
      options.move = move;
      if (redraw) options.proposal = tmcmc::RedrawnWalk{};
      const Result reference = run_ridge(options);
      for (const int threads : {1, 2, 3}) {
        for (const Index batch_rows : {0, 1, 50, 1000}) {
          CAPTURE(move.index(), redraw, threads, batch_rows);
          options.threads = threads;
          options.batch_rows = batch_rows;
          check_same_bits(run_ridge(options), reference);
        }
      }
    }
  }
}

TEST_CASE("threads change no bit of a run over many blocks", "[tmcmc][sampler]") {
  Options options = few_samples();
  options.samples = 2 * tmcmc::reduction_rows + 1001;
  const Result reference = run_ridge(options);
  for (const int threads : {2, 3}) {
    CAPTURE(threads);
    options.threads = threads;
    options.batch_rows = threads == 2 ? 0 : 512;
    check_same_bits(run_ridge(options), reference);
  }
}

TEST_CASE("no call of the log-likelihood gets more than batch_rows rows", "[tmcmc][sampler]") {
  Options options = few_samples();
  options.batch_rows = 50;
  const Problem exact = ridge();
  Index most = 0;
  const Problem watched = {
      [&](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
        most = std::max(most, points.rows());
        exact.log_likelihood(points, values);
      },
      exact.prior};
  check_same_bits(tmcmc::run(watched, options, {.seed = 5}), run_ridge(options));
  CHECK(most == 50);
  CHECK(tmcmc::rows_per_call(1000, 3, 2048) == 334);  // a small population too is shared among the threads
  CHECK(tmcmc::rows_per_call(1000, 3, 0) == 334);
  CHECK(tmcmc::rows_per_call(10000, 3, 2048) == 2048);
}

TEST_CASE("runs that differ in any field of their key differ", "[tmcmc][sampler]") {
  const Options options = few_samples();
  const Result reference = run_ridge(options, {.seed = 5});
  check_same_bits(run_ridge(options, {.seed = 5}), reference);
  for (const StreamKey& key : {StreamKey{.seed = 6}, StreamKey{.seed = 5, .study = 1},
                               StreamKey{.seed = 5, .arm = 1}, StreamKey{.seed = 5, .run = 1}}) {
    const Result other = run_ridge(options, key);
    CHECK((other.final.points.array() != reference.final.points.array()).all());
    CHECK(other.final.log_evidence != reference.final.log_evidence);
    CHECK((tmcmc::init(ridge(), options, key).points.array() !=
           tmcmc::init(ridge(), options, {.seed = 5}).points.array())
              .all());
  }
}

TEST_CASE("no stage uses the random numbers of another", "[tmcmc][sampler]") {
  // A flat likelihood in a box that no proposal leaves: every step is accepted, and its
  // displacements are the normals of the stage.
  const Problem flat = {by_rows([](const auto&) { return 0.0; }),
                        BoxPrior(Eigen::VectorXd::Constant(1, -1.0), Eigen::VectorXd::Constant(1, 1.0))};
  Options options;
  options.samples = 50;
  options.move = tmcmc::ResampleMove{.steps = 1};
  options.scale_rule = tmcmc::FixedScale{1e-6};
  State before = tmcmc::init(flat, options, {.seed = 5});
  const std::vector<double> start(before.points.col(0).begin(), before.points.col(0).end());
  std::vector<std::vector<double>> displacements;
  static_cast<void>(tmcmc::run(
      flat, options, {.seed = 5},
      [&](const tmcmc::Progress& progress) {
        if (progress.stages.empty()) {
          return;
        }
        const State& state = progress.state;
        CHECK(progress.stages.back().acceptance_rate > 0.9);
        std::vector<double> moved;
        for (const double x : state.points.col(0)) {  // from the nearest earlier point
          double nearest = 10.0;
          for (const double y : before.points.col(0)) {
            nearest = std::fabs(x - y) < std::fabs(nearest) ? x - y : nearest;
          }
          moved.push_back(nearest);
        }
        displacements.push_back(moved);
        before = state;
      },
      fixed_schedule({0.25, 0.5, 0.75, 1.0})));
  REQUIRE(displacements.size() == 4);
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = a + 1; b < 4; ++b) {
      double products = 0.0;
      double squares_a = 0.0;
      double squares_b = 0.0;
      for (std::size_t i = 0; i < 50; ++i) {
        products += displacements[a][i] * displacements[b][i];
        squares_a += displacements[a][i] * displacements[a][i];
        squares_b += displacements[b][i] * displacements[b][i];
      }
      // 4 standard errors of a correlation of 50 pairs; the same numbers again would give almost 1
      CHECK(std::fabs(products) < 4.0 / std::sqrt(50.0) * std::sqrt(squares_a * squares_b));
    }
  }
}

TEST_CASE("a constant added to the log-likelihood changes no bit of the samples and moves the evidence by it",
          "[tmcmc][sampler]") {
  for (const tmcmc::Criterion& criterion :
       {tmcmc::coefficient_of_variation_rule(), tmcmc::effective_sample_size_rule()}) {
    CAPTURE(criterion.rule.index());
    Options options = few_samples();
    options.samples = 1000;
    options.criterion = criterion;
    const Result reference = tmcmc::run(ridge_on_a_grid(0.0), options, {.seed = 5});
    for (const double constant : {1000.0, -4096.0}) {
      CAPTURE(constant);
      const Result shifted = tmcmc::run(ridge_on_a_grid(constant), options, {.seed = 5});
      CHECK((shifted.final.points == reference.final.points));
      REQUIRE(shifted.stages.size() == reference.stages.size());
      for (std::size_t s = 0; s < shifted.stages.size(); ++s) {
        CHECK(shifted.stages[s].beta == reference.stages[s].beta);
      }
      CHECK_THAT(shifted.final.log_evidence - reference.final.log_evidence,
                 WithinAbs(constant, rounding * std::fabs(constant)));
    }
  }
}

TEST_CASE("a constant that cannot be added exactly changes the run by rounding alone", "[tmcmc][sampler]") {
  const Problem problem = ridge();
  const Problem shifted = {
      [&](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
        problem.log_likelihood(points, values);
        values.array() += 1000.0 / 3.0;
      },
      problem.prior};
  const Result a = tmcmc::run(problem, few_samples(), {.seed = 5});
  const Result b = tmcmc::run(shifted, few_samples(), {.seed = 5});
  REQUIRE(a.stages.size() == b.stages.size());
  CHECK((a.final.points - b.final.points).cwiseAbs().maxCoeff() < 1e-9);
  CHECK_THAT(b.final.log_evidence - a.final.log_evidence, WithinAbs(1000.0 / 3.0, 1e-9));
}

TEST_CASE("a fixed schedule with the temperatures of an adaptive run repeats it", "[tmcmc][sampler]") {
  for (const tmcmc::Move& move : {tmcmc::Move(tmcmc::ResampleMove{}), tmcmc::Move(tmcmc::GrowingChains{})}) {
    Options options = few_samples();
    options.move = move;
    const Result adaptive = run_ridge(options);
    std::vector<double> betas;
    for (const StageRecord& record : adaptive.stages) {
      betas.push_back(record.beta);
    }
    const Result fixed = tmcmc::run(ridge(), options, {.seed = 5}, {}, fixed_schedule(betas));
    CHECK(fixed.stop == StopReason::completed);
    REQUIRE(fixed.stages.size() == adaptive.stages.size());
    for (std::size_t s = 0; s < betas.size(); ++s) {
      CHECK(fixed.stages[s].beta == betas[s]);
      CHECK_THAT(fixed.stages[s].effective_sample_size,
                 WithinRel(adaptive.stages[s].effective_sample_size, 1e-9));
      CHECK_THAT(fixed.stages[s].coefficient_of_variation,
                 WithinRel(adaptive.stages[s].coefficient_of_variation, 1e-9));
    }
    // A step is a difference of rounded temperatures here, so that the samples agree to rounding.
    CHECK((fixed.final.points - adaptive.final.points).cwiseAbs().maxCoeff() < 1e-9);
    CHECK_THAT(fixed.final.log_evidence, WithinAbs(adaptive.final.log_evidence, 1e-9));
  }
}
