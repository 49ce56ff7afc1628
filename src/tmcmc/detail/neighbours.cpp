#include "tmcmc/detail/neighbours.hpp"

#include <algorithm>
#include <cmath>

#include "tmcmc/detail/proposal_covariance.hpp"

namespace tmcmc::detail {

void distances_from(const Population& white, Index i, std::vector<double>& squared) {
  std::fill(squared.begin(), squared.end(), 0.0);
  for (Index j = 0; j < white.cols(); ++j) {
    const double* x = white.col(j).data();
    for (std::size_t k = 0; k < squared.size(); ++k) {
      const double difference = x[k] - x[i];
      squared[k] += difference * difference;
    }
  }
}

Neighbours neighbours_of(const Population& white, Index count) {
  const auto n = static_cast<std::size_t>(white.rows());
  Neighbours result{std::vector<std::vector<Index>>(n), std::vector<double>(n)};
  std::vector<double> squared(n);
  std::vector<double> sorted(n);
  for (std::size_t i = 0; i < n; ++i) {
    distances_from(white, static_cast<Index>(i), squared);
    squared[i] = -1.0;  // itself comes first
    sorted = squared;
    std::nth_element(sorted.begin(), sorted.begin() + count, sorted.end());
    const double last = sorted[static_cast<std::size_t>(count)];
    result.reach[i] = std::sqrt(last);
    auto room = count - std::count_if(squared.begin(), squared.end(), [&](double x) { return x < last; }) + 1;
    for (std::size_t k = 0; k < n; ++k) {
      if (k != i && (squared[k] < last || (squared[k] == last && room-- > 0))) {  // of equals the first
        result.of[i].push_back(static_cast<Index>(k));
      }
    }
  }
  return result;
}

Population whitened(const Population& points, const Eigen::MatrixXd& factor) {
  Population white(points.rows(), points.cols());
  for (Index j = 0; j < points.cols(); ++j) {
    for (Index i = 0; i < points.rows(); ++i) {
      double sum = points(i, j);
      for (Index k = 0; k < j; ++k) {
        sum -= factor(j, k) * white(i, k);
      }
      white(i, j) = factor(j, j) > 0.0 ? sum / factor(j, j) : 0.0;
    }
  }
  return white;
}

Population with_isotropic_neighbours(const Population& white, const Neighbours& neighbours) {
  const Index d = white.cols();
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(d, d);
  for (Index i = 0; i < white.rows(); ++i) {
    const double reach = neighbours.reach[static_cast<std::size_t>(i)];
    for (const Index k : neighbours.of[static_cast<std::size_t>(i)]) {
      for (Index j = 0; j < d; ++j) {
        for (Index l = 0; l <= j; ++l) {
          scatter(j, l) += (white(i, j) - white(k, j)) / reach * ((white(i, l) - white(k, l)) / reach);
        }
      }
    }
  }
  return whitened(white, cholesky_factor(scatter / static_cast<double>(white.rows())));
}

}  // namespace tmcmc::detail
