#include "statistics/p_value.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "errors/invalid_value.hpp"
#include "tmcmc/random.hpp"

namespace statistics {

namespace {

double tail_p(std::int64_t tail, std::size_t draws) {
  return static_cast<double>(tail + 1) / static_cast<double>(draws + 1);
}

/// Standard error of a tail share estimated from independent draws.
double binomial_error(double share, double draws) {
  return std::sqrt(share * (1.0 - share) / draws);
}

/// Median as in sample_quantile, without sorting all values.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return values.size() % 2 == 1 ? *middle
                                : *middle - 0.5 * (*middle - *std::max_element(values.begin(), middle));
}

void require_positive(std::span<const double> values, std::size_t least) {
  if (values.size() < least ||
      std::any_of(values.begin(), values.end(), [](double x) { return !(x > 0.0); })) {
    throw errors::InvalidValue(
        "sample", values.size(),
        least == 1 ? "at least one number, and all positive" : "at least two numbers, and all positive");
  }
}

Equivalence equivalence(double ratio, const Interval95& interval, double margin) {
  return {ratio, interval, margin, interval.low >= 1.0 / (1.0 + margin) && interval.high <= 1.0 + margin,
          interval.low > 1.0 || interval.high < 1.0};
}

}  // namespace

PValue upper_p(std::span<const double> null, double value, double half_width) {
  const double p =
      tail_p(std::count_if(null.begin(), null.end(), [=](double x) { return x >= value - half_width; }),
             null.size());
  return {p, binomial_error(p, static_cast<double>(null.size() + 1))};
}

PValue two_sided_p(std::span<const double> null, double value, double half_width) {
  const double lower =
      tail_p(std::count_if(null.begin(), null.end(), [=](double x) { return x <= value + half_width; }),
             null.size());
  const double tail = std::min(lower, upper_p(null, value, half_width).value);
  return {std::min(1.0, 2.0 * tail), 2.0 * binomial_error(tail, static_cast<double>(null.size() + 1))};
}

double percentile(std::span<const double> null, double value, double half_width) {
  return 100.0 *
         tail_p(std::count_if(null.begin(), null.end(), [=](double x) { return x <= value + half_width; }),
                null.size());
}

RatioTest test_ratio_of_equals(std::vector<double> sample, double ratio) {
  std::sort(sample.begin(), sample.end());
  if (sample.size() < 2 || !(sample.front() > 0.0) || !(ratio > 0.0)) {
    throw errors::InvalidValue("sample and ratio", "",
                               "at least two numbers in the sample, and all positive");
  }
  const auto n = static_cast<double>(sample.size());
  // The shares of the other numbers that are at least r times x_i, and of the numbers of which x_i
  // is at least r times the value.
  const auto shares = [&](double r) {
    std::vector<double> of_each;
    for (const double x : sample) {
      const auto above = sample.end() - std::lower_bound(sample.begin(), sample.end(), r * x);
      const auto below = std::upper_bound(sample.begin(), sample.end(), x / r) - sample.begin();
      of_each.push_back(0.5 * static_cast<double>(above + below) / (n - 1.0));
    }
    return moments(of_each);
  };
  const double printed = std::max(ratio, 1.0 / ratio);
  const double pairs = 0.5 * n;  // that are independent; the printed one counts as one more
  RatioTest result;
  if (printed == 1.0) {
    result.p = {1.0, 0.0};
  } else {
    const Moments m = shares(printed);
    const double tail = (m.mean * pairs + 1.0) / (pairs + 1.0);
    const double error = m.mean > 0.0 ? 2.0 * m.standard_deviation / std::sqrt(n) : tail;
    result.p = {std::min(1.0, 2.0 * tail), 2.0 * error};
  }
  double low = 1.0;
  double high = sample.back() / sample.front();
  for (int i = 0; i < 60 && low < high; ++i) {  // the tail share falls as r grows
    const double middle = 0.5 * (low + high);
    (shares(middle).mean > 0.025 ? low : high) = middle;
  }
  result.interval = {1.0 / high, high};
  return result;
}

std::vector<PValue> holm(const std::vector<PValue>& p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return p[a].value < p[b].value; });
  std::vector<PValue> adjusted(p.size());
  PValue largest{0.0, 0.0};
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto factor = static_cast<double>(p.size() - i);
    const PValue& own = p[order[i]];
    if (factor * own.value > largest.value) {
      largest = {std::min(1.0, factor * own.value), factor * own.standard_error};
    }
    adjusted[order[i]] = largest;
  }
  return adjusted;
}

Equivalence median_ratio_equivalence(std::span<const double> first, std::span<const double> second,
                                     double margin, std::uint64_t seed, int resamples) {
  require_positive(first, 1);
  require_positive(second, 1);
  std::vector<double> a(first.begin(), first.end());
  std::vector<double> b(second.begin(), second.end());
  const double ratio = median(b) / median(a);
  std::vector<double> ratios;
  const auto resample = [&](std::span<const double> source, std::vector<double>& target, std::uint32_t round,
                            std::uint32_t arm) {
    for (std::size_t i = 0; i < source.size(); ++i) {
      const auto words = tmcmc::random_words(
          {.seed = seed, .arm = arm}, {.purpose = tmcmc::Purpose::statistics, .stage = round, .row = i});
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
  return equivalence(ratio, central_95(std::move(ratios)), margin);
}

Equivalence mean_ratio_equivalence(std::span<const double> first, std::span<const double> second,
                                   double margin) {
  require_positive(first, 2);
  require_positive(second, 2);
  const auto relative_variance = [](const Moments& m, std::size_t n) {
    const double relative = m.standard_deviation / m.mean;
    return relative * relative / static_cast<double>(n);
  };
  const Moments a = moments(first);
  const Moments b = moments(second);
  const double ratio = b.mean / a.mean;
  const double half =
      1.96 * ratio * std::sqrt(relative_variance(a, first.size()) + relative_variance(b, second.size()));
  return equivalence(ratio, {ratio - half, ratio + half}, margin);
}

}  // namespace statistics
