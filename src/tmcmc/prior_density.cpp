// The density of a prior.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "portable_math/elementary.hpp"
#include "portable_math/multiversion.hpp"
#include "tmcmc/detail/infinity.hpp"
#include "tmcmc/prior.hpp"

namespace tmcmc {

namespace {

PORTABLE_MATH_MULTIVERSION
void add_squares(double sign, const double* x, std::size_t n, double* sum) {
  for (std::size_t i = 0; i < n; ++i) {
    sum[i] += sign * (x[i] * x[i]);
  }
}

PORTABLE_MATH_MULTIVERSION
void subtract(double factor, const double* x, std::size_t n, double* y) {
  for (std::size_t i = 0; i < n; ++i) {
    y[i] -= factor * x[i];
  }
}

PORTABLE_MATH_MULTIVERSION
void divide(double by, std::size_t n, double* x) {
  for (std::size_t i = 0; i < n; ++i) {
    x[i] /= by;
  }
}

}  // namespace

double Prior::log_constant() const {
  double sum = 0.0;
  for (const Marginal& marginal : marginals_) {
    sum += marginal.log_constant();
  }
  for (Index j = 0; j < factor_.rows(); ++j) {
    sum -= portable_math::log(factor_(j, j));
  }
  return sum;
}

void Prior::log_kernel(std::span<const double* const> columns, std::size_t n, double* result) const {
  std::fill_n(result, n, 0.0);
  if (own_ != nullptr) {
    own_log_density(columns, n, result);
    return;
  }
  for (std::size_t j = 0; j < marginals_.size(); ++j) {
    marginals_[j].add_log_kernel(columns[j], n, result);
  }
  if (factor_.size() > 0) {
    add_copula(columns, n, result);
  }
}

/// Adds the logarithm of the copula density: -(|L^-1 z|^2 - |z|^2) / 2, where z are the normal
/// scores, for blocks of points stored column by column.
void Prior::add_copula(std::span<const double* const> columns, std::size_t n, double* result) const {
  constexpr std::size_t block = 64;
  const Index d = dimension();
  std::vector<std::array<double, block>> white(static_cast<std::size_t>(d));
  std::array<double, block> sum{};
  for (std::size_t first = 0; first < n; first += block) {
    const std::size_t rows = std::min(block, n - first);
    sum.fill(0.0);
    for (Index j = 0; j < d; ++j) {
      auto& rest = white[static_cast<std::size_t>(j)];
      if (!correlated_[static_cast<std::size_t>(j)]) {
        continue;
      }
      marginals_[static_cast<std::size_t>(j)].normal_scores(columns[static_cast<std::size_t>(j)] + first,
                                                            rows, rest.data());
      add_squares(-1.0, rest.data(), rows, sum.data());
      for (Index k = 0; k < j; ++k) {
        if (factor_(j, k) != 0.0) {
          subtract(factor_(j, k), white[static_cast<std::size_t>(k)].data(), rows, rest.data());
        }
      }
      divide(factor_(j, j), rows, rest.data());
      add_squares(1.0, rest.data(), rows, sum.data());
    }
    for (std::size_t i = 0; i < rows; ++i) {  // on a bound a score is infinite, outside it is NaN
      const double density = result[first + i] - 0.5 * sum[i];
      result[first + i] = std::isfinite(sum[i]) ? density : -detail::infinity;
    }
  }
}

void Prior::own_log_density(std::span<const double* const> columns, std::size_t n, double* result) const {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < n; ++i) {
    bool is_inside = true;
    for (Index j = 0; j < dimension(); ++j) {
      const double x = columns[static_cast<std::size_t>(j)][i];
      is_inside = is_inside && x >= lower_[j] && x <= upper_[j];
    }
    if (is_inside) {
      rows.push_back(i);
    } else {
      result[i] = -detail::infinity;
    }
  }
  if (rows.empty()) {
    return;
  }
  const auto count = static_cast<Index>(rows.size());
  Population points(count, dimension());
  Eigen::VectorXd values = Eigen::VectorXd::Constant(count, std::numeric_limits<double>::quiet_NaN());
  for (Index j = 0; j < dimension(); ++j) {
    for (Index k = 0; k < count; ++k) {
      points(k, j) = columns[static_cast<std::size_t>(j)][rows[static_cast<std::size_t>(k)]];
    }
  }
  own_->log_density(points, values);
  for (Index k = 0; k < count; ++k) {
    if (!(values[k] < detail::infinity)) {
      std::ostringstream message;
      message.precision(17);
      message << "the log-density of the prior is " << values[k] << " at (";
      for (Index j = 0; j < dimension(); ++j) {
        message << (j > 0 ? ", " : "") << points(k, j);
      }
      message << "): expected a finite number or minus infinity";
      throw SamplingError(message.str());
    }
    result[rows[static_cast<std::size_t>(k)]] = values[k];
  }
}

Eigen::VectorXd Prior::log_density(const Population& points) const {
  std::vector<const double*> columns;
  for (Index j = 0; j < points.cols(); ++j) {
    columns.push_back(points.col(j).data());
  }
  Eigen::VectorXd result(points.rows());
  log_kernel(columns, static_cast<std::size_t>(points.rows()), result.data());
  return result.array() + log_constant();
}

}  // namespace tmcmc
