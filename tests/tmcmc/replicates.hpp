/// \file
/// Repeated runs, and posteriors in closed form to hold them against.
#pragma once

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <vector>

#include "tmcmc/problems.hpp"
#include "tmcmc/statistics.hpp"

namespace replicates {

constexpr std::uint32_t runs = 40;
constexpr double bias_constant = 2.0;  // bias of at most this / N posterior standard deviations

template <class Function>
tmcmc::Problem problem_of(Function function, Eigen::VectorXd lower, Eigen::VectorXd upper) {
  return {problems::by_rows(function), tmcmc::BoxPrior(std::move(lower), std::move(upper))};
}

inline std::vector<tmcmc::Result> replicate(const tmcmc::Problem& problem, const tmcmc::Options& options,
                                            std::uint64_t seed, std::uint32_t count = runs) {
  std::vector<tmcmc::Result> results;
  for (std::uint32_t run = 0; run < count; ++run) {
    results.push_back(tmcmc::run(problem, options, {.seed = seed, .run = run}));
    REQUIRE(results.back().stop == tmcmc::StopReason::completed);
  }
  return results;
}

inline statistics::Estimate over_runs(const std::vector<tmcmc::Result>& results,
                                      const std::function<double(const tmcmc::Result&)>& statistic) {
  std::vector<double> values;
  for (const tmcmc::Result& result : results) {
    values.push_back(statistic(result));
  }
  return statistics::estimate(values);
}

inline statistics::Estimate mean_of(const std::vector<tmcmc::Result>& results,
                                    const std::function<double(double)>& f, tmcmc::Index j) {
  return over_runs(results,
                   [&](const tmcmc::Result& r) { return r.final.points.col(j).unaryExpr(f).mean(); });
}

/// \param unit  posterior standard deviation of what is estimated
inline void check(const statistics::Estimate& e, double truth, double unit, tmcmc::Index samples) {
  CHECK_THAT(e.mean,
             Catch::Matchers::WithinAbs(truth, statistics::standard_errors * e.standard_error +
                                                   bias_constant * unit / static_cast<double>(samples)));
  CHECK(e.standard_error < 0.1 * unit);  // else nothing is tested
}

inline void check_normal_margin(const std::vector<tmcmc::Result>& results, tmcmc::Index j, double mean,
                                double sd, tmcmc::Index samples) {
  CAPTURE(j);
  check(mean_of(
            results, [](double x) { return x; }, j),
        mean, sd, samples);
  check(mean_of(
            results, [=](double x) { return (x - mean) * (x - mean); }, j),
        sd * sd, std::sqrt(2.0) * sd * sd, samples);
}

/// Moves that mix well, so that the errors are those of N samples.
inline tmcmc::Options good_options(tmcmc::Index dimension) {
  tmcmc::Options options;
  options.samples = 500;
  options.move = tmcmc::ResampleMove{.steps = 6};
  options.scale_rule = tmcmc::FixedScale{2.0 / std::sqrt(static_cast<double>(dimension))};
  return options;
}

/// Asymmetric and correlated. x: gamma with shape 3 and rate 2. y given x: Normal about 5 - x with
/// standard deviation 0.6. The likelihood is x^2 exp(-2 x) exp(-(y - 5 + x)^2 / 0.72), the box [0,
/// 20] x [-20, 10].
inline tmcmc::Problem gamma_normal() {
  return problem_of(
      [](const auto& x) {
        const double z = (x[1] - 5.0 + x[0]) / 0.6;
        return 2.0 * std::log(x[0]) - 2.0 * x[0] - 0.5 * z * z;
      },
      Eigen::Vector2d(0.0, -20.0), Eigen::Vector2d(20.0, 10.0));
}

/// Gamma(3) / 2^3 sqrt(2 pi) 0.6 / (20 * 30)
inline const double gamma_normal_log_evidence = std::log(0.25 * 2.5066282746310002 * 0.6 / 600.0);

inline void check_gamma_normal(const std::vector<tmcmc::Result>& results, tmcmc::Index samples) {
  const double gamma_sd = std::sqrt(3.0) / 2.0;
  // Central moments of the gamma: 3/4, 3/4.
  check(mean_of(
            results, [](double x) { return x; }, 0),
        1.5, gamma_sd, samples);
  check(mean_of(
            results, [](double x) { return (x - 1.5) * (x - 1.5); }, 0),
        0.75, 1.5, samples);
  check(mean_of(
            results, [](double x) { return std::pow(x - 1.5, 3); }, 0),
        0.75, 6.0, samples);
  check(mean_of(
            results, [](double y) { return y; }, 1),
        3.5, std::sqrt(0.75 + 0.36), samples);
  check(over_runs(results,
                  [](const tmcmc::Result& r) {
                    const auto x = r.final.points.col(0).array();
                    const auto y = r.final.points.col(1).array();
                    return ((x - 1.5) * (y - 3.5)).mean();
                  }),
        -0.75, 1.6, samples);
  check(over_runs(results, [](const tmcmc::Result& r) { return r.final.log_evidence; }),
        gamma_normal_log_evidence, 10.0, samples);
}

}  // namespace replicates
