// A process that is alone. More ranks: ranks/ranks.sh, which needs a build with MPI.

#include <catch2/catch.hpp>

#include "models/ranks.hpp"
#include "tmcmc/problems.hpp"

namespace {

models::Ranks& ranks() {  // one object a process
  static int argc = 0;
  static char** argv = nullptr;
  static models::Ranks one(argc, argv);
  return one;
}

}  // namespace

TEST_CASE("a process that is alone is rank 0 of 1 and evaluates every row", "[models][ranks]") {
  CHECK(ranks().rank() == 0);
  CHECK(ranks().size() == 1);
  const tmcmc::Problem ridge = problems::ridge();
  const auto shared = ranks().share(ridge.log_likelihood);
  REQUIRE(shared);
  const Eigen::MatrixXd points = ridge.prior.sample(7, {.seed = 3});
  Eigen::VectorXd alone(7), together(7);
  ridge.log_likelihood(points, alone);
  (*shared)(points, together);
  CHECK(alone == together);
}

TEST_CASE("what the model throws comes through", "[models][ranks]") {
  const auto shared =
      ranks().share([](const auto&, auto) { throw tmcmc::SamplingError("the model failed"); });
  REQUIRE(shared);
  const Eigen::MatrixXd points = Eigen::MatrixXd::Zero(3, 2);
  Eigen::VectorXd values(3);
  CHECK_THROWS_AS((*shared)(points, values), tmcmc::SamplingError);
}

TEST_CASE("outputs are shared too, if the model has any", "[models][ranks]") {
  const tmcmc::Problem ridge = problems::ridge();
  const auto shared =
      ranks().share(ridge.log_likelihood, [](const auto& points, auto outputs) { outputs = 2.0 * points; });
  REQUIRE(shared);
  const Eigen::MatrixXd points = Eigen::MatrixXd::Random(5, 2);
  Eigen::MatrixXd outputs(5, 2);
  shared->outputs(points, outputs);
  CHECK(outputs == 2.0 * points);
  CHECK_FALSE(ranks().share(ridge.log_likelihood, {})->outputs);
}
