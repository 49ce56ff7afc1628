/// \file
/// Metropolis chains outside a sampler, for tests of what a step does.
#pragma once

#include <cmath>
#include <vector>

#include "tmcmc/detail/metropolis_step.hpp"
#include "tmcmc/problems.hpp"

namespace chains {

inline tmcmc::BoxPrior unit_box(tmcmc::Index d) {
  return {Eigen::VectorXd::Zero(d), Eigen::VectorXd::Ones(d)};
}

inline std::vector<double> column(const tmcmc::Population& points, tmcmc::Index j) {
  return {points.col(j).begin(), points.col(j).end()};
}

/// A population on which steps are made, with all that they need.
struct Chains {
  tmcmc::LogLikelihood log_likelihood;
  tmcmc::BoxPrior prior;
  tmcmc::detail::MetropolisKernel kernel;
  tmcmc::Population points;
  Eigen::VectorXd values{};
  std::uint64_t seed = 1;
  int threads = 1;
  tmcmc::Index batch_rows = 0;

  tmcmc::detail::MoveCounts move(std::uint32_t steps, std::span<const tmcmc::Index> rows = {},
                                 std::uint32_t first_draw = 0) {
    values.resize(points.rows());
    log_likelihood(points, values);
    tmcmc::detail::Mover mover(log_likelihood, prior, {.seed = seed}, threads, batch_rows);
    tmcmc::detail::MoveCounts counts;
    for (std::uint32_t k = 0; k < steps; ++k) {
      counts += mover.step(kernel, rows, first_draw + k, points, values);
    }
    return counts;
  }
};

/// Distribution function of the density proportional to exp(-rate x) on [0, 1].
inline double exponential_cdf(double x, double rate) {
  return std::expm1(-rate * x) / std::expm1(-rate);
}

inline double exponential_draw(double u, double rate) {
  return -std::log1p(u * std::expm1(-rate)) / rate;
}

}  // namespace chains
