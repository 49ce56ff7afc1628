// The budget of likelihood evaluations.

#include <atomic>
#include <catch2/catch.hpp>

#include "tmcmc/replicates.hpp"

namespace {

using replicates::gamma_normal;
using tmcmc::Index;
using tmcmc::MoveKind;
using tmcmc::Options;
using tmcmc::Problem;
using tmcmc::Result;
using tmcmc::ScaleRule;
using tmcmc::StopReason;

}  // namespace

TEST_CASE("a budget of evaluations is kept, and the last stage uses it up", "[tmcmc][budget]") {
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
        Options options;
        options.move = move;
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

TEST_CASE("a last stage without a step to spend does not take place", "[tmcmc][budget]") {
  const Problem flat = {problems::by_rows([](const auto&) { return 0.0; }), gamma_normal().prior};
  Options options;
  options.samples = 300;
  options.proposal_scale = 0.01;
  options.evaluation_budget = 599;
  const Result none = tmcmc::run(flat, options, {.seed = 58});
  CHECK(none.stop == StopReason::budget);
  CHECK(none.stages.empty());
  CHECK(none.final.beta == 0.0);
  CHECK(none.final.points.rows() == 300);
  options.evaluation_budget = 600;
  const Result one = tmcmc::run(flat, options, {.seed = 58});
  CHECK(one.stop == StopReason::completed);
  CHECK(one.stages.front().move_steps == 1);
}

TEST_CASE("the recommended options keep their budget", "[tmcmc][budget]") {
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
