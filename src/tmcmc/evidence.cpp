#include "tmcmc/evidence.hpp"

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "portable_math/multiversion.hpp"
#include "portable_math/sums.hpp"
#include "tmcmc/detail/infinity.hpp"

namespace tmcmc {

namespace {

constexpr double smallest_sum = 1e-300;  // of the overlap of two populations
constexpr double smallest_slope = 1e-3;  // of populations in the wrong order

/// Logarithms of the weights, relative to the largest; all equal for a step of 0.
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

/// If a population has nothing in common with the other, both sums are set to the smallest number,
/// as in the limit.
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

/// Lower limit of the centre: at log(m / (feasible - m)) below the smallest finite log-weight, the
/// logistic sum over both populations is at least m.
double least_centre(const std::vector<double>& before, const std::vector<double>& after) {
  double least = 0.0;
  double feasible = 0.0;
  for (const auto* population : {&before, &after}) {
    for (const double value : *population) {
      least = value == -detail::infinity ? least : std::min(least, value);
      feasible += value == -detail::infinity ? 0.0 : 1.0;
    }
  }
  const double m = static_cast<double>(after.size());
  return least - std::max(portable_math::log(m / (feasible - m)), 0.0);
}

/// Solution of the bridge equation: the centre of the logistic functions at which their sums over
/// both populations are equal.
struct Bridge {
  double centre;
  /// log(m / n); the log-ratio of the evidences is the centre plus this.
  double log_size_ratio;
  /// Sum of the logistic functions over either population.
  double overlap;
  /// By which a relative error of either sum is divided in the log-ratio.
  double slope;
};

Bridge solve_bridge(const std::vector<double>& before, const std::vector<double>& after) {
  const std::size_t n = before.size();
  const std::size_t m = after.size();
  double overlap = 0.0;
  double slope = 1.0;  // minus the derivative of the residual
  const auto residual = [&](double centre) {
    const LogisticSums a = logistic_sums(before.data(), n, 1.0, centre);
    const LogisticSums b = logistic_sums(after.data(), m, -1.0, centre);
    overlap = a.total;
    slope = std::max(a.slope / a.total + b.slope / b.total, smallest_slope);
    return std::make_tuple(portable_math::log(a.total / b.total), -slope);
  };
  const double log_size_ratio = portable_math::log(static_cast<double>(m) / static_cast<double>(n));
  const double lowest = least_centre(before, after) - 1.0;
  const double highest = std::max(-log_size_ratio, 0.0) + 1.0;
  const double log_mean_weight = portable_math::log(
      portable_math::sum_of(n, [&](std::size_t i) { return portable_math::exp(before[i]); }) /
      static_cast<double>(n));
  std::uintmax_t iterations = 100;
  const double centre = boost::math::tools::newton_raphson_iterate(
      residual, std::clamp(log_mean_weight - log_size_ratio, lowest, highest), lowest, highest, 40,
      iterations);
  residual(centre);
  return {centre, log_size_ratio, overlap, slope};
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
                     : detail::infinity;
}

void BridgeEvidence::add(ConstDoubles before, ConstDoubles after, Index chains, double step) {
  const double largest = std::max(*std::max_element(before.begin(), before.end()),
                                  *std::max_element(after.begin(), after.end()));
  log_weigh(before, step, largest, log_weights_before_);
  log_weigh(after, step, largest, log_weights_after_);
  const Bridge bridge = solve_bridge(log_weights_before_, log_weights_after_);
  sums_.log_evidence += step * largest + (bridge.centre + bridge.log_size_ratio);
  const double n = static_cast<double>(before.size());
  const double m = static_cast<double>(after.size());
  sums_.least_variance += std::max(1.0 / bridge.overlap - 1.0 / n - 1.0 / m, 0.0);

  if (sums_.influence.empty()) {  // each draw from the prior is a chain
    sums_.influence.emplace_back(before.size(), 0.0);
  }
  sums_.influence.emplace_back(static_cast<std::size_t>(chains), 0.0);
  const auto add_influence = [&](const std::vector<double>& log_weights, double sign,
                                 std::vector<double>& influence) {
    const double mean = 1.0 / static_cast<double>(log_weights.size());
    for (std::size_t i = 0; i < log_weights.size(); ++i) {
      const double part = logistic(sign * (log_weights[i] - bridge.centre)) / bridge.overlap;
      influence[i % influence.size()] += sign * (part - mean) / bridge.slope;
    }
  };
  add_influence(log_weights_before_, 1.0, sums_.influence[sums_.influence.size() - 2]);
  add_influence(log_weights_after_, -1.0, sums_.influence.back());
}

double BridgeEvidence::variance_up_to(std::size_t last, const Genealogy& genealogy) const {
  std::vector<Index> group(sums_.influence[last].size());  // of each chain: its ancestor in stage `first`
  std::iota(group.begin(), group.end(), Index{0});
  std::size_t first = last;
  for (std::vector<Index> earlier = group; first > 0; --first) {
    for (Index& chain : earlier) {
      chain = genealogy.parents[first - 1][static_cast<std::size_t>(chain)];
    }
    const double groups = effective_groups(earlier);
    if (groups <= 1.0 || (groups < fewest_groups && first < last)) {
      break;
    }
    group = earlier;
  }
  double variance = grouped_variance(sums_.influence[last], group);
  if (first < last) {
    std::vector<double> earlier_sums =
        sums_.influence[first];  // of the descendants of each chain of stage `first`
    std::vector<Index> group_before(earlier_sums.size());
    std::iota(group_before.begin(), group_before.end(), Index{0});
    for (std::size_t stage = first + 1; stage < last; ++stage) {
      std::vector<Index> of_stage;
      for (std::size_t c = 0; c < sums_.influence[stage].size(); ++c) {
        of_stage.push_back(group_before[static_cast<std::size_t>(genealogy.parents[stage - 1][c])]);
        earlier_sums[static_cast<std::size_t>(of_stage.back())] += sums_.influence[stage][c];
      }
      group_before = std::move(of_stage);
    }
    for (std::size_t c = 0; c < group.size(); ++c) {
      variance += 2.0 * sums_.influence[last][c] * earlier_sums[static_cast<std::size_t>(group[c])];
    }
  }
  return variance;
}

double BridgeEvidence::standard_error(const Genealogy& genealogy) const {
  double variance = 0.0;
  for (std::size_t stage = 0; stage < sums_.influence.size(); ++stage) {
    variance += variance_up_to(stage, genealogy);
  }
  return std::sqrt(std::max(variance, sums_.least_variance));
}

}  // namespace tmcmc
