#include "tmcmc/log_weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "portable_math/multiversion.hpp"
#include "portable_math/sums.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

/// Weights of one block, which never leave the cache.
using BlockWeights = std::array<double, reduction_rows>;

double larger(double a, double b) {
  return b > a ? b : a;
}

ConstDoubles part(ConstDoubles x, Index begin, Index end) {
  return x.subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
}

/// Sum of eight interleaved parts, so that compilers vectorise it.
PORTABLE_MATH_MULTIVERSION
double largest_of(const double* x, std::size_t n) {
  constexpr std::size_t lanes = portable_math::sum_lanes;
  double result[lanes];
  std::fill_n(result, lanes, minus_infinity);
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      result[lane] = x[i + lane] > result[lane] ? x[i + lane] : result[lane];
    }
  }
  for (; i < n; ++i) {
    result[0] = x[i] > result[0] ? x[i] : result[0];
  }
  for (std::size_t lane = 1; lane < lanes; ++lane) {
    result[0] = result[lane] > result[0] ? result[lane] : result[0];
  }
  return result[0];
}

double largest(ConstDoubles x, int threads) {
  return reduce_blocks(
      static_cast<Index>(x.size()), threads,
      [x](Index begin, Index end) {
        return largest_of(x.data() + begin, static_cast<std::size_t>(end - begin));
      },
      larger);
}

/// Fills in the weights and returns their sum.
PORTABLE_MATH_MULTIVERSION
double weigh(const double* log_likelihood, std::size_t n, double shift, double step, double* weights) {
  for (std::size_t i = 0; i < n; ++i) {
    weights[i] = portable_math::exp(step * (log_likelihood[i] - shift));
  }
  return portable_math::sum_of(n, [=](std::size_t i) { return weights[i]; });
}

PORTABLE_MATH_MULTIVERSION
double sum_of_squares(const double* weights, std::size_t n) {
  return portable_math::sum_of(n, [=](std::size_t i) { return weights[i] * weights[i]; });
}

PORTABLE_MATH_MULTIVERSION
double squared_deviations(const double* weights, std::size_t n, double mean) {
  return portable_math::sum_of(n, [=](std::size_t i) { return (weights[i] - mean) * (weights[i] - mean); });
}

PORTABLE_MATH_MULTIVERSION
double feasible_squared_deviations(const double* weights, const double* log_likelihood, std::size_t n,
                                   double mean) {
  return portable_math::sum_of(n, [=](std::size_t i) {
    const double deviation = weights[i] - mean;
    return log_likelihood[i] == minus_infinity ? 0.0 : deviation * deviation;
  });
}

struct PowerSums {
  double first;
  double second;
};

PowerSums add(const PowerSums& a, const PowerSums& b) {
  return {a.first + b.first, a.second + b.second};
}

struct Spread {
  double count;
  double sum;
  double squared_deviations;  // from the mean of these
};

/// Method of Chan, Golub and LeVeque 1983: there is no cancellation, however small the spread.
Spread merge(const Spread& a, const Spread& b) {
  if (a.count == 0.0 || b.count == 0.0) {
    return a.count == 0.0 ? b : a;
  }
  const double count = a.count + b.count;
  const double distance = b.sum / b.count - a.sum / a.count;
  return {count, a.sum + b.sum,
          a.squared_deviations + b.squared_deviations + distance * distance * (a.count * b.count / count)};
}

}  // namespace

Index count_feasible(ConstDoubles log_likelihood) {
  return static_cast<Index>(log_likelihood.size()) -
         static_cast<Index>(std::count(log_likelihood.begin(), log_likelihood.end(), minus_infinity));
}

template <class Body, class Combine>
auto WeightStatistics::reduce(Body body, Combine combine) const {
  return reduce_blocks(
      static_cast<Index>(log_likelihood_.size()), threads_,
      [&](Index begin, Index end) { return body(part(log_likelihood_, begin, end)); }, combine);
}

