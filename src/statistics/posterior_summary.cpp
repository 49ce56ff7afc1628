#include "statistics/posterior_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "statistics/summary.hpp"

namespace statistics {

using tmcmc::Index;

namespace {

/// Values of a parameter with their weights, in ascending order.
std::vector<std::pair<double, double>> weighted_values(const std::vector<tmcmc::Result>& runs, Index j) {
  std::vector<std::pair<double, double>> values;
  for (const auto& run : runs) {
    const double total = run.weights.sum() * static_cast<double>(runs.size());
    for (Index i = 0; i < run.final.points.rows(); ++i) {
      values.emplace_back(run.final.points(i, j), run.weights[i] / total);
    }
  }
  std::stable_sort(values.begin(), values.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return values;
}

/// Quantile, linearly interpolated between the middles of the steps of the weighted distribution
/// function.
double quantile(const std::vector<std::pair<double, double>>& values, double p) {
  double below = 0.0, last_level = 0.0, last = values.front().first;
  for (const auto& [x, weight] : values) {
    const double level = below + 0.5 * weight;
    if (level >= p) {
      return level > last_level && below > 0.0 ? last + (x - last) * (p - last_level) / (level - last_level)
                                               : x;
    }
    below += weight;
    last_level = level;
    last = x;
  }
  return last;
}

double r_hat(const std::vector<tmcmc::Result>& runs, Index j) {
  std::vector<double> means, variances, sizes;
  for (const auto& run : runs) {
    const auto x = run.final.points.col(j).array();
    means.push_back((run.weights.array() * x).sum() / run.weights.sum());
    variances.push_back((run.weights.array() * (x - means.back()).square()).sum() / run.weights.sum());
    sizes.push_back(run.diagnostics.effective_sample_size[j]);
  }
  const double n = statistics::moments(sizes).mean, within = statistics::moments(variances).mean;
  const double between = std::pow(statistics::moments(means).standard_deviation, 2);
  return runs.size() > 1 && within > 0.0 ? std::sqrt((n - 1.0) / n + between / within)
                                         : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::vector<ParameterSummary> summarise(const std::vector<tmcmc::Result>& runs, const tmcmc::Prior& prior) {
  std::vector<ParameterSummary> rows;
  for (Index j = 0; j < prior.dimension(); ++j) {
    const auto at = static_cast<std::size_t>(j);
    ParameterSummary row{.name = prior.names()[at], .unit = prior.units()[at]};
    const auto values = weighted_values(runs, j);
    for (const auto& [x, weight] : values) {
      row.mean += weight * x;
    }
    for (const auto& [x, weight] : values) {
      row.sd += weight * (x - row.mean) * (x - row.mean);
    }
    row.sd = std::sqrt(row.sd);
    row.quantile_5 = quantile(values, 0.05);
    row.median = quantile(values, 0.5);
    row.quantile_95 = quantile(values, 0.95);
    for (const auto& run : runs) {
      row.effective_sample_size += run.diagnostics.effective_sample_size[j];
    }
    row.r_hat = r_hat(runs, j);
    rows.push_back(std::move(row));
  }
  return rows;
}

tmcmc::Evidence mean_evidence(const std::vector<tmcmc::Result>& runs) {
  std::vector<double> values;
  double squares = 0.0;
  for (const auto& run : runs) {
    values.push_back(run.evidence.log_evidence);
    squares += run.evidence.standard_error * run.evidence.standard_error;
  }
  const auto n = static_cast<double>(runs.size());
  const auto moments = statistics::moments(values);
  const double within = std::sqrt(squares) / n;
  return {moments.mean,
          runs.size() > 1 ? std::max(within, moments.standard_deviation / std::sqrt(n)) : within};
}

std::vector<Index> equal_rows(const tmcmc::Result& run, Index draws) {
  std::vector<Index> rows;
  const double share = run.weights.sum() / static_cast<double>(draws);
  Index row = 0;
  double sum = run.weights[0];
  for (Index i = 0; i < draws; ++i) {
    while (sum <= (static_cast<double>(i) + 0.5) * share && row + 1 < run.weights.size()) {
      sum += run.weights[++row];
    }
    rows.push_back(row);
  }
  return rows;
}

Index equal_draws(const tmcmc::Result& run) {
  return run.measurement ? std::max<Index>(1, std::lround(run.measurement->effective_sample_size))
                         : run.final.points.rows();
}

}  // namespace statistics
