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

std::vector<long> histogram(std::span<const double> values, double low, double high, long bins) {
  if (bins < 1) {
    throw errors::InvalidValue("bins", bins, "at least 1");
  }
  if (!(low < high)) {
    throw errors::InvalidValue("high", high, "more than the lower end");
  }
  const double width = (high - low) / static_cast<double>(bins);
  std::vector<long> counts(static_cast<std::size_t>(bins));
  for (const double x : values) {
    const double bin = std::floor((x - low) / width);
    if (bin >= 0.0 && bin < static_cast<double>(bins)) {
      ++counts[static_cast<std::size_t>(bin)];
    }
  }
  return counts;
}

}  // namespace statistics
