#include "tmcmc/resampling.hpp"

#include "tmcmc/parallel.hpp"

namespace tmcmc {

void multinomial_ancestors(ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
                           std::span<Index> ancestors) {
  std::vector<double> partial_sums;
  multinomial_ancestors(weights, key, stage, ancestors, partial_sums);
}

void multinomial_ancestors(ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
                           std::span<Index> ancestors, std::vector<double>& partial_sums, int threads) {
  const std::size_t n = ancestors.size();
  partial_sums.resize(n + 1);
  static_assert(reduction_rows % 4 == 0, "a block starts with new words");
  for_each_block(static_cast<Index>(n + 1), reduction_rows, threads, [&](Index, Index begin, Index end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); i += 4) {
      const Words words = random_words(key, {.purpose = Purpose::resampling, .stage = stage, .row = i / 4});
      for (std::size_t k = 0; k < 4 && i + k <= n; ++k) {
        partial_sums[i + k] = -portable_math::log_positive(uniform_open(words[k]));
      }
    }
  });
  double sum = 0.0;
  for (double& spacing : partial_sums) {
    sum += spacing;
    spacing = sum;
  }
  double total = 0.0;
  std::size_t last_positive = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    total += weights[i];
    last_positive = weights[i] > 0.0 ? i : last_positive;
  }
  const double scale = total / sum;
  std::size_t source = 0;
  double cumulative = weights[0];
  for (std::size_t i = 0; i < n; ++i) {
    const double threshold = scale * partial_sums[i];
    while (cumulative < threshold && source < last_positive) {
      cumulative += weights[++source];
    }
    ancestors[i] = static_cast<Index>(source);
  }
}

}  // namespace tmcmc
