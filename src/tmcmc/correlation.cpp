#include "tmcmc/correlation.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "errors/invalid_value.hpp"

namespace tmcmc {

namespace {

using Eigen::Index;

constexpr std::size_t orders = 120;             // of Hermite polynomials
constexpr double largest_correlation = 0.9999;  // of normal scores that are looked for
constexpr double largest_score = 9.0;
constexpr int points_per_unit = 256;

/// Coefficients a_1, a_2, ... of F^-1(Phi(z)) in normalised Hermite polynomials, divided by the
/// standard deviation.
std::vector<double> hermite_coefficients(const Marginal& marginal) {
  if (!marginal.has_variance()) {
    throw errors::InvalidValue(
        "correlation", marginal.text(),
        "a distribution with a finite variance, or the correlation of the normal scores");
  }
  std::vector<double> a(orders + 1, 0.0);
  double square = 0.0;
  const int last = static_cast<int>(largest_score) * points_per_unit;
  for (int i = -last; i <= last; ++i) {  // the trapezoidal rule is as good as exact for such integrands
    const double z = static_cast<double>(i) / points_per_unit;
    const double weight =
        std::exp(-0.5 * z * z) / (std::sqrt(2.0 * 3.14159265358979323846) * points_per_unit);
    const double x = marginal.from_normal(z);
    square += weight * x * x;
    double before = 0.0;
    double h = 1.0;
    for (std::size_t k = 0; k <= orders; ++k) {
      a[k] += weight * x * h;
      const double next =
          (z * h - std::sqrt(static_cast<double>(k)) * before) / std::sqrt(static_cast<double>(k) + 1.0);
      before = h;
      h = next;
    }
  }
  const double sd = std::sqrt(square - a[0] * a[0]);
  a.erase(a.begin());
  for (double& coefficient : a) {
    coefficient /= sd;
  }
  return a;
}

double mehler(const std::vector<double>& a, const std::vector<double>& b, double rho) {
  double sum = 0.0;
  for (std::size_t k = a.size(); k > 0; --k) {
    sum = rho * (a[k - 1] * b[k - 1] + sum);
  }
  return sum;
}

std::string entry(Index i, Index j) {
  return "correlation(" + std::to_string(i) + ", " + std::to_string(j) + ")";
}

double score_correlation(const std::vector<double>& a, const std::vector<double>& b, double target,
                         const std::string& field) {
  const double least = mehler(a, b, -largest_correlation);
  const double most = mehler(a, b, largest_correlation);
  if (!(target > least && target < most)) {
    throw errors::InvalidValue(field, target,
                               "a number from " + std::to_string(least) + " to " + std::to_string(most) +
                                   ", what a Gaussian copula of these distributions can have");
  }
  std::uintmax_t iterations = 100;
  const auto root = boost::math::tools::toms748_solve(
      [&](double rho) { return mehler(a, b, rho) - target; }, -largest_correlation, largest_correlation,
      least - target, most - target, [](double low, double high) { return high - low < 1e-14; }, iterations);
  return 0.5 * (root.first + root.second);
}

/// Row of the first pivot of the Cholesky factor that is not positive; -1 if there is none.
Index first_bad_pivot(const Eigen::MatrixXd& matrix) {
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(matrix.rows(), matrix.cols());
  for (Index j = 0; j < matrix.cols(); ++j) {
    for (Index i = j; i < matrix.rows(); ++i) {
      double rest = matrix(i, j);
      for (Index k = 0; k < j; ++k) {
        rest -= factor(i, k) * factor(j, k);
      }
      if (i == j && !(rest > 1e-12)) {
        return i;
      }
      factor(i, j) = i == j ? std::sqrt(rest) : rest / factor(j, j);
    }
  }
  return -1;
}

}  // namespace

void require_correlation(const Eigen::MatrixXd& matrix, Index d) {
  if (matrix.rows() != d || matrix.cols() != d) {
    throw errors::InvalidValue("correlation",
                               std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()),
                               "a row and a column for each of the " + std::to_string(d) + " parameters");
  }
  for (Index i = 0; i < d; ++i) {
    for (Index j = 0; j <= i; ++j) {
      if (i == j && matrix(i, i) != 1.0) {
        throw errors::InvalidValue(entry(i, i), matrix(i, i), "1 on the diagonal");
      }
      if (i != j && !(std::fabs(matrix(i, j)) < 1.0)) {
        throw errors::InvalidValue(entry(i, j), matrix(i, j), "a number between -1 and 1");
      }
      if (matrix(i, j) != matrix(j, i)) {
        throw errors::InvalidValue(
            entry(i, j), matrix(i, j),
            "the same number as on the other side of the diagonal, " + std::to_string(matrix(j, i)));
      }
    }
  }
  const Index bad = first_bad_pivot(matrix);
  if (bad >= 0) {
    throw errors::InvalidValue("correlation", "",
                               "a positive definite matrix, which that of the first " +
                                   std::to_string(bad + 1) +
                                   " parameters is not: no random numbers can be correlated so");
  }
}

double parameter_correlation(const Marginal& a, const Marginal& b, double rho) {
  return mehler(hermite_coefficients(a), hermite_coefficients(b), rho);
}

Eigen::MatrixXd normal_score_correlation(const Correlation& correlation,
                                         std::span<const Marginal> marginals) {
  const auto d = static_cast<Index>(marginals.size());
  require_correlation(correlation.matrix, d);
  if (correlation.of == CorrelationOf::normal_scores) {
    return correlation.matrix;
  }
  Eigen::MatrixXd scores = Eigen::MatrixXd::Identity(d, d);
  std::vector<std::vector<double>> coefficients(marginals.size());
  const auto coefficients_of = [&](Index j) -> const std::vector<double>& {
    auto& a = coefficients[static_cast<std::size_t>(j)];
    if (a.empty()) {
      a = hermite_coefficients(marginals[static_cast<std::size_t>(j)]);
    }
    return a;
  };
  for (Index i = 0; i < d; ++i) {
    for (Index j = 0; j < i; ++j) {
      if (correlation.matrix(i, j) != 0.0) {
        scores(i, j) =
            score_correlation(coefficients_of(i), coefficients_of(j), correlation.matrix(i, j), entry(i, j));
        scores(j, i) = scores(i, j);
      }
    }
  }
  if (first_bad_pivot(scores) >= 0) {
    throw errors::InvalidValue(
        "correlation", "",
        "correlations that the parameters can have at once under a Gaussian copula: the matrix "
        "of their normal scores is not positive definite");
  }
  return scores;
}

}  // namespace tmcmc
