#include "tmcmc/proposal.hpp"

#include <cmath>

#include "portable_math/sums.hpp"

namespace tmcmc {

Eigen::VectorXd weighted_mean(const Population& points, ConstDoubles weights, double weight_sum) {
  Eigen::VectorXd mean(points.cols());
  const double* w = weights.data();
  for (Index j = 0; j < points.cols(); ++j) {
    const double* x = points.col(j).data();
    mean[j] = portable_math::sum_of(weights.size(), [=](std::size_t i) { return w[i] * x[i]; }) / weight_sum;
  }
  return mean;
}

Eigen::MatrixXd proposal_covariance(const Population& points, ConstDoubles weights, double weight_sum,
                                    double scale, Centre centre) {
  const auto n = static_cast<std::size_t>(points.rows());
  const Index d = points.cols();
  Eigen::VectorXd mean = weighted_mean(points, weights, weight_sum);
  for (Index j = 0; j < d && centre == Centre::plain_mean; ++j) {
    const double* x = points.col(j).data();
    mean[j] = portable_math::sum_of(n, [=](std::size_t i) { return x[i]; }) / static_cast<double>(n);
  }
  Eigen::MatrixXd covariance(d, d);
  for (Index j = 0; j < d; ++j) {
    for (Index k = 0; k <= j; ++k) {
      const double* x = points.col(j).data();
      const double* y = points.col(k).data();
      const double* w = weights.data();
      const double mean_x = mean[j];
      const double mean_y = mean[k];
      const double sum =
          portable_math::sum_of(n, [=](std::size_t i) { return w[i] * ((x[i] - mean_x) * (y[i] - mean_y)); });
      covariance(j, k) = scale * scale * (sum / weight_sum);
      covariance(k, j) = covariance(j, k);
    }
  }
  return covariance;
}

Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& covariance) {
  constexpr double rounding = 1e-12;
  const Index d = covariance.rows();
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(d, d);
  for (Index k = 0; k < d; ++k) {
    double pivot = covariance(k, k);
    for (Index l = 0; l < k; ++l) {
      pivot -= factor(k, l) * factor(k, l);
    }
    for (Index j = k; j < d; ++j) {
      if (!std::isfinite(covariance(j, k))) {
        pivot = covariance(j, k);
      }
    }
    if (!std::isfinite(pivot) || pivot < -rounding * covariance(k, k)) {
      throw SamplingError("the proposal covariance is not positive semidefinite and finite (row " +
                          std::to_string(k) + ")");
    }
    if (pivot <= rounding * covariance(k, k)) {
      continue;
    }
    factor(k, k) = std::sqrt(pivot);
    for (Index j = k + 1; j < d; ++j) {
      double sum = covariance(j, k);
      for (Index l = 0; l < k; ++l) {
        sum -= factor(j, l) * factor(k, l);
      }
      factor(j, k) = sum / factor(k, k);
    }
  }
  return factor;
}

}  // namespace tmcmc
