#include "tmcmc/evidence.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "portable_math/multiversion.hpp"
#include "portable_math/sums.hpp"

namespace tmcmc {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

PORTABLE_MATH_MULTIVERSION
void weigh(const double* log_likelihood, std::size_t n, double step, double shift, double* weights) {
  for (std::size_t i = 0; i < n; ++i) {
    weights[i] = step > 0.0 ? portable_math::exp(step * (log_likelihood[i] - shift)) : 1.0;
  }
}

/// Means over one population of value / (s w + (1-s) r) and of its square over value, value being w or 1.
struct BridgeMeans {
  double mean;
  double slope;
};

PORTABLE_MATH_MULTIVERSION
BridgeMeans means_before(const double* w, std::size_t n, double s, double rest) {
  const double size = static_cast<double>(n);
  const double mean = portable_math::sum_of(n, [=](std::size_t i) { return w[i] / (s * w[i] + rest); });
  const double slope = portable_math::sum_of(n, [=](std::size_t i) {
    const double q = 1.0 / (s * w[i] + rest);
    return w[i] * q * q;
  });
  return {mean / size, slope / size};
}

PORTABLE_MATH_MULTIVERSION
BridgeMeans means_after(const double* w, std::size_t n, double s, double rest) {
  const double size = static_cast<double>(n);
  const double mean = portable_math::sum_of(n, [=](std::size_t i) { return 1.0 / (s * w[i] + rest); });
  const double slope = portable_math::sum_of(n, [=](std::size_t i) {
    const double q = 1.0 / (s * w[i] + rest);
    return q * q;
  });
  return {mean / size, slope / size};
}

}  // namespace

double effective_groups(std::span<const Index> groups) {
  std::vector<double> sizes;
  for (const Index g : groups) {
    sizes.resize(std::max(sizes.size(), static_cast<std::size_t>(g) + 1));
    sizes[static_cast<std::size_t>(g)] += 1.0;
  }
  const double n = static_cast<double>(groups.size());
  return n * n / std::inner_product(sizes.begin(), sizes.end(), sizes.begin(), 0.0);
}

double grouped_variance(ConstDoubles values, std::span<const Index> groups) {
  std::vector<double> sums;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto g = static_cast<std::size_t>(groups[i]);
    sums.resize(std::max(sums.size(), g + 1));
    sums[g] += values[i];
  }
  const double count = effective_groups(groups);
  return count > 1.0 ? std::inner_product(sums.begin(), sums.end(), sums.begin(), 0.0) * count / (count - 1.0)
                     : infinity;
}

void BridgeEvidence::add(ConstDoubles before, ConstDoubles after, std::span<const Index> parents,
                         double step) {
  const std::size_t n = before.size();
  const std::size_t m = after.size();
  const double largest = std::max(*std::max_element(before.begin(), before.end()),
                                  *std::max_element(after.begin(), after.end()));
  std::vector<double>& w = weights_before_;
  std::vector<double>& v = weights_after_;
  w.resize(n);
  v.resize(m);
  weigh(before.data(), n, step, largest, w.data());
  weigh(after.data(), m, step, largest, v.data());

  const double s = static_cast<double>(m) / static_cast<double>(n + m);
  BridgeMeans a{};
  BridgeMeans b{};
  double slope = 1.0;  // minus the derivative of the residual below
  const auto residual = [&](double log_ratio) {
    const double rest = (1.0 - s) * portable_math::exp(log_ratio);
    a = means_before(w.data(), n, s, rest);
    b = means_after(v.data(), m, s, rest);
    slope = 1.0 + rest * (a.slope / a.mean - b.slope / b.mean);
    return std::make_tuple(portable_math::log(a.mean / b.mean) - log_ratio, -slope);
  };
  const double lowest = -744.0;  // weights are at most 1, and the root lies between the least and the largest
  const double start = portable_math::log(portable_math::sum_of(n, [&](std::size_t i) { return w[i]; }) /
                                          static_cast<double>(n));
  std::uintmax_t iterations = 100;
  const double log_ratio = boost::math::tools::newton_raphson_iterate(
      residual, std::clamp(start, lowest, 0.0), lowest, 0.0, 40, iterations);
  residual(log_ratio);
  log_evidence_ += step * largest + log_ratio;

  const double rest = (1.0 - s) * portable_math::exp(log_ratio);
  const std::size_t chains = parents.size();
  if (influence_.empty()) {  // the draws from the prior
    influence_.assign(n, 0.0);
    parents_.resize(n);
    std::iota(parents_.begin(), parents_.end(), Index{0});
  }
  const std::size_t chains_before = influence_.size();
  for (std::size_t i = 0; i < n; ++i) {
    influence_[i % chains_before] +=
        (w[i] / (s * w[i] + rest) / a.mean - 1.0) / static_cast<double>(n) / slope;
  }
  variance_ += variance_of(influence_);
  std::swap(previous_influence_, influence_);
  influence_.assign(chains, 0.0);
  for (std::size_t i = 0; i < m; ++i) {
    influence_[i % chains] -= (1.0 / (s * v[i] + rest) / b.mean - 1.0) / static_cast<double>(m) / slope;
  }
  parents_.assign(parents.begin(), parents.end());
}

double BridgeEvidence::variance_of(const std::vector<double>& influence) const {
  std::vector<Index> own(influence.size());
  std::iota(own.begin(), own.end(), Index{0});
  double variance = grouped_variance(influence, effective_groups(parents_) > 1.0 ? parents_ : own);
  for (std::size_t c = 0; c < influence.size() && !previous_influence_.empty(); ++c) {
    variance += 2.0 * influence[c] * previous_influence_[static_cast<std::size_t>(parents_[c])];
  }
  return variance;
}

double BridgeEvidence::standard_error() const {
  return influence_.empty() ? 0.0 : std::sqrt(std::max(variance_ + variance_of(influence_), 0.0));
}

}  // namespace tmcmc
