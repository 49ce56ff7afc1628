#include "statistics/counts.hpp"

#include <numeric>

#include "errors/invalid_value.hpp"
#include "portable_math/elementary.hpp"

namespace statistics {

namespace {

double log_factorial(std::int64_t n) {
  double sum = 0.0;
  for (std::int64_t i = 2; i <= n; ++i) {
    sum += portable_math::log(static_cast<double>(i));
  }
  return sum;
}

double probability(const std::map<std::int64_t, double>& probabilities, std::int64_t category) {
  const auto found = probabilities.find(category);
  if (found == probabilities.end()) {
    throw errors::InvalidValue("category", category, "one that has a probability");
  }
  return found->second;
}

}  // namespace

std::int64_t total_of(const Counts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0},
                         [](std::int64_t sum, const auto& cell) { return sum + cell.second; });
}

std::map<std::int64_t, double> category_probabilities(const std::vector<Counts>& pooled,
                                                      const Counts& categories) {
  std::map<std::int64_t, double> sums;
  for (const auto& cell : categories) {
    sums[cell.first] = 0.5;
  }
  for (const Counts& counts : pooled) {
    for (const auto& cell : counts) {
      sums.try_emplace(cell.first, 0.5).first->second += static_cast<double>(cell.second);
    }
  }
  double sum = 0.0;
  for (const auto& cell : sums) {
    sum += cell.second;
  }
  for (auto& cell : sums) {
    cell.second /= sum;
  }
  return sums;
}

double log_multinomial(const Counts& counts, const std::map<std::int64_t, double>& probabilities) {
  double sum = log_factorial(total_of(counts));
  for (const auto& [category, count] : counts) {
    if (count > 0) {
      sum += static_cast<double>(count) * portable_math::log(probability(probabilities, category)) -
             log_factorial(count);
    }
  }
  return sum;
}

}  // namespace statistics
