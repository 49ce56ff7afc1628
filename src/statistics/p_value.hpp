/// \file
/// p-values by simulation, their adjustment, and equivalence of two samples.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "statistics/summary.hpp"

namespace statistics {

/// A p-value by simulation, and its Monte Carlo standard error: how much it would vary with another
/// seed.
struct PValue {
  /// In (0, 1].
  double value = 1.0;
  /// Monte Carlo, of the value.
  double standard_error = 0.0;
};

/// Two-sided Monte Carlo p-value of a value against draws from the null: twice the smaller tail,
/// the value itself counted as one draw (Davison and Hinkley 1997, Section 4.2), at most 1. A draw
/// that rounds to the printed value counts to both tails. The standard error is binomial, that of
/// independent draws.
/// \param half_width  rounding of the value, see rounding_half_width
[[nodiscard]] PValue two_sided_p(std::span<const double> null, double value, double half_width = 0.0);

/// One-sided: the probability of a draw at least as large.
[[nodiscard]] PValue upper_p(std::span<const double> null, double value, double half_width = 0.0);

/// Percentile of a value among the null: 100 times the share of the draws that are at most as
/// large, rounding and the value itself counted as in two_sided_p.
/// \param half_width  rounding of the value, see rounding_half_width
[[nodiscard]] double percentile(std::span<const double> null, double value, double half_width = 0.0);

/// A ratio of two independent draws from one distribution, in the null distribution that sample
/// gives it.
struct RatioTest {
  /// Central 95 % of the ratios of all ordered pairs.
  Interval95 interval{};
  /// Two-sided; standard error by Hoeffding's projection of the U-statistic.
  PValue p;
};

/// \param sample  at least two positive numbers
/// \throws errors::InvalidValue for a sample or ratio out of range.
[[nodiscard]] RatioTest test_ratio_of_equals(std::vector<double> sample, double ratio);

/// Holm's (1979) step-down adjustment of p-values, in the order given; standard errors are
/// multiplied as the values are.
[[nodiscard]] std::vector<PValue> holm(const std::vector<PValue>& p);

/// Equivalence of two samples of positive numbers by a ratio: of their medians or means. The
/// interval is two-sided, 95 %: a test of equivalence at 2.5 % a side.
struct Equivalence {
  /// Second over first.
  double ratio;
  /// 95 %, see the function.
  Interval95 interval;
  /// 0.10 for 10 %.
  double margin;
  /// The interval lies within [1/(1 + margin), 1 + margin].
  bool equivalent;
  /// The interval does not hold 1.
  bool different;
};

/// Ratio of medians, with a bootstrap percentile interval.
/// \param seed  of the bootstrap (resamples of each sample, `resamples` times)
/// \throws errors::InvalidValue for an empty sample or a number that is not positive.
[[nodiscard]] Equivalence median_ratio_equivalence(std::span<const double> first,
                                                   std::span<const double> second, double margin,
                                                   std::uint64_t seed, int resamples = 2000);

/// Ratio of means, with a Normal interval (delta method).
/// \throws errors::InvalidValue for fewer than two numbers or one that is not positive.
[[nodiscard]] Equivalence mean_ratio_equivalence(std::span<const double> first,
                                                 std::span<const double> second, double margin);

}  // namespace statistics
