#include "tmcmc/result.hpp"

#include "tmcmc/parallel.hpp"

namespace tmcmc {

void Walkers::gather(const Population& from_points, const Eigen::VectorXd& from_log_likelihood,
                     std::span<const Index> rows, int threads) {
  const auto n = static_cast<Index>(rows.size());
  points.resize(n, from_points.cols());
  log_likelihood.resize(n);
  for_each_block(n, reduction_rows, threads, [&](Index, Index begin, Index end) {
    for (Index j = 0; j < from_points.cols(); ++j) {
      for (Index i = begin; i < end; ++i) {
        points(i, j) = from_points(rows[static_cast<std::size_t>(i)], j);
      }
    }
    for (Index i = begin; i < end; ++i) {
      log_likelihood[i] = from_log_likelihood[rows[static_cast<std::size_t>(i)]];
    }
  });
}

}  // namespace tmcmc
