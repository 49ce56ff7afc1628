/// \file
/// Simulated p-values, their adjustment, and equivalence of two samples.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "statistics/summary.hpp"

namespace statistics {

/// A simulated p-value and its Monte Carlo standard error, which measures how much the value would
/// vary with another seed.
struct PValue {
  /// The p-value, in (0, 1].
  double value = 1.0;
  /// Monte Carlo standard error of the value.
  double standard_error = 0.0;
};

/// Two-sided Monte Carlo p-value of a value against draws from the null distribution: twice the
/// smaller tail, where the value itself counts as one draw (Davison and Hinkley 1997, Section 4.2),
/// at most 1. A draw that rounds to the printed value counts in both tails. The standard error is
/// the binomial one, for independent draws.
/// \param half_width  rounding of the value, see rounding_half_width
[[nodiscard]] PValue two_sided_p(std::span<const double> null, double value, double half_width = 0.0);

/// One-sided Monte Carlo p-value: the probability of a draw at least as large.
[[nodiscard]] PValue upper_p(std::span<const double> null, double value, double half_width = 0.0);

/// Percentile of a value in the null distribution: 100 times the share of the draws that are at
/// most as large, where rounding and the value itself count as in two_sided_p.
/// \param half_width  rounding of the value, see rounding_half_width
[[nodiscard]] double percentile(std::span<const double> null, double value, double half_width = 0.0);

/// A ratio of two independent draws from one distribution, tested against the null distribution of
/// such ratios that a sample gives.
struct RatioTest {
  /// Central 95 % of the ratios of all ordered pairs.
  Interval95 interval{};
  /// Two-sided p-value; standard error by Hoeffding's projection of the U-statistic.
  PValue p;
};

/// \param sample  at least two positive numbers
/// \throws errors::InvalidValue for a sample or ratio out of range.
[[nodiscard]] RatioTest test_ratio_of_equals(std::vector<double> sample, double ratio);

/// Holm's (1979) step-down adjustment of p-values, in the order given; standard errors are
/// multiplied by the same factors as the values.
[[nodiscard]] std::vector<PValue> holm(const std::vector<PValue>& p);

/// Equivalence of two samples of positive numbers, judged by the ratio of their medians or means.
/// The interval is two-sided, 95 %: a test of equivalence at 2.5 % per side.
struct Equivalence {
  /// Ratio, second sample over first.
  double ratio;
  /// 95 % interval of the ratio; see the function that computes it.
  Interval95 interval;
  /// Margin of equivalence, 0.10 for 10 %.
  double margin;
  /// Whether the interval lies within [1/(1 + margin), 1 + margin].
  bool equivalent;
  /// Whether the interval excludes 1.
  bool different;
};

/// Ratio of medians, with a bootstrap percentile interval.
/// \param seed  seed of the bootstrap, which resamples each sample `resamples` times
/// \throws errors::InvalidValue for an empty sample or a number that is not positive.
[[nodiscard]] Equivalence median_ratio_equivalence(std::span<const double> first,
                                                   std::span<const double> second, double margin,
                                                   std::uint64_t seed, int resamples = 2000);

/// Ratio of means, with a Normal interval (delta method).
/// \throws errors::InvalidValue for fewer than two numbers or a number that is not positive.
[[nodiscard]] Equivalence mean_ratio_equivalence(std::span<const double> first,
                                                 std::span<const double> second, double margin);

}  // namespace statistics
