#include "tmcmc/weighted_samples.hpp"

#include <vector>

#include "errors/invalid_value.hpp"
#include "portable_math/sums.hpp"

namespace tmcmc {

Eigen::VectorXd effective_sample_sizes(const Population& points, const Eigen::VectorXd& weights) {
  const auto n = static_cast<std::size_t>(points.rows());
  const double* const w = weights.data();
  const double total = portable_math::sum_of(n, [=](std::size_t i) { return w[i]; });
  Eigen::VectorXd sizes = Eigen::VectorXd::Zero(points.cols());
  for (Index j = 0; total > 0.0 && j < points.cols(); ++j) {
    const double* const x = points.col(j).data();
    const double mean = portable_math::sum_of(n, [=](std::size_t i) { return w[i] * x[i]; }) / total;
    const double squares =
        portable_math::sum_of(n, [=](std::size_t i) { return w[i] * (x[i] - mean) * (x[i] - mean); });
    const double of_mean =
        portable_math::sum_of(n, [=](std::size_t i) { return w[i] * w[i] * (x[i] - mean) * (x[i] - mean); });
    sizes[j] = of_mean > 0.0 ? squares * total / of_mean : 0.0;
  }
  return sizes;
}

Population equally_weighted(const Result& result, Index n, const StreamKey& key, Resampling scheme) {
  constexpr std::uint32_t stream_of_choice = 1U << 31U;  // no run has so many stages
  const Population& points = result.final.points;
  if (n < 1) {
    throw errors::InvalidValue("equally_weighted.n", n, "at least 1");
  }
  if (result.weights.size() != points.rows() || points.rows() == 0) {
    throw errors::InvalidValue("result.weights", result.weights.size(), "a weight for each sample");
  }
  std::vector<Index> rows(static_cast<std::size_t>(n));
  resample(scheme, as_span(result.weights), key, stream_of_choice, rows);
  Population chosen(n, points.cols());
  for (Index i = 0; i < n; ++i) {
    chosen.row(i) = points.row(rows[static_cast<std::size_t>(i)]);
  }
  return chosen;
}

}  // namespace tmcmc
