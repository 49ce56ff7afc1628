#include "tmcmc/detail/proposal_covariance.hpp"

#include <cmath>

#include "portable_math/multiversion.hpp"
#include "portable_math/sums.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc::detail {

namespace {

PORTABLE_MATH_MULTIVERSION
double plain_sum(const double* x, std::size_t n) {
  return portable_math::sum_of(n, [=](std::size_t i) { return x[i]; });
}

PORTABLE_MATH_MULTIVERSION
double weighted_sum(const double* w, const double* x, std::size_t n) {
  return portable_math::sum_of(n, [=](std::size_t i) { return w[i] * x[i]; });
}

PORTABLE_MATH_MULTIVERSION
double weighted_product(const double* w, const double* x, double mean_x, const double* y, double mean_y,
                        std::size_t n) {
  return portable_math::sum_of(n, [=](std::size_t i) { return w[i] * ((x[i] - mean_x) * (y[i] - mean_y)); });
}

/// Sums over the rows, one for each of the d columns.
template <class ColumnSum>
Eigen::VectorXd column_sums(const Population& points, int threads, ColumnSum column_sum) {
  const auto sums = [&](Index begin, Index end) {
    Eigen::VectorXd sum(points.cols());
    for (Index j = 0; j < points.cols(); ++j) {
      sum[j] = column_sum(points.col(j).data() + begin, begin, static_cast<std::size_t>(end - begin));
    }
    return sum;
  };
  const auto add = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) -> Eigen::VectorXd {
    return a + b;
  };
  return reduce_blocks(points.rows(), threads, sums, add);
}

Eigen::VectorXd plain_mean(const Population& points, int threads) {
  return column_sums(points, threads, [](const double* x, Index, std::size_t n) { return plain_sum(x, n); }) /
         static_cast<double>(points.rows());
}

}  // namespace

Eigen::VectorXd weighted_mean(const Population& points, ConstDoubles weights, double weight_sum,
                              int threads) {
  return column_sums(points, threads,
                     [&](const double* x, Index begin, std::size_t n) {
                       return weighted_sum(weights.data() + begin, x, n);
                     }) /
         weight_sum;
}

Eigen::MatrixXd proposal_covariance(const Population& points, ConstDoubles weights, double weight_sum,
                                    double scale, Centre centre, int threads) {
  const Index n = points.rows();
  const Index d = points.cols();
  const double* w = weights.data();
  const auto add = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) -> Eigen::MatrixXd {
    return a + b;
  };
  const Eigen::VectorXd mean = centre == Centre::weighted_mean
                                   ? weighted_mean(points, weights, weight_sum, threads)
                                   : plain_mean(points, threads);
  const auto products = [&](Index begin, Index end) {
    const auto rows = static_cast<std::size_t>(end - begin);
    Eigen::MatrixXd sum(d, d);
    for (Index j = 0; j < d; ++j) {
      for (Index k = 0; k <= j; ++k) {
        sum(j, k) = weighted_product(w + begin, points.col(j).data() + begin, mean[j],
                                     points.col(k).data() + begin, mean[k], rows);
        sum(k, j) = sum(j, k);
      }
    }
    return sum;
  };
  return scale * scale * (reduce_blocks(n, threads, products, add) / weight_sum);
}

Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& covariance) {
  constexpr double rounding = 1e-12;
  // A pivot just above `rounding` is accurate to three digits, and so are the pivots after it,
  // which may become negative.
  constexpr double rounding_behind_small_pivots = 1e-2;
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
    if (!std::isfinite(pivot) || pivot < -rounding_behind_small_pivots * covariance(k, k)) {
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

}  // namespace tmcmc::detail
