#include "study/verdict.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "portable_math/elementary.hpp"
#include "tmcmc/random.hpp"

namespace study {

namespace {

double log_factorial(std::int64_t n) {
  double sum = 0.0;
  for (std::int64_t i = 2; i <= n; ++i) {
    sum += portable_math::log(static_cast<double>(i));
  }
  return sum;
}

std::int64_t total(const Counts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::int64_t{0},
                         [](std::int64_t sum, const auto& cell) { return sum + cell.second; });
}

double probability(const std::map<std::int64_t, double>& probabilities, std::int64_t category) {
  const auto found = probabilities.find(category);
  if (found == probabilities.end()) {
    throw std::invalid_argument("category " + std::to_string(category) + ": expected one with a probability");
  }
  return found->second;
}

double median(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  return sample_quantile(values, 0.5);
}

}  // namespace

double rounding_half_width(const std::string& printed) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(printed.data(), printed.data() + printed.size(), value);
  if (error != std::errc() || end != printed.data() + printed.size() || !std::isfinite(value)) {
    throw std::invalid_argument("printed value '" + printed + "': expected a decimal number");
  }
  const auto exponent_at = printed.find_first_of("eE");
  const std::string mantissa = printed.substr(0, exponent_at);
  const auto point = mantissa.find('.');
  int exponent = point == std::string::npos ? 0 : -static_cast<int>(mantissa.size() - point - 1);
  if (exponent_at != std::string::npos) {
    exponent += std::stoi(printed.substr(exponent_at + 1));
  }
  const std::string unit = "5e" + std::to_string(exponent - 1);
  double half = 0.0;
  std::from_chars(unit.data(), unit.data() + unit.size(), half);
  return half;
}

double sample_quantile(std::span<const double> sorted, double p) {
  const double position = p * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const auto above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

double upper_p(std::span<const double> null, double value, double half_width) {
  const auto tail =
      std::count_if(null.begin(), null.end(), [=](double x) { return x >= value - half_width; });
  return static_cast<double>(tail + 1) / static_cast<double>(null.size() + 1);
}

double two_sided_p(std::span<const double> null, double value, double half_width) {
  const auto lower =
      std::count_if(null.begin(), null.end(), [=](double x) { return x <= value + half_width; });
  const double lower_tail = static_cast<double>(lower + 1) / static_cast<double>(null.size() + 1);
  return std::min(1.0, 2.0 * std::min(lower_tail, upper_p(null, value, half_width)));
}

Interval95 central_95(std::vector<double> null) {
  std::sort(null.begin(), null.end());
  return {sample_quantile(null, 0.025), sample_quantile(null, 0.975)};
}

std::vector<double> holm(const std::vector<double>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  std::vector<double> adjusted(p.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    largest = std::max(largest, std::min(1.0, static_cast<double>(p.size() - i) * p[order[i]]));
    adjusted[order[i]] = largest;
  }
  return adjusted;
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

double deviance(const Counts& counts, const std::map<std::int64_t, double>& probabilities) {
  const double n = static_cast<double>(total(counts));
  double sum = 0.0;
  for (const auto& [category, count] : counts) {
    if (count > 0) {
      const double observed = static_cast<double>(count);
      sum += observed * portable_math::log(observed / (n * probability(probabilities, category)));
    }
  }
  return 2.0 * sum;
}

double log_multinomial(const Counts& counts, const std::map<std::int64_t, double>& probabilities) {
  double sum = log_factorial(total(counts));
  for (const auto& [category, count] : counts) {
    if (count > 0) {
      sum += static_cast<double>(count) * portable_math::log(probability(probabilities, category)) -
             log_factorial(count);
    }
  }
  return sum;
}

double two_sample_deviance(const Counts& first, const Counts& second) {
  Counts both = first;
  for (const auto& [category, count] : second) {
    both[category] += count;
  }
  std::map<std::int64_t, double> common;
  for (const auto& [category, count] : both) {
    common[category] = static_cast<double>(count) / static_cast<double>(total(both));
  }
  return deviance(first, common) + deviance(second, common);
}

Equivalence median_ratio_equivalence(std::span<const double> first, std::span<const double> second,
                                     double margin, std::uint64_t seed, int resamples) {
  const auto check = [](std::span<const double> values) {
    if (values.empty() || std::any_of(values.begin(), values.end(), [](double x) { return !(x > 0.0); })) {
      throw std::invalid_argument("median_ratio_equivalence: expected at least one number, and all positive");
    }
  };
  check(first);
  check(second);
  std::vector<double> a(first.begin(), first.end());
  std::vector<double> b(second.begin(), second.end());
  Equivalence result{};
  result.margin = margin;
  result.ratio = median(b) / median(a);
  std::vector<double> ratios;
  const auto resample = [&](std::span<const double> source, std::vector<double>& target, std::uint32_t round,
                            std::uint32_t arm) {
    for (std::size_t i = 0; i < source.size(); ++i) {
      const auto words = tmcmc::random_words(
          {.seed = seed, .arm = arm}, {.purpose = tmcmc::Purpose::resampling, .stage = round, .row = i});
      const auto pick =
          static_cast<std::size_t>(tmcmc::uniform_open(words[0]) * static_cast<double>(source.size()));
      target[i] = source[pick];
    }
    return median(target);
  };
  for (int round = 0; round < resamples; ++round) {
    const double below = resample(first, a, static_cast<std::uint32_t>(round), 0);
    ratios.push_back(resample(second, b, static_cast<std::uint32_t>(round), 1) / below);
  }
  result.interval = central_95(std::move(ratios));
  result.equivalent = result.interval.low >= 1.0 / (1.0 + margin) && result.interval.high <= 1.0 + margin;
  result.different = result.interval.low > 1.0 || result.interval.high < 1.0;
  return result;
}

const std::string& name_of(Verdict verdict) {
  static const std::vector<std::string> names = {
      "reproduced",   "consistent with chance",   "not supported",
      "contradicted", "internally contradictory", "cannot be tested"};
  return names[static_cast<std::size_t>(verdict)];
}

Verdict judge_contrast(double p_printed, const Equivalence& replicated) {
  if (replicated.equivalent) {
    return p_printed >= significance_level ? Verdict::consistent_with_chance : Verdict::not_supported;
  }
  if (replicated.different) {
    return replicated.ratio > 1.0 ? Verdict::reproduced : Verdict::contradicted;
  }
  return Verdict::not_supported;
}

}  // namespace study
