// The sampler against posteriors and evidences in closed form. Errors are measured by independent
// runs: a mean over the runs has to lie within 4 of its standard errors of the truth, and within a
// bias of order 1/N that every sampler of this kind has at finite N.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tmcmc/replicates.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using replicates::check;
using replicates::check_gamma_normal;
using replicates::check_normal_margin;
using replicates::gamma_normal;
using replicates::good_options;
using replicates::mean_of;
using replicates::over_runs;
using replicates::problem_of;
using replicates::replicate;
using replicates::runs;
using statistics::Estimate;
using statistics::standard_errors;
using tmcmc::BoxPrior;
using tmcmc::Centre;
using tmcmc::Criterion;
using tmcmc::Index;
using tmcmc::Options;
using tmcmc::Problem;
using tmcmc::Result;

}  // namespace

TEST_CASE("a Gaussian likelihood in a wide box: mean, variance and evidence", "[tmcmc][sampler]") {
  for (const Index d : {1, 2, 5}) {
    CAPTURE(d);
    Eigen::VectorXd mean(d);
    Eigen::VectorXd sd(d);
    double log_evidence = 0.0;  // of the normalised likelihood: minus the logarithm of the volume
    for (Index j = 0; j < d; ++j) {
      mean[j] = 0.7 * static_cast<double>(j) - 2.0;
      sd[j] = 0.5 + 0.25 * static_cast<double>(j);
      log_evidence -= std::log(25.0);
    }
    const Problem problem = problem_of(
        [=](const auto& x) {
          double value = 0.0;
          for (Index j = 0; j < d; ++j) {
            const double z = (x[j] - mean[j]) / sd[j];
            value -= 0.5 * z * z + std::log(sd[j]) + 0.91893853320467274;
          }
          return value;
        },
        Eigen::VectorXd::Constant(d, -15.0), Eigen::VectorXd::Constant(d, 10.0));
    const Options options = good_options(d);
    const auto results = replicate(problem, options, static_cast<std::uint64_t>(d));
    for (Index j = 0; j < d; ++j) {
      check_normal_margin(results, j, mean[j], sd[j], options.samples);
    }
    const Estimate evidence = over_runs(results, [](const Result& r) { return r.final.log_evidence; });
    check(evidence, log_evidence, 10.0, options.samples);
    CHECK(evidence.standard_deviation < 0.5);
  }
}

TEST_CASE("both criteria and both means sample an asymmetric, correlated posterior", "[tmcmc][sampler]") {
  for (const Criterion& criterion :
       {tmcmc::coefficient_of_variation_rule(), tmcmc::effective_sample_size_rule()}) {
    for (const Centre centre : {Centre::weighted_mean, Centre::plain_mean}) {
      CAPTURE(criterion.rule.index(), static_cast<int>(centre));
      Options options = good_options(2);
      options.criterion = criterion;
      options.centre = centre;
      const auto results = replicate(gamma_normal(), options, 7);
      check_gamma_normal(results, options.samples);
    }
  }
}

