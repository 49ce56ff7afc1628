#include "tmcmc/reference_density.hpp"

#include <array>
#include <cmath>

#include "portable_math/multiversion.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

namespace {

/// Random words for the prior's draws and for the division into parts: beyond the words of the
/// mixture.
constexpr std::uint32_t prior_block = 2U << 24U;

/// log(exp(a) + exp(b)), where at least one of a and b is finite.
PORTABLE_MATH_MULTIVERSION
void log_add(double log_share_a, const double* a, double log_share_b, const double* b, Index n,
             double* result) {
  for (Index i = 0; i < n; ++i) {
    const double first = log_share_a + a[i];
    const double second = log_share_b + b[i];
    const double larger = first > second ? first : second;
    const double smaller = first > second ? second : first;
    result[i] = larger + portable_math::log_positive(1.0 + portable_math::exp(smaller - larger));
  }
}

}  // namespace

Eigen::VectorXd log_density(const ReferenceDensity& reference, const Population& z,
                            const Eigen::VectorXd& log_prior, int threads) {
  if (reference.prior_share == 1.0) {
    return log_prior;
  }
  Eigen::VectorXd result = log_density(reference.fitted, z, threads);
  if (reference.prior_share > 0.0) {
    log_add(portable_math::log(1.0 - reference.prior_share), result.data(),
            portable_math::log(reference.prior_share), log_prior.data(), z.rows(), result.data());
  }
  return result;
}

Population sample(const ReferenceDensity& reference, const Prior& prior, Index n, const StreamKey& key,
                  std::uint32_t stage, int threads) {
  const Index d = prior.dimension();
  DrawId id{.purpose = Purpose::reference, .stage = stage, .block = prior_block};
  const std::array<double, 2> shares{1.0 - reference.prior_share, reference.prior_share};
  const Index fitted = systematic_counts(shares, n, uniform_open(random_words(key, id)[0])).front();
  Population z(n, d);
  if (fitted > 0) {
    z.topRows(fitted) = sample(reference.fitted, fitted, key, stage, threads);
  }
  if (prior.is_box()) {
    for (Index i = fitted; i < n; ++i) {
      id.row = static_cast<std::uint64_t>(i);
      id.block = prior_block + 1U;
      RandomStream stream(key, id);
      for (Index j = 0; j < d; ++j) {
        const double u = stream.uniform();
        z(i, j) = portable_math::log(u) - portable_math::log(1.0 - u);
      }
    }
    return z;
  }
  Population x(n - fitted, d);
  Eigen::VectorXd point(d);
  for (Index i = fitted; i < n; ++i) {
    id.row = static_cast<std::uint64_t>(i);
    id.block = prior_block + 1U;
    prior.draw(key, id, point);
    x.row(i - fitted) = point.transpose();
  }
  z.bottomRows(n - fitted) = to_unbounded(x, prior);
  return z;
}

}  // namespace tmcmc
