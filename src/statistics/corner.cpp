#include "statistics/corner.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "errors/invalid_value.hpp"

namespace statistics {

namespace {

void require(bool condition, const char* field, double value, const char* expected) {
  if (!condition) {
    throw errors::InvalidValue(field, value, expected);
  }
}

double weight_of(std::span<const double> weights, std::size_t i) {
  return weights.empty() ? 1.0 : weights[i];
}

/// Sum of the weights, after checking them.
double total_weight(std::span<const double> values, std::span<const double> weights) {
  require(!values.empty(), "values", 0.0, "at least one value");
  require(weights.empty() || weights.size() == values.size(), "weights", static_cast<double>(weights.size()),
          "one weight for each value");
  double total = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double weight = weight_of(weights, i);
    require(weight >= 0.0 && std::isfinite(weight), "weights", weight, "finite numbers of at least 0");
    total += weight;
  }
  require(total > 0.0, "weights", total, "a positive sum");
  return total;
}

void require_width(const Range& range) {
  require(std::isfinite(range.low) && std::isfinite(range.high) && range.low < range.high, "range", range.low,
          "a finite range with low < high");
}

void require_grid(const Range& range, long bins) {
  require_width(range);
  require(bins >= 1, "bins", static_cast<double>(bins), "at least one");
}

/// Index of the bin of a value, or -1; the upper end belongs to the last bin.
long bin_of(double value, const Range& range, long bins) {
  if (!(value >= range.low && value <= range.high)) {
    return -1;
  }
  const double place = (value - range.low) / (range.high - range.low) * static_cast<double>(bins);
  return std::min(static_cast<long>(place), bins - 1);
}

std::vector<std::size_t> order_of(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

}  // namespace

double weighted_quantile(std::span<const double> values, std::span<const double> weights, double p) {
  const double wanted = p * total_weight(values, weights);
  double below = 0.0;
  double last = values[0];
  for (const std::size_t i : order_of(values)) {
    const double weight = weight_of(weights, i);
    if (weight > 0.0) {
      below += weight;
      last = values[i];
      if (below >= wanted) {
        break;
      }
    }
  }
  return last;
}

Range panel_range(std::span<const double> values, std::span<const double> weights) {
  const double low = weighted_quantile(values, weights, 0.0005);
  const double high = weighted_quantile(values, weights, 0.9995);
  if (!(low < high)) {
    const double half = low == 0.0 ? 0.5 : 0.005 * std::fabs(low);
    return {low - half, low + half};
  }
  const double margin = 0.05 * (high - low);
  return {std::max(low - margin, *std::min_element(values.begin(), values.end())),
          std::min(high + margin, *std::max_element(values.begin(), values.end()))};
}

double tick_spacing(const Range& range) {
  require_width(range);
  const double third = range.high / 3.0 - range.low / 3.0;
  const double exponent = std::floor(std::log10(third));
  const double leading = third / std::pow(10.0, exponent);
  const double rounded = leading < 1.5 ? 1.0 : leading < 3.5 ? 2.0 : leading < 7.5 ? 5.0 : 10.0;
  return exponent < 0.0 ? rounded / std::pow(10.0, -exponent) : rounded * std::pow(10.0, exponent);
}

std::vector<double> marginal_density(std::span<const double> values, std::span<const double> weights,
                                     const Range& range, long bins) {
  require_grid(range, bins);
  const double mass = total_weight(values, weights) * (range.high - range.low) / static_cast<double>(bins);
  std::vector<double> density(static_cast<std::size_t>(bins), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const long bin = bin_of(values[i], range, bins);
    if (bin >= 0) {
      density[static_cast<std::size_t>(bin)] += weight_of(weights, i) / mass;
    }
  }
  return density;
}

PairDensity pair_density(std::span<const double> x, std::span<const double> y,
                         std::span<const double> weights, const Range& x_range, const Range& y_range,
                         long bins) {
  require_grid(x_range, bins);
  require_grid(y_range, bins);
  require(x.size() == y.size(), "y", static_cast<double>(y.size()), "as many values as x has");
  const double total = total_weight(x, weights);
  std::vector<double> mass(static_cast<std::size_t>(bins * bins), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const long column = bin_of(x[i], x_range, bins);
    const long row = bin_of(y[i], y_range, bins);
    if (column >= 0 && row >= 0) {
      mass[static_cast<std::size_t>(row * bins + column)] += weight_of(weights, i) / total;
    }
  }
  PairDensity result{std::vector<double>(mass.size()), std::vector<double>(mass.size(), 1.0)};
  const double cell =
      (x_range.high - x_range.low) * (y_range.high - y_range.low) / static_cast<double>(bins * bins);
  const auto order = order_of(mass);
  double above = 0.0;
  for (std::size_t first = order.size(); first > 0;) {
    std::size_t end = first;  // cells of one density share their level
    while (first > 0 && mass[order[first - 1]] == mass[order[end - 1]]) {
      above += mass[order[--first]];
    }
    for (std::size_t i = first; i < end; ++i) {
      result.density[order[i]] = mass[order[i]] / cell;
      result.level[order[i]] = mass[order[i]] > 0.0 ? std::min(above, 1.0) : 1.0;
    }
  }
  return result;
}

}  // namespace statistics
