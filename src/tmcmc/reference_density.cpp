#include "tmcmc/reference_density.hpp"

#include <array>
#include <cmath>

#include "portable_math/multiversion.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

namespace {

/// Random words of the prior's draws and of the division into parts: beyond those of the mixture.
constexpr std::uint32_t prior_block = 2U << 24U;

PORTABLE_MATH_MULTIVERSION
void add_log_logistic(const double* z, Index n, double* log_density) {
  for (Index i = 0; i < n; ++i) {
    const double distance = std::fabs(z[i]);
    log_density[i] -= distance + 2.0 * portable_math::log_positive(1.0 + portable_math::exp(-distance));
  }
}

PORTABLE_MATH_MULTIVERSION
void enter_box(const double* z, Index n, double low, double high, double first, double last, double* x) {
  for (Index i = 0; i < n; ++i) {
    const double e = portable_math::exp(-std::fabs(z[i]));
    const double part = (high - low) * (e / (1.0 + e));
    const double value = z[i] > 0.0 ? high - part : low + part;
    const double above = value > first ? value : first;
    x[i] = above < last ? above : last;
  }
}

/// log(exp(a) + exp(b)), b finite.
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

Eigen::VectorXd log_prior_density(const Population& z, int threads) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(z.rows());
  for_each_block(z.rows(), reduction_rows, threads, [&](Index, Index begin, Index end) {
    for (Index j = 0; j < z.cols(); ++j) {
      add_log_logistic(z.col(j).data() + begin, end - begin, result.data() + begin);
    }
  });
  return result;
}

Population from_unbounded(const Population& z, const BoxPrior& prior) {
  Population x(z.rows(), z.cols());
  for (Index j = 0; j < z.cols(); ++j) {
    const double low = prior.lower()[j];
    const double high = prior.upper()[j];
    enter_box(z.col(j).data(), z.rows(), low, high, std::nextafter(low, high), std::nextafter(high, low),
              x.col(j).data());
  }
  return x;
}

Eigen::VectorXd log_density(const ReferenceDensity& reference, const Population& z,
                            const Eigen::VectorXd& log_prior, int threads) {
  Eigen::VectorXd result = log_density(reference.fitted, z, threads);
  if (reference.prior_share > 0.0) {
    log_add(portable_math::log(1.0 - reference.prior_share), result.data(),
            portable_math::log(reference.prior_share), log_prior.data(), z.rows(), result.data());
  }
  return result;
}

Population sample(const ReferenceDensity& reference, Index n, const StreamKey& key, std::uint32_t stage,
                  int threads) {
  const Index d = reference.fitted.dimension();
  DrawId id{.purpose = Purpose::reference, .stage = stage, .block = prior_block};
  const std::array<double, 2> shares{1.0 - reference.prior_share, reference.prior_share};
  const Index fitted = systematic_counts(shares, n, uniform_open(random_words(key, id)[0])).front();
  Population z(n, d);
  z.topRows(fitted) = sample(reference.fitted, fitted, key, stage, threads);
  for (Index i = fitted; i < n; ++i) {
    Words words{};
    for (Index j = 0; j < d; ++j) {
      if (j % 4 == 0) {
        id.row = static_cast<std::uint64_t>(i);
        id.block = prior_block + 1U + static_cast<std::uint32_t>(j / 4);
        words = random_words(key, id);
      }
      const double u = uniform_open(words[static_cast<std::size_t>(j % 4)]);
      z(i, j) = portable_math::log(u) - portable_math::log(1.0 - u);
    }
  }
  return z;
}

}  // namespace tmcmc
