#include "tmcmc/detail/resample.hpp"

#include <array>
#include <cmath>
#include <numeric>

#include "portable_math/multiversion.hpp"
#include "tmcmc/detail/random_rows.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc::detail {

namespace {

/// Total weight, and the last sample with positive weight.
struct Total {
  double weight = 0.0;
  std::size_t last_positive = 0;
};

Total total_of(ConstDoubles weights) {
  Total total;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    total.weight += weights[i];
    total.last_positive = weights[i] > 0.0 ? i : total.last_positive;
  }
  return total;
}

/// Sets ancestors[k] to the sample at which the cumulative weight reaches threshold(k), which must
/// ascend with k.
template <class Threshold>
void invert(ConstDoubles weights, std::size_t last_positive, std::span<Index> ancestors,
            Threshold threshold) {
  std::size_t source = 0;
  double cumulative = weights[0];
  for (std::size_t k = 0; k < ancestors.size(); ++k) {
    const double level = threshold(k);
    while (cumulative < level && source < last_positive) {
      cumulative += weights[++source];
    }
    ancestors[k] = static_cast<Index>(source);
  }
}

constexpr std::size_t lanes = 64;  // rows of four words that are worked on at a time

PORTABLE_MATH_MULTIVERSION
void exponentials(const std::array<std::uint64_t, 4 * lanes>& words,
                  std::array<double, 4 * lanes>& spacings) {
  for (std::size_t i = 0; i < 4 * lanes; ++i) {
    spacings[i] = -portable_math::log_positive(uniform_open(words[i]));
  }
}

/// Multinomial resampling with sorted uniform numbers, which are partial sums of exponential
/// spacings.
void multinomial(ConstDoubles weights, const StreamKey& key, std::uint32_t stage, std::span<Index> ancestors,
                 std::vector<double>& partial_sums, int threads) {
  const std::size_t n = ancestors.size();
  partial_sums.resize(n + 1);
  static_assert(reduction_rows % (4 * lanes) == 0, "a block starts with new words");
  for_each_block(static_cast<Index>(n + 1), reduction_rows, threads, [&](Index, Index begin, Index end) {
    std::array<std::uint64_t, lanes> rows{};
    std::array<std::uint64_t, 4 * lanes> words{};
    std::array<double, 4 * lanes> spacings{};
    for (auto first = static_cast<std::size_t>(begin); first < static_cast<std::size_t>(end);
         first += 4 * lanes) {
      const std::size_t count = std::min(static_cast<std::size_t>(end) - first, 4 * lanes);
      std::iota(rows.begin(), rows.end(), first / 4);
      random_words_of_rows(key, {.purpose = Purpose::resampling, .stage = stage},
                           {rows.data(), (count + 3) / 4}, words);
      exponentials(words, spacings);
      for (std::size_t i = 0; i < count; ++i) {
        partial_sums[first + i] = spacings[i % 4 * lanes + i / 4];
      }
    }
  });
  double sum = 0.0;
  for (double& spacing : partial_sums) {
    sum += spacing;
    spacing = sum;
  }
  const Total total = total_of(weights);
  const double scale = total.weight / sum;
  invert(weights, total.last_positive, ancestors, [&](std::size_t k) { return scale * partial_sums[k]; });
}

void stratified(ConstDoubles weights, const StreamKey& key, std::uint32_t stage, std::span<Index> ancestors,
                bool one_uniform) {
  const Total total = total_of(weights);
  const double width = total.weight / static_cast<double>(ancestors.size());
  invert(weights, total.last_positive, ancestors, [&](std::size_t k) {
    const std::size_t draw = one_uniform ? 0 : k;
    const Words words = random_words(key, {.purpose = Purpose::resampling, .stage = stage, .row = draw / 4});
    return width * (static_cast<double>(k) + uniform_open(words[draw % 4]));
  });
}

void residual(ConstDoubles weights, const StreamKey& key, std::uint32_t stage, std::span<Index> ancestors,
              ResamplingWorkspace& work, int threads) {
  const double scale = static_cast<double>(ancestors.size()) / total_of(weights).weight;
  work.residuals.resize(weights.size());
  std::size_t whole = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double copies = std::floor(scale * weights[i]);
    work.residuals[i] = scale * weights[i] - copies;
    whole += static_cast<std::size_t>(copies);
  }
  // Rounding can leave a rest without residuals, or more whole copies than the requested number.
  const std::size_t rest = whole < ancestors.size() ? ancestors.size() - whole : 0;
  work.drawn.resize(rest);
  if (rest > 0) {
    const bool any = total_of(work.residuals).weight > 0.0;
    multinomial(any ? ConstDoubles(work.residuals) : weights, key, stage, work.drawn, work.partial_sums,
                threads);
  }
  std::size_t k = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    auto copies = static_cast<std::size_t>(std::floor(scale * weights[i]));
    for (; next < rest && work.drawn[next] == static_cast<Index>(i); ++next) {
      ++copies;
    }
    for (; copies > 0 && k < ancestors.size(); --copies) {
      ancestors[k++] = static_cast<Index>(i);
    }
  }
}

}  // namespace

void resample(Resampling scheme, ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
              std::span<Index> ancestors, ResamplingWorkspace& work, int threads) {
  switch (scheme) {
    case Resampling::multinomial:
      multinomial(weights, key, stage, ancestors, work.partial_sums, threads);
      break;
    case Resampling::residual:
      residual(weights, key, stage, ancestors, work, threads);
      break;
    case Resampling::stratified:
      stratified(weights, key, stage, ancestors, false);
      break;
    case Resampling::systematic:
      stratified(weights, key, stage, ancestors, true);
      break;
  }
}

}  // namespace tmcmc::detail

void tmcmc::resample(Resampling scheme, ConstDoubles weights, const StreamKey& key, std::uint32_t stage,
                     std::span<Index> ancestors) {
  detail::ResamplingWorkspace work;
  detail::resample(scheme, weights, key, stage, ancestors, work);
}