TEST_CASE("one stage of growing chains has the distribution of its kernel, not the posterior",
          "[tmcmc][sampler]") {
  // Uniform prior on [0, 1], likelihood exp(-rate x), one stage. For large N the number of picks of
  // a chain that starts at x is Poisson with mean lambda(x) = L(x) / mean L, and the k-th state of
  // the chain is in the population if there are k picks: its density is the sum over k of P(picks
  // >= k | x) K^k(x, .). P(picks >= k) is not proportional to the weight, so that this is not the
  // posterior unless K mixes at once or not at all.
  constexpr double rate = 6.0;
  constexpr Index cells = 300;
  constexpr double h = 1.0 / cells;
  const double mean_likelihood = -std::expm1(-rate) / rate;
  const double exact_mean = 1.0 / rate - 1.0 / std::expm1(rate);
  const double exact_second = (2.0 / rate * exact_mean) - 1.0 / std::expm1(rate);
  Options options;
  options.samples = 5000;
  options.scale_rule = tmcmc::FixedScale{1.0};
  const double sd = std::get<tmcmc::FixedScale>(options.scale_rule).scale *
                    std::sqrt(exact_second - exact_mean * exact_mean);

  Eigen::MatrixXd kernel(cells, cells);
  Eigen::VectorXd x(cells);
  Eigen::VectorXd picks(cells);
  for (Index i = 0; i < cells; ++i) {
    x[i] = h * (static_cast<double>(i) + 0.5);
    picks[i] = std::exp(-rate * x[i]) / mean_likelihood;
  }
  for (Index i = 0; i < cells; ++i) {
    for (Index j = 0; j < cells; ++j) {
      const double proposed = statistics::normal_cdf((x[j] + 0.5 * h - x[i]) / sd) -
                              statistics::normal_cdf((x[j] - 0.5 * h - x[i]) / sd);
      kernel(i, j) = proposed * std::min(1.0, std::exp(-rate * (x[j] - x[i])));
    }
    kernel(i, i) += 1.0 - kernel.row(i).sum();
  }
  double growing_mean = 0.0;
  Eigen::VectorXd f = x;                             // K^k x
  Eigen::VectorXd poisson = (-picks.array()).exp();  // P(picks = k - 1)
  Eigen::VectorXd at_least = 1.0 - poisson.array();  // P(picks >= k)
  for (int k = 1; k <= 60; ++k) {
    f = (kernel * f).eval();
    growing_mean += h * at_least.dot(f);
    poisson.array() *= picks.array() / k;
    at_least -= poisson;
  }

  const Problem problem = problem_of([](const auto& point) { return -rate * point[0]; },
                                     Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  const auto mean_over_runs = [&](const tmcmc::Move& move) {
    options.move = move;
    std::vector<double> means;
    for (std::uint32_t run = 0; run < runs; ++run) {
      means.push_back(tmcmc::run(problem, options, {.seed = 13, .run = run}, {}, tmcmc::fixed_schedule({1.0}))
                          .final.points.mean());
    }
    return statistics::estimate(means);
  };
  const double discretisation = 1e-5;
  REQUIRE_THAT((h * picks).dot(x), WithinAbs(exact_mean, discretisation));
  const Estimate resampled = mean_over_runs(tmcmc::ResampleMove{.steps = 1});
  CHECK_THAT(resampled.mean,
             WithinAbs(exact_mean, standard_errors * resampled.standard_error + discretisation));
  const Estimate grown = mean_over_runs(tmcmc::GrowingChains{});
  CHECK_THAT(grown.mean, WithinAbs(growing_mean, standard_errors * grown.standard_error + discretisation));
  CHECK(std::fabs(grown.mean - exact_mean) > 2.0 * standard_errors * grown.standard_error);
}

TEST_CASE("a truncated posterior: rejection is right at the edge of the box, the redraw is not",
          "[tmcmc][sampler]") {
  // exp(-4 x) on [0, 1], most of it at the edge.
  const Problem problem = problem_of([](const auto& x) { return -4.0 * x[0]; }, Eigen::VectorXd::Zero(1),
                                     Eigen::VectorXd::Ones(1));
  const double mean = 0.25 - 1.0 / std::expm1(4.0);
  const double log_evidence = std::log(-std::expm1(-4.0) / 4.0);
  Options options = good_options(1);
  const auto right = replicate(problem, options, 8);
  check(mean_of(
            right, [](double x) { return x; }, 0),
        mean, 0.23, options.samples);
  check(over_runs(right, [](const Result& r) { return r.final.log_evidence; }), log_evidence, 2.0,
        options.samples);
  options.proposal = tmcmc::RedrawnWalk{};
  const Estimate biased = mean_of(
      replicate(problem, options, 8), [](double x) { return x; }, 0);
  CHECK(biased.mean > mean + 2.0 * standard_errors * biased.standard_error);
}

TEST_CASE("a parameter that the likelihood ignores stays uniform", "[tmcmc][sampler]") {
  const Problem problem = problem_of([](const auto& x) { return -200.0 * (x[0] - 0.3) * (x[0] - 0.3); },
                                     Eigen::Vector2d(-2.0, 1.0), Eigen::Vector2d(2.0, 3.0));
  for (const tmcmc::Move& move : {tmcmc::Move(tmcmc::ResampleMove{}), tmcmc::Move(tmcmc::GrowingChains{})}) {
    CAPTURE(move.index());
    Options options = good_options(2);
    options.samples = 300;
    options.move = move;
    const auto results = replicate(problem, options, 9, 200);
    // Kolmogorov's test wants independent draws: one of each run.
    std::vector<double> draws;
    for (const Result& result : results) {
      draws.push_back(result.final.points(static_cast<Index>(draws.size()) % 300, 1));
    }
    CHECK(statistics::kolmogorov(draws, [](double x) { return (x - 1.0) / 2.0; }) <
          statistics::kolmogorov_bound);
    for (const double level : {1.05, 1.5, 2.0, 2.5, 2.95}) {  // and all draws, with errors from the runs
      CAPTURE(level);
      const Estimate below = mean_of(
          results, [=](double x) { return x < level ? 1.0 : 0.0; }, 1);
      CHECK(below.errors_from((level - 1.0) / 2.0) < standard_errors);
      CHECK(below.standard_error < 0.01);
    }
  }
}

TEST_CASE("excluded draws: evidence and posterior of a likelihood that is zero on most of the box",
          "[tmcmc][sampler]") {
  // Zero outside [0, 1] of [0, 8], and exp(-12 x) inside.
  const double infinity = std::numeric_limits<double>::infinity();
  const Problem problem = problem_of([=](const auto& x) { return x[0] <= 1.0 ? -12.0 * x[0] : -infinity; },
                                     Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 8.0));
  const double log_evidence = std::log(-std::expm1(-12.0) / 12.0 / 8.0);
  const double mean = 1.0 / 12.0 - 1.0 / std::expm1(12.0);
  const Options options = good_options(1);
  const auto results = replicate(problem, options, 10);
  check(mean_of(
            results, [](double x) { return x; }, 0),
        mean, 1.0 / 12.0, options.samples);
  check(over_runs(results, [](const Result& r) { return r.final.log_evidence; }), log_evidence, 10.0,
        options.samples);
  for (const Result& result : results) {
    CHECK(result.final.points.maxCoeff() <= 1.0);
    CHECK(result.stages.front().feasible < 150);
    CHECK(result.stages.back().feasible == options.samples);
  }
}

