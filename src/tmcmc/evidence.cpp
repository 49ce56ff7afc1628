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
constexpr double smallest_sum = 1e-300;  // of the overlap of two populations
constexpr double smallest_slope = 1e-3;  // of populations in the wrong order

/// Logarithms of the weights, relative to the largest; all alike for a step of 0.
void log_weigh(ConstDoubles log_likelihood, double step, double largest, std::vector<double>& log_weights) {
  log_weights.resize(log_likelihood.size());
  std::transform(log_likelihood.begin(), log_likelihood.end(), log_weights.begin(),
                 [=](double value) { return step > 0.0 ? step * (value - largest) : 0.0; });
}

/// 1 / (1 + exp(-x)), without overflow.
PORTABLE_MATH_INLINE double logistic(double x) {
  const double e = portable_math::exp(x > 0.0 ? -x : x);
  return (x > 0.0 ? 1.0 : e) / (1.0 + e);
}

/// Sums over a population of p = logistic(sign (log_weight - centre)) and of p (1 - p).
struct LogisticSums {
  double total;
  double slope;
};

/// Where a population has nothing in common with the other, both are the least number, as in the limit.
PORTABLE_MATH_MULTIVERSION
LogisticSums logistic_sums(const double* log_weights, std::size_t n, double sign, double centre) {
  const double total =
      portable_math::sum_of(n, [=](std::size_t i) { return logistic(sign * (log_weights[i] - centre)); });
  const double slope = portable_math::sum_of(n, [=](std::size_t i) {
    const double p = logistic(sign * (log_weights[i] - centre));
    return p - p * p;
  });
  return total > smallest_sum ? LogisticSums{total, slope} : LogisticSums{smallest_sum, smallest_sum};
}

/// log(m / (feasible - m)) below the least finite log-weight, the logistic sum over both populations is m or more.
double least_centre(const std::vector<double>& before, const std::vector<double>& after) {
  double least = 0.0;
  double feasible = 0.0;
  for (const auto* population : {&before, &after}) {
    for (const double value : *population) {
      least = value == -infinity ? least : std::min(least, value);
      feasible += value == -infinity ? 0.0 : 1.0;
    }
  }
  const double m = static_cast<double>(after.size());
  return least - std::max(portable_math::log(m / (feasible - m)), 0.0);
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
  log_weigh(before, step, largest, log_weights_before_);
  log_weigh(after, step, largest, log_weights_after_);
  const std::vector<double>& w = log_weights_before_;
  const std::vector<double>& v = log_weights_after_;

  LogisticSums a{};
  LogisticSums b{};
  double slope = 1.0;  // minus the derivative of the residual below
  const auto residual = [&](double centre) {
    a = logistic_sums(w.data(), n, 1.0, centre);
    b = logistic_sums(v.data(), m, -1.0, centre);
    slope = std::max(a.slope / a.total + b.slope / b.total, smallest_slope);
    return std::make_tuple(portable_math::log(a.total / b.total), -slope);
  };
  const double log_size_ratio = portable_math::log(static_cast<double>(m) / static_cast<double>(n));
  const double lowest = least_centre(w, v) - 1.0;
  const double highest = std::max(-log_size_ratio, 0.0) + 1.0;
  const double log_mean_weight =
      portable_math::log(portable_math::sum_of(n, [&](std::size_t i) { return portable_math::exp(w[i]); }) /
                         static_cast<double>(n));
  std::uintmax_t iterations = 100;
  const double centre = boost::math::tools::newton_raphson_iterate(
      residual, std::clamp(log_mean_weight - log_size_ratio, lowest, highest), lowest, highest, 40,
      iterations);
  residual(centre);
  log_evidence_ += step * largest + (centre + log_size_ratio);
  least_variance_ +=
      std::max(1.0 / a.total - 1.0 / static_cast<double>(n) - 1.0 / static_cast<double>(m), 0.0);

  const std::size_t chains = parents.size();
  if (influence_.empty()) {  // the draws from the prior
    influence_.assign(n, 0.0);
    parents_.resize(n);
    std::iota(parents_.begin(), parents_.end(), Index{0});
  }
  const std::size_t chains_before = influence_.size();
  for (std::size_t i = 0; i < n; ++i) {
    influence_[i % chains_before] +=
        (logistic(w[i] - centre) / a.total - 1.0 / static_cast<double>(n)) / slope;
  }
  variance_ += variance_of(influence_);
  std::swap(previous_influence_, influence_);
  influence_.assign(chains, 0.0);
  for (std::size_t i = 0; i < m; ++i) {
    influence_[i % chains] -= (logistic(centre - v[i]) / b.total - 1.0 / static_cast<double>(m)) / slope;
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
  return influence_.empty() ? 0.0 : std::sqrt(std::max(variance_ + variance_of(influence_), least_variance_));
}

}  // namespace tmcmc