WeightStatistics::WeightStatistics(ConstDoubles log_likelihood, int threads)
    : log_likelihood_(log_likelihood),
      threads_(threads),
      feasible_(reduce(count_feasible, std::plus<>())),
      largest_(largest(log_likelihood, threads)) {}

double WeightStatistics::effective_sample_size(double step) const {
  if (feasible_ == 0) {
    return 0.0;
  }
  const PowerSums sums = reduce(
      [&](ConstDoubles block) -> PowerSums {
        BlockWeights weights;
        const double sum = weigh(block.data(), block.size(), largest_, step, weights.data());
        return {sum, sum_of_squares(weights.data(), block.size())};
      },
      add);
  return sums.first * sums.first / sums.second;
}

double WeightStatistics::coefficient_of_variation(double step, Deviation deviation, Counted counted) const {
  if (feasible_ == 0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const bool exclude = counted == Counted::feasible && feasible_ < static_cast<Index>(log_likelihood_.size());
  const Spread total = reduce(
      [&](ConstDoubles block) -> Spread {
        BlockWeights weights;
        const double* w = weights.data();
        const double count =
            static_cast<double>(exclude ? count_feasible(block) : static_cast<Index>(block.size()));
        const double sum = weigh(block.data(), block.size(), largest_, step, weights.data());
        return {count, sum,
                exclude ? feasible_squared_deviations(w, block.data(), block.size(), sum / count)
                        : squared_deviations(w, block.size(), sum / count)};
      },
      merge);
  const double n = total.count;
  return std::sqrt(total.squared_deviations / (deviation == Deviation::sample ? n - 1.0 : n)) /
         (total.sum / n);
}

double WeightStatistics::log_likelihood_spread() const {
  const double n = static_cast<double>(feasible_);
  const auto feasible_mean = [&](auto term) {
    return reduce(
        [&](ConstDoubles block) {
          return portable_math::sum_of(block.size(), [&](std::size_t i) {
            return block[i] == minus_infinity ? 0.0 : term(block[i] - largest_) / n;
          });
        },
        std::plus<>());
  };
  const double mean = feasible_mean([](double value) { return value; });
  const double scale = reduce(
      [&](ConstDoubles block) {
        double result = 0.0;
        for (const double value : block) {
          result = value == minus_infinity ? result : larger(result, std::fabs(value - largest_ - mean));
        }
        return result;
      },
      larger);
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    return 0.0;
  }
  return scale * std::sqrt(feasible_mean(
                     [&](double value) { return (value - mean) / scale * ((value - mean) / scale); }));
}

double effective_sample_size(ConstDoubles log_likelihood, double step) {
  return WeightStatistics(log_likelihood).effective_sample_size(step);
}

double coefficient_of_variation(ConstDoubles log_likelihood, double step, Deviation deviation,
                                Counted counted) {
  return WeightStatistics(log_likelihood).coefficient_of_variation(step, deviation, counted);
}

double log_mean_weight(ConstDoubles log_likelihood, double step) {
  std::vector<double> weights(log_likelihood.size());
  return relative_weights(log_likelihood, step, weights).log_mean;
}

WeightSums relative_weights(ConstDoubles log_likelihood, double step, std::span<double> weights,
                            int threads) {
  const double shift = largest(log_likelihood, threads);
  if (shift == minus_infinity) {
    std::fill(weights.begin(), weights.end(), 0.0);
    return {0.0, minus_infinity};
  }
  const double sum = reduce_blocks(
      static_cast<Index>(weights.size()), threads,
      [&](Index begin, Index end) {
        const ConstDoubles block = part(log_likelihood, begin, end);
        return weigh(block.data(), block.size(), shift, step, weights.data() + begin);
      },
      std::plus<>());
  return {sum, step * shift + portable_math::log(sum / static_cast<double>(weights.size()))};
}

}  // namespace tmcmc