TEST_CASE("evidence from a fixed schedule is unbiased", "[tmcmc][sampler]") {
  // E[Z] = Z at any N where the schedule does not depend on the draws; 30 samples show a bias of
  // log Z instead.
  const Problem problem = problem_of([](const auto& x) { return -4.0 * x[0]; }, Eigen::VectorXd::Zero(1),
                                     Eigen::VectorXd::Ones(1));
  Options options = good_options(1);
  options.samples = 30;
  std::vector<double> evidence;
  for (std::uint32_t run = 0; run < 2000; ++run) {
    const Result result =
        tmcmc::run(problem, options, {.seed = 11, .run = run}, {}, tmcmc::fixed_schedule({0.3, 0.7, 1.0}));
    evidence.push_back(std::exp(result.final.log_evidence));
  }
  CHECK(statistics::estimate(evidence).errors_from(-std::expm1(-4.0) / 4.0) < standard_errors);
}

TEST_CASE("the two criteria give the same distribution of results", "[tmcmc][sampler]") {
  // The same equation, hence the same steps and the same bits, but for rounding of the root.
  const Problem problem = problem_of([](const auto& x) { return -50.0 * x[0] - 3.0 * x[1] * x[1]; },
                                     Eigen::Vector2d(0.0, -4.0), Eigen::Vector2d(1.0, 4.0));
  Options options = good_options(2);
  options.criterion = tmcmc::coefficient_of_variation_rule();
  const Result cov = tmcmc::run(problem, options, {.seed = 12});
  options.criterion = tmcmc::effective_sample_size_rule();
  const Result ess = tmcmc::run(problem, options, {.seed = 12});
  REQUIRE(cov.stages.size() == ess.stages.size());
  CHECK((cov.final.points - ess.final.points).cwiseAbs().maxCoeff() < 1e-9);
  CHECK_THAT(cov.final.log_evidence, WithinAbs(ess.final.log_evidence, 1e-9));
}
