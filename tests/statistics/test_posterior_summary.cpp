#include <catch2/catch.hpp>
#include <cmath>

#include "statistics/posterior_summary.hpp"

using namespace statistics;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

constexpr double rounding = 1e-12;

/// A run of one parameter.
tmcmc::Result run_of(const std::vector<double>& values, const std::vector<double>& weights,
                     const tmcmc::Evidence& evidence = {}) {
  tmcmc::Result run;
  const auto n = static_cast<tmcmc::Index>(values.size());
  run.final.points = Eigen::Map<const Eigen::VectorXd>(values.data(), n);
  run.weights = Eigen::Map<const Eigen::VectorXd>(weights.data(), n);
  run.evidence = evidence;
  run.diagnostics.effective_sample_size = Eigen::VectorXd::Constant(1, static_cast<double>(n));
  return run;
}

const tmcmc::Prior prior =
    tmcmc::BoxPrior(Eigen::VectorXd::Constant(1, 0.0), Eigen::VectorXd::Constant(1, 10.0));

}  // namespace

TEST_CASE("each run counts the same in a summary, whatever its weights sum to", "[posterior_summary]") {
  const auto row = summarise({run_of({1.0, 3.0}, {3.0, 1.0}), run_of({5.0}, {70.0})}, prior).at(0);
  CHECK_THAT(row.mean, WithinRel(0.5 * 1.5 + 0.5 * 5.0, rounding));
  // weights 3/8, 1/8, 1/2 at 1, 3, 5
  CHECK_THAT(row.sd,
             WithinRel(std::sqrt(0.375 * 2.25 * 2.25 + 0.125 * 0.25 * 0.25 + 0.5 * 1.75 * 1.75), rounding));
  CHECK(row.quantile_5 == 1.0);
  CHECK(row.quantile_95 == 5.0);
  // middles of the steps: 0.1875, 0.4375, 0.75
  CHECK_THAT(row.median, WithinRel(3.0 + 2.0 * (0.5 - 0.4375) / (0.75 - 0.4375), rounding));
  CHECK(row.effective_sample_size == 3.0);
}

TEST_CASE("R-hat is that of Gelman and Rubin, and there is none of one run", "[posterior_summary]") {
  const std::vector<double> ones(4, 1.0);
  const auto low = run_of({1.0, 2.0, 3.0, 4.0}, ones), high = run_of({3.0, 4.0, 5.0, 6.0}, ones);
  CHECK(std::isnan(summarise({low}, prior)[0].r_hat));
  // n = 4, within 1.25, between 2
  CHECK_THAT(summarise({low, high}, prior)[0].r_hat, WithinRel(std::sqrt(0.75 + 2.0 / 1.25), rounding));
  CHECK_THAT(summarise({low, low}, prior)[0].r_hat, WithinRel(std::sqrt(0.75), rounding));
}

TEST_CASE("the error of a mean evidence is that of the runs or their scatter, whichever is larger",
          "[posterior_summary]") {
  const auto with = [](double value, double error) { return run_of({1.0}, {1.0}, {value, error}); };
  CHECK(mean_evidence({with(-3.0, 0.2)}).standard_error == 0.2);
  const auto alike = mean_evidence({with(-3.0, 0.3), with(-3.0, 0.4)});
  CHECK(alike.log_evidence == -3.0);
  CHECK_THAT(alike.standard_error, WithinRel(0.25, rounding));
  CHECK_THAT(mean_evidence({with(-3.0, 0.1), with(-1.0, 0.1)}).standard_error, WithinRel(1.0, rounding));
}

TEST_CASE("equal rows follow the weights", "[posterior_summary]") {
  const auto run = run_of({1.0, 2.0, 3.0, 4.0}, {0.0, 3.0, 0.0, 1.0});
  CHECK(equal_rows(run, 4) == std::vector<tmcmc::Index>{1, 1, 1, 3});
  CHECK(equal_rows(run_of({1.0, 2.0, 3.0}, {1.0, 1.0, 1.0}), 3) == std::vector<tmcmc::Index>{0, 1, 2});
  CHECK(equal_draws(run) == 4);
  auto measured = run;
  measured.measurement.emplace().effective_sample_size = 1.6;
  CHECK(equal_draws(measured) == 2);
  measured.measurement->effective_sample_size = 0.2;
  CHECK(equal_draws(measured) == 1);
}
