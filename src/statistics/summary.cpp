#include "statistics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "errors/invalid_value.hpp"
#include "portable_math/sums.hpp"

namespace statistics {

Moments moments(std::span<const double> values) {
  if (values.empty()) {
    throw errors::InvalidValue("values", "", "at least one");
  }
  const std::size_t n = values.size();
  const double count = static_cast<double>(n);
  const double mean = portable_math::sum_of(n, [&](std::size_t i) { return values[i]; }) / count;
  if (n == 1) {
    return {mean, std::numeric_limits<double>::quiet_NaN()};
  }
  const double squares =
      portable_math::sum_of(n, [&](std::size_t i) { return (values[i] - mean) * (values[i] - mean); });
  return {mean, std::sqrt(squares / (count - 1.0))};
}

Moments moments(std::span<const double> values, std::span<const double> weights) {
  if (weights.size() != values.size()) {
    throw errors::InvalidValue("weights", weights.size(), "one for each value");
  }
  if (std::all_of(weights.begin(), weights.end(), [&](double w) { return w > 0.0 && w == weights[0]; })) {
    return moments(values);
  }
  const auto sum = [&](auto term) {
    return portable_math::sum_of(values.size(), [&](std::size_t i) { return term(values[i], weights[i]); });
  };
  const double total = sum([](double, double w) { return w; });
  if (!(total > 0.0)) {
    throw errors::InvalidValue("weights", total, "a positive one among them");
  }
  const double mean = sum([](double x, double w) { return w * x; }) / total;
  const double squares = sum([mean](double x, double w) { return w * (x - mean) * (x - mean); });
  const double of_weights = sum([](double, double w) { return w * w; });
  return {mean, std::sqrt(squares / (total - of_weights / total))};
}

double root_mean_square(std::span<const double> values) {
  double squares = 0.0;
  for (const double value : values) {
    squares += value * value / static_cast<double>(values.size());
  }
  return std::sqrt(squares);
}

double sample_quantile(std::span<const double> sorted, double p) {
  const double position = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

Interval95 central_95(std::vector<double> null) {
  std::sort(null.begin(), null.end());
  return {sample_quantile(null, 0.025), sample_quantile(null, 0.975)};
}

EstimateError error_of(std::span<const double> estimates, double exact) {
  const Moments m = moments(estimates);
  const auto n = static_cast<double>(estimates.size());
  double squares = 0.0;
  for (const double x : estimates) {
    squares += (x - exact) * (x - exact);
  }
  return {m.mean, m.mean - exact, m.standard_deviation / std::sqrt(n), m.standard_deviation,
          std::sqrt(squares / n)};
}

std::vector<double> evenly_spaced(double low, double high, long points) {
  if (points < 2) {
    throw errors::InvalidValue("points", points, "at least 2");
  }
  std::vector<double> values;
  for (long i = 0; i < points; ++i) {
    values.push_back(low + (high - low) * static_cast<double>(i) / static_cast<double>(points - 1));
  }
  values.back() = high;
  return values;
}

std::vector<long> histogram(std::span<const double> values, double low, double high, long bins) {
  const std::vector<double> ones(values.size(), 1.0);
  const auto sums = histogram(values, ones, low, high, bins);
  return {sums.begin(), sums.end()};
}

std::vector<double> histogram(std::span<const double> values, std::span<const double> weights, double low,
                              double high, long bins) {
  if (weights.size() != values.size()) {
    throw errors::InvalidValue("weights", weights.size(), "one for each value");
  }
  if (bins < 1) {
    throw errors::InvalidValue("bins", bins, "at least 1");
  }
  if (!(low < high)) {
    throw errors::InvalidValue("high", high, "more than the lower end");
  }
  const double width = (high - low) / static_cast<double>(bins);
  std::vector<double> sums(static_cast<std::size_t>(bins));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double bin = std::floor((values[i] - low) / width);
    if (bin >= 0.0 && bin < static_cast<double>(bins)) {
      sums[static_cast<std::size_t>(bin)] += weights[i];
    }
  }
  return sums;
}

}  // namespace statistics
