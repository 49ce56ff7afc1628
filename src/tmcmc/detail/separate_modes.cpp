#include "tmcmc/detail/separate_modes.hpp"

#include <algorithm>
#include <vector>

namespace tmcmc::detail {

namespace {

constexpr Index line_steps = 10;  // of a line between two means

/// Whether the density falls nowhere far below the density at the ends, which are the first and the
/// last of these rows.
bool is_joined(const Eigen::VectorXd& log_densities, Index first) {
  const double log_twentieth = portable_math::log(0.05);
  const double lower_end = std::min(log_densities[first], log_densities[first + line_steps]);
  for (Index i = first + 1; i < first + line_steps; ++i) {
    if (log_densities[i] < lower_end + log_twentieth) {
      return false;
    }
  }
  return true;
}

}  // namespace

Index separate_modes(const StudentMixture& mixture) {
  constexpr double least_weight = 0.01;
  std::vector<Index> kept;
  for (Index k = 0; k < mixture.size(); ++k) {
    if (mixture.weights[k] >= least_weight) {
      kept.push_back(k);
    }
  }
  const std::size_t count = kept.size();
  if (count < 2) {
    return 1;
  }
  Population lines(static_cast<Index>(count * (count - 1) / 2) * (line_steps + 1), mixture.dimension());
  Index row = 0;
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      for (Index i = 0; i <= line_steps; ++i, ++row) {
        const double part = static_cast<double>(i) / static_cast<double>(line_steps);
        for (Index j = 0; j < mixture.dimension(); ++j) {
          lines(row, j) = (1.0 - part) * mixture.means(j, kept[a]) + part * mixture.means(j, kept[b]);
        }
      }
    }
  }
  const Eigen::VectorXd log_densities = log_density(mixture, lines);
  std::vector<std::size_t> group(count);
  for (std::size_t a = 0; a < count; ++a) {
    group[a] = a;
  }
  row = 0;
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = 0; b < a; ++b, row += line_steps + 1) {
      if (group[a] != group[b] && is_joined(log_densities, row)) {
        std::replace(group.begin(), group.end(), std::size_t{group[a]}, std::size_t{group[b]});
      }
    }
  }
  std::sort(group.begin(), group.end());
  return std::unique(group.begin(), group.end()) - group.begin();
}

}  // namespace tmcmc::detail
