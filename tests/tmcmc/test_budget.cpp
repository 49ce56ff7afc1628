// The budget of likelihood evaluations.

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>

#include "tmcmc/problems.hpp"
#include "tmcmc/replicates.hpp"

namespace {

using replicates::gamma_normal;
using tmcmc::Index;
using tmcmc::Options;
using tmcmc::Problem;
using tmcmc::Result;
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
  for (const bool waste_free : {false, true}) {
    for (const double mixing : {0.0, 0.4}) {
      for (const Index budget : {301, 500, 2000, 3333, 9999, 30000}) {
        CAPTURE(waste_free, mixing, budget);
        Options options;
        options.samples = 300;
        options.move = tmcmc::ResampleMove{.mixing_correlation = mixing};
        if (waste_free) options.move = tmcmc::WasteFree{20};
        options.proposal = tmcmc::MetropolisProposal{.coordinates = tmcmc::Coordinates::unbounded};
        options.scale_rule = tmcmc::DimensionScale{};
        options.evaluation_budget = budget;
        rows = 0;
        const Result result = tmcmc::run(counting, options, {.seed = 54});
        CHECK(result.final.evaluations == rows);
        CHECK(rows <= budget);
        if (result.stop == StopReason::completed) {
          ++completed;
          CHECK(budget - rows < (waste_free ? 20 : 300));
          CHECK(result.final.points.rows() ==
                (waste_free ? 20 * (result.stages.back().move_steps + 1) : 300));
        } else {
          CHECK(result.stop == StopReason::budget);
          CHECK(result.final.beta < 1.0);
          CHECK(result.final.stage == static_cast<Index>(result.stages.size()));
        }
        CHECK((result.stop == StopReason::completed || budget < 10000));
        // Waste-free shortens its chains until one step is left.
        CHECK((result.stop == StopReason::budget || budget > (waste_free ? 301 : 1000)));
      }
    }
  }
  CHECK(completed > 8);
}

TEST_CASE("a last stage without a step to spend does not take place", "[tmcmc][budget]") {
  const Problem flat = {problems::by_rows([](const auto&) { return 0.0; }), gamma_normal().prior};
  Options options;
  options.samples = 300;
  options.scale_rule = tmcmc::FixedScale{0.01};
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

TEST_CASE("the better moves keep their budget", "[tmcmc][budget]") {
  CHECK_NOTHROW(tmcmc::recommended_moves().validate());
  for (const Index budget : {500, 5000, 31000}) {
    CAPTURE(budget);
    const Options options = tmcmc::recommended_moves(budget);
    CHECK_NOTHROW(options.validate());
    CHECK(options.evaluation_budget == budget);
    const Result result = tmcmc::run(gamma_normal(), options, {.seed = 55});
    CHECK(result.stop == StopReason::completed);
    CHECK(result.final.evaluations <= budget);
    CHECK(budget - result.final.evaluations < 10);
  }
  CHECK_THROWS_AS(tmcmc::recommended_moves(499), std::invalid_argument);
}

namespace {

/// Two parameters known to 1 in 10^4 of the prior's width and a third to 1 in 10^5: some twenty
/// stages.
Problem needle() {
  return {problems::by_rows([](const auto& x) {
            const double a = (x[0] - 0.6) / 2e-4;
            const double b = (x[1] + 0.3) / 2e-4;
            const double c = (x[2] - 0.1) / 2e-5;
            return -0.5 * (a * a + b * b + c * c);
          }),
          tmcmc::BoxPrior(Eigen::Vector3d::Constant(-1.0), Eigen::Vector3d::Constant(1.0))};
}

}  // namespace

TEST_CASE("a posterior of many stages is reached with any budget, large or small", "[tmcmc][budget]") {
  for (const Index chains : {10, 100}) {
    for (const Index budget : {2600, 5200, 31000, 200000}) {
      CAPTURE(chains, budget);
      const Options options = tmcmc::recommended_moves(budget, chains);
      const Result result = tmcmc::run(needle(), options, {.seed = 61});
      CHECK(result.stop == StopReason::completed);
      CHECK(result.stages.size() > 13);
      CHECK(result.final.evaluations <= budget);
      CHECK(budget - result.final.evaluations < chains);
    }
  }
}

TEST_CASE("populations under a budget are no larger than samples, and shrink where many stages are ahead",
          "[tmcmc][budget]") {
  const Options options = tmcmc::recommended_moves(31000);
  std::vector<Index> sizes;
  const Result result = tmcmc::run(needle(), options, {.seed = 62}, [&](const tmcmc::Progress& progress) {
    sizes.push_back(progress.state.points.rows());
  });
  REQUIRE(sizes.size() > 13);
  CHECK(sizes.front() == options.samples);
  for (std::size_t i = 1; i + 1 < sizes.size(); ++i) {
    CHECK(sizes[i] <= options.samples);
    CHECK(sizes[i] % std::get<tmcmc::WasteFree>(options.move).chains == 0);
  }
  CHECK(*std::min_element(sizes.begin() + 1, sizes.end() - 1) < options.samples);
}

TEST_CASE("a run under a budget goes on from any stage as if it had not been stopped", "[tmcmc][budget]") {
  const Options options = tmcmc::recommended_moves(5200);
  std::vector<tmcmc::Progress> kept;
  const Result whole =
      tmcmc::run(needle(), options, {.seed = 63}, [&](const tmcmc::Progress& p) { kept.push_back(p); });
  for (const std::size_t stage : {std::size_t{1}, kept.size() / 2}) {
    const Result resumed = tmcmc::resume(needle(), options, {.seed = 63}, kept[stage]);
    CHECK(resumed.final.points == whole.final.points);
    CHECK(resumed.evidence.log_evidence == whole.evidence.log_evidence);
  }
}
