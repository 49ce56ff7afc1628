/// \file
/// Sampling problems that several tests share.
#pragma once

#include <cmath>

#include "tmcmc/sampler.hpp"

namespace problems {

/// Batch log-likelihood from a function of one row.
template <class Function>
tmcmc::LogLikelihood by_rows(Function function) {
  return [function](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
    for (tmcmc::Index i = 0; i < points.rows(); ++i) {
      values[i] = function(points.row(i));
    }
  };
}

/// A narrow ridge in three dimensions, reached in about eight stages.
inline tmcmc::Problem ridge() {
  return {by_rows([](const auto& x) {
            const double a = (x[0] - 1.0) / 0.05;
            const double b = (x[1] - x[0]) / 0.1;
            return -0.5 * (a * a + b * b) - std::fabs(x[2]);
          }),
          tmcmc::BoxPrior(Eigen::Vector3d(-5.0, -5.0, -5.0), Eigen::Vector3d(5.0, 5.0, 5.0))};
}

inline tmcmc::Options few_samples() {
  tmcmc::Options options;
  options.samples = 203;
  options.scale_rule = tmcmc::FixedScale{0.8};
  return options;
}

inline tmcmc::Result run_ridge(const tmcmc::Options& options, const tmcmc::StreamKey& key = {.seed = 5}) {
  return tmcmc::run(ridge(), options, key);
}

}  // namespace problems
