#include "tmcmc/student_mixture.hpp"

#include <algorithm>
#include <numbers>

#include "portable_math/elementary.hpp"
#include "portable_math/multiversion.hpp"
#include "tmcmc/detail/mixture_terms.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

namespace {

PORTABLE_MATH_MULTIVERSION
void add_logarithms(Index rows, const double* sum, const double* log_scale, double* result) {
  for (Index i = 0; i < rows; ++i) {
    result[i] = log_scale[i] + portable_math::log(sum[i]);
  }
}

PORTABLE_MATH_MULTIVERSION
void add_relative(Index rows, double log_factor, const double* sum, const double* log_scale,
                  const double* log_unit, double* total) {
  for (Index i = 0; i < rows; ++i) {
    total[i] += portable_math::exp(log_factor + log_scale[i] - log_unit[i]) * sum[i];
  }
}

/// Calls use(terms, begin, rows) for each block of rows of the points.
template <class Use>
void for_each_mixture_rows(const StudentMixture& mixture, const Population& points, int threads, Use use) {
  for_each_block(points.rows(), reduction_rows, threads, [&](Index, Index begin, Index end) {
    detail::MixtureTerms terms(mixture);
    for (Index i = begin; i < end; i += detail::mixture_rows) {
      const Index rows = std::min(detail::mixture_rows, end - i);
      terms.evaluate(points.data() + i, points.rows(), rows);
      use(terms, i, rows);
    }
  });
}

}  // namespace

Eigen::VectorXd log_density(const StudentMixture& mixture, const Population& points, int threads) {
  Eigen::VectorXd result(points.rows());
  for_each_mixture_rows(mixture, points, threads, [&](const auto& terms, Index begin, Index rows) {
    add_logarithms(rows, terms.sum(), terms.log_scale(), result.data() + begin);
  });
  return result;
}

void add_relative_density(const StudentMixture& mixture, double log_factor, const Population& points,
                          const Eigen::VectorXd& log_scale, Eigen::VectorXd& total, int threads) {
  for_each_mixture_rows(mixture, points, threads, [&](const auto& terms, Index begin, Index rows) {
    add_relative(rows, log_factor, terms.sum(), terms.log_scale(), log_scale.data() + begin,
                 total.data() + begin);
  });
}

StudentMixture blend(const StudentMixture& a, double share, const StudentMixture& b) {
  StudentMixture result = a;
  result.weights.resize(a.size() + b.size());
  result.weights << share * a.weights, (1.0 - share) * b.weights;
  result.means.resize(a.dimension(), a.size() + b.size());
  result.means << a.means, b.means;
  result.factors.insert(result.factors.end(), b.factors.begin(), b.factors.end());
  return result;
}

double StudentMixture::wider() const {
  constexpr double log_most_volume = 4.0 * std::numbers::ln2;
  return std::min(2.0, portable_math::exp(log_most_volume / static_cast<double>(dimension())));
}

}  // namespace tmcmc
