#include "tmcmc/importance.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "portable_math/sums.hpp"
#include "tmcmc/detail/infinity.hpp"
#include "tmcmc/log_weights.hpp"

namespace tmcmc {

namespace {

/// Mean of log(1 - theta x): the shape of a generalised Pareto distribution given theta = -shape /
/// scale.
double mean_log_term(const std::vector<double>& x, double theta) {
  return portable_math::sum_of(x.size(),
                               [&](std::size_t i) { return portable_math::log(1.0 - theta * x[i]); }) /
         static_cast<double>(x.size());
}

/// Zhang and Stephens 2009: posterior mean of theta over a grid of quantiles of its prior.
/// \param x  exceedances, ascending, the last one positive
double fitted_shape(const std::vector<double>& x) {
  constexpr double prior_factor = 3.0;
  const double n = static_cast<double>(x.size());
  const double quartile = x[static_cast<std::size_t>(std::floor(n / 4.0 + 0.5)) - 1];
  const double scale = quartile > 0.0 ? quartile : 1e-3 * x.back();
  const int grid = 30 + static_cast<int>(std::floor(std::sqrt(n)));
  std::vector<double> thetas;
  std::vector<double> log_likelihoods;
  for (int j = 1; j <= grid; ++j) {
    const double theta = 1.0 / x.back() + (1.0 - std::sqrt(grid / (j - 0.5))) / (prior_factor * scale);
    const double shape = mean_log_term(x, theta);
    thetas.push_back(theta);
    log_likelihoods.push_back(n * (portable_math::log(-theta / shape) - shape - 1.0));
  }
  double largest = -detail::infinity;
  for (const double value : log_likelihoods) {
    largest = value > largest ? value : largest;
  }
  double sum = 0.0;
  double weighted = 0.0;
  for (std::size_t j = 0; j < thetas.size(); ++j) {
    const double weight = log_likelihoods[j] == log_likelihoods[j]  // 0/0 where theta is 0
                              ? portable_math::exp(log_likelihoods[j] - largest)
                              : 0.0;
    sum += weight;
    weighted += weight * thetas[j];
  }
  const double shape = mean_log_term(x, weighted / sum);
  return (n * shape + 10.0 * 0.5) / (n + 10.0);
}

/// Variance of the weights about the means of runs of consecutive draws.
double variance_within_runs(const std::vector<double>& weights) {
  constexpr std::size_t most_rows = 64;
  const std::size_t runs = (weights.size() + most_rows - 1) / most_rows;
  double squares = 0.0;
  for (std::size_t run = 0; run < runs; ++run) {
    const std::size_t begin = run * weights.size() / runs;
    const std::size_t rows = (run + 1) * weights.size() / runs - begin;
    const double* w = &weights[begin];
    const double mean =
        portable_math::sum_of(rows, [=](std::size_t i) { return w[i]; }) / static_cast<double>(rows);
    squares += portable_math::sum_of(rows, [=](std::size_t i) { return (w[i] - mean) * (w[i] - mean); });
  }
  return squares / static_cast<double>(weights.size() - runs);
}

}  // namespace

ImportanceEstimate importance_estimate(ConstDoubles log_weights) {
  const auto n = static_cast<double>(log_weights.size());
  std::vector<double> weights(log_weights.size());
  const WeightSums sums = relative_weights(log_weights, 1.0, weights);
  ImportanceEstimate estimate;
  estimate.log_mean = sums.log_mean;
  if (!(sums.sum > 0.0)) {
    estimate.standard_error = detail::infinity;
    estimate.pareto_shape = detail::infinity;
    return estimate;
  }
  const double mean = sums.sum / n;
  const double squares =
      portable_math::sum_of(weights.size(), [&](std::size_t i) { return weights[i] * weights[i]; });
  estimate.standard_error = n > 1.0 ? std::sqrt(variance_within_runs(weights) / n) / mean : detail::infinity;
  estimate.effective_sample_size = sums.sum * sums.sum / squares;
  estimate.pareto_shape = pareto_shape(log_weights);
  return estimate;
}

Eigen::VectorXd normalised_weights(ConstDoubles log_weights) {
  Eigen::VectorXd weights(static_cast<Index>(log_weights.size()));
  const WeightSums sums =
      relative_weights(log_weights, 1.0, {weights.data(), static_cast<std::size_t>(weights.size())});
  if (sums.sum > 0.0) {
    const double scale = static_cast<double>(log_weights.size()) / sums.sum;
    for (double& weight : weights) {
      weight *= scale;
    }
  }
  return weights;
}

double pareto_shape(ConstDoubles log_weights) {
  const auto n = static_cast<double>(log_weights.size());
  const auto tail = static_cast<std::size_t>(std::ceil(std::min(0.2 * n, 3.0 * std::sqrt(n))));
  if (tail < 5 || log_weights.size() < 25) {
    return -detail::infinity;
  }
  std::vector<double> largest(log_weights.begin(), log_weights.end());
  const auto cut = largest.end() - static_cast<std::ptrdiff_t>(tail) - 1;
  std::nth_element(largest.begin(), cut, largest.end());
  std::sort(cut, largest.end());
  if (largest.back() == -detail::infinity) {
    return detail::infinity;
  }
  const double threshold = portable_math::exp(*cut - largest.back());
  std::vector<double> exceedances;
  for (auto value = cut + 1; value != largest.end(); ++value) {
    exceedances.push_back(portable_math::exp(*value - largest.back()) - threshold);
  }
  return exceedances.back() > 0.0 ? fitted_shape(exceedances) : -detail::infinity;
}

double tempering_power(ConstDoubles log_weights, double target) {
  const WeightStatistics statistics(log_weights);
  if (static_cast<double>(statistics.feasible()) < target) {
    return 0.0;
  }
  if (statistics.effective_sample_size(1.0) >= target) {
    return 1.0;
  }
  // The effective size falls from n at power 0 to less than the target at power 1.
  const auto excess = [&](double power) { return statistics.effective_sample_size(power) - target; };
  std::uintmax_t iterations = 60;
  return boost::math::tools::toms748_solve(excess, 0.0, 1.0,
                                           static_cast<double>(statistics.feasible()) - target, excess(1.0),
                                           boost::math::tools::eps_tolerance<double>(40), iterations)
      .first;
}

}  // namespace tmcmc
