#include "tmcmc/log_weights.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "portable_math/multiversion.hpp"
#include "portable_math/sums.hpp"

namespace tmcmc {

namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

double largest(ConstDoubles x) {
  double result = minus_infinity;
  for (const double value : x) {
    result = value > result ? value : result;
  }
  return result;
}

/// Fills the weights and returns their sum.
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

}  // namespace

Index count_feasible(ConstDoubles log_likelihood) {
  return static_cast<Index>(log_likelihood.size()) -
         static_cast<Index>(std::count(log_likelihood.begin(), log_likelihood.end(), minus_infinity));
}

WeightStatistics::WeightStatistics(ConstDoubles log_likelihood, std::vector<double>& weights)
    : log_likelihood_(log_likelihood),
      feasible_(count_feasible(log_likelihood)),
      largest_(largest(log_likelihood)),
      weights_(weights) {
  weights_.resize(log_likelihood.size());
}

double WeightStatistics::evaluate(double step) {
  return weigh(log_likelihood_.data(), weights_.size(), largest_, step, weights_.data());
}

double WeightStatistics::effective_sample_size(double step) {
  if (feasible_ == 0) {
    return 0.0;
  }
  const double sum = evaluate(step);
  return sum * sum / sum_of_squares(weights_.data(), weights_.size());
}

double WeightStatistics::coefficient_of_variation(double step, Deviation deviation, Counted counted) {
  if (feasible_ == 0) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const double n =
      static_cast<double>(counted == Counted::feasible ? feasible_ : static_cast<Index>(weights_.size()));
  const double mean = evaluate(step) / n;
  const double squares =
      counted == Counted::feasible && feasible_ < static_cast<Index>(weights_.size())
          ? feasible_squared_deviations(weights_.data(), log_likelihood_.data(), weights_.size(), mean)
          : squared_deviations(weights_.data(), weights_.size(), mean);
  return std::sqrt(squares / (deviation == Deviation::sample ? n - 1.0 : n)) / mean;
}

double effective_sample_size(ConstDoubles log_likelihood, double step) {
  std::vector<double> weights;
  return WeightStatistics(log_likelihood, weights).effective_sample_size(step);
}

double coefficient_of_variation(ConstDoubles log_likelihood, double step, Deviation deviation,
                                Counted counted) {
  std::vector<double> weights;
  return WeightStatistics(log_likelihood, weights).coefficient_of_variation(step, deviation, counted);
}

double log_mean_weight(ConstDoubles log_likelihood, double step) {
  std::vector<double> weights(log_likelihood.size());
  return relative_weights(log_likelihood, step, weights).log_mean;
}

WeightSums relative_weights(ConstDoubles log_likelihood, double step, std::span<double> weights) {
  const double shift = largest(log_likelihood);
  if (shift == minus_infinity) {
    std::fill(weights.begin(), weights.end(), 0.0);
    return {0.0, minus_infinity};
  }
  const double sum = weigh(log_likelihood.data(), weights.size(), shift, step, weights.data());
  return {sum, step * shift + portable_math::log(sum / static_cast<double>(weights.size()))};
}

}  // namespace tmcmc
