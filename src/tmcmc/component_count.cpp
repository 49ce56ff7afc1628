// The number of components of a mixture, chosen by the log-density of held-out points.

#include <algorithm>
#include <limits>

#include "tmcmc/detail/vector_sums.hpp"
#include "tmcmc/mixture_fit.hpp"

namespace tmcmc {

namespace {

/// The points of even or odd groups.
WeightedPoints half(const WeightedPoints& data, Index parity) {
  std::vector<Index> rows;
  for (Index i = 0; i < data.points.rows(); ++i) {
    if (data.groups[static_cast<std::size_t>(i)] % 2 == parity) {
      rows.push_back(i);
    }
  }
  const auto n = static_cast<Index>(rows.size());
  WeightedPoints part{Population(n, data.points.cols()), Eigen::VectorXd(n), {}};
  for (Index i = 0; i < n; ++i) {
    part.points.row(i) = data.points.row(rows[static_cast<std::size_t>(i)]);
    part.weights[i] = data.weights[rows[static_cast<std::size_t>(i)]];
  }
  return part;
}

double total_log_density(const StudentMixture& mixture, const WeightedPoints& data) {
  const Eigen::VectorXd densities = log_density(mixture, data.points);
  return detail::sum_of_products(densities.data(), data.weights.data(), data.weights.size());
}

Index best_count(const WeightedPoints& data, const MixtureFitOptions& options, const StreamKey& key,
                 std::uint32_t stage, const std::function<void()>& look) {
  constexpr double clear_loss = 0.02;
  const WeightedPoints even = half(data, 0);
  const WeightedPoints odd = half(data, 1);
  const double weight_even = detail::sum(even.weights.data(), even.weights.size());
  const double weight_odd = detail::sum(odd.weights.data(), odd.weights.size());
  if (!(weight_even > 0.0) || !(weight_odd > 0.0)) {
    return 1;
  }
  const auto d = static_cast<double>(data.points.cols());
  // The score of few points is noisy, and in many coordinates there are chance gains.
  const double least_gain = std::max(options.gain_of_component, d / (weight_even + weight_odd));
  MixtureFitOptions few = options;
  few.most_iterations = (options.most_iterations + 1) / 2;  // are enough to compare
  double best_score = -std::numeric_limits<double>::infinity();
  Index best = 1;
  for (Index k = 1; k <= options.most_components; k *= 2) {
    if (k > 1 && std::min(weight_even, weight_odd) < static_cast<double>(k) * (2.0 + 0.5 * d)) {
      break;
    }
    const double score = (total_log_density(fit_mixture(even, k, few, key, stage, look), odd) +
                          total_log_density(fit_mixture(odd, k, few, key, stage, look), even)) /
                         (weight_even + weight_odd);
    if (score > best_score + least_gain) {
      best_score = score;
      best = k;
    } else if (score < best_score - clear_loss) {
      break;
    }
  }
  return best;
}

}  // namespace

StudentMixture fit_mixture(const WeightedPoints& data, const MixtureFitOptions& options, const StreamKey& key,
                           std::uint32_t stage, const std::function<void()>& look) {
  return fit_mixture(data, best_count(data, options, key, stage, look), options, key, stage, look);
}

}  // namespace tmcmc
