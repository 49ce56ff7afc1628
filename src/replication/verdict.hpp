/// \file
/// Statistics behind the verdicts: where a printed number lies in the distribution that replicated studies give it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace replication {

/// Half a unit of the last digit of a number as printed: 0.08151 -> 5e-6, 9 -> 0.5, 1.5e-3 -> 5e-5.
/// \throws errors::InvalidValue unless the text is a decimal number.
[[nodiscard]] double rounding_half_width(const std::string& printed);

/// An interval that holds 95 %: of what, its owner says.
struct Interval95 {
  double low;   ///< 2.5 % lie below
  double high;  ///< 2.5 % lie above
};

/// Quantile of a sample by linear interpolation of the order statistics (type 7 of Hyndman and Fan 1996).
/// \param sorted  ascending, not empty
/// \param p  in [0, 1]
[[nodiscard]] double sample_quantile(std::span<const double> sorted, double p);

/// A p-value by simulation, and its Monte Carlo standard error: how much it would vary with another seed.
struct PValue {
  double value = 1.0;           ///< in (0, 1]
  double standard_error = 0.0;  ///< Monte Carlo, of the value
};

/// Two-sided Monte Carlo p-value of a value against draws from the null: twice the smaller tail, the value itself counted
/// as one draw (Davison and Hinkley 1997, Section 4.2), at most 1. A draw that rounds to the printed value counts to both
/// tails. The standard error is binomial, that of independent draws.
/// \param half_width  rounding of the value, see rounding_half_width
[[nodiscard]] PValue two_sided_p(std::span<const double> null, double value, double half_width = 0.0);

/// One-sided: the probability of a draw at least as large.
[[nodiscard]] PValue upper_p(std::span<const double> null, double value, double half_width = 0.0);

/// A ratio of two independent draws from one distribution, in the null distribution that sample gives it.
struct RatioTest {
  Interval95 interval{};  ///< central 95 % of the ratios of all ordered pairs
  PValue p;               ///< two-sided; standard error by Hoeffding's projection of the U-statistic
};

/// \param sample  at least two positive numbers
/// \throws errors::InvalidValue for a sample or ratio out of range.
[[nodiscard]] RatioTest test_ratio_of_equals(std::vector<double> sample, double ratio);

/// Central 95 % interval of the draws.
[[nodiscard]] Interval95 central_95(std::vector<double> null);

/// Holm's (1979) step-down adjustment of p-values, in the order given; standard errors are multiplied as the values are.
[[nodiscard]] std::vector<PValue> holm(const std::vector<PValue>& p);

/// Equivalence of two samples of positive numbers by the ratio of their medians.
struct Equivalence {
  double ratio;         ///< median(second) / median(first)
  Interval95 interval;  ///< 95 % bootstrap percentile interval
  double margin;        ///< 0.10 for 10 %
  bool equivalent;      ///< the interval lies within [1/(1 + margin), 1 + margin]
  bool different;       ///< the interval does not hold 1
};

/// \param seed  of the bootstrap (resamples of each sample, `resamples` times)
/// \throws errors::InvalidValue for an empty sample or a number that is not positive.
[[nodiscard]] Equivalence median_ratio_equivalence(std::span<const double> first,
                                                   std::span<const double> second, double margin,
                                                   std::uint64_t seed, int resamples = 2000);

/// What the evidence says of a printed number or a claim.
enum class Verdict {
  reproduced,                ///< it comes out again
  consistent_with_chance,    ///< the printed contrast is one that equal samplers show by chance
  not_supported,             ///< what was printed does not carry the claim
  contradicted,              ///< the evidence says otherwise
  internally_contradictory,  ///< the paper's own numbers say otherwise
  cannot_be_tested,
  undecided  ///< a bound lies within the Monte Carlo error: more studies would decide
};

/// "reproduced", "consistent with chance", ...
[[nodiscard]] const std::string& name_of(Verdict verdict);

/// Below it, a number is untypical of the null.
constexpr double significance_level = 0.05;
/// Below it, a number is not reproduced.
constexpr double strict_significance = 0.01;

/// What the 95 % Monte Carlo interval p +- 1.96 standard errors of a p-value says of a printed number.
enum class Typicality {
  reproduced,      ///< all of it is 0.05 or more: a number that repetitions of the study give
  untypical,       ///< all of it is below 0.05, but not below 0.01
  not_reproduced,  ///< all of it is below 0.01
  undecided        ///< it holds 0.05: more studies would decide
};

/// "reproduced", "untypical", "not reproduced", "undecided".
[[nodiscard]] const std::string& name_of(Typicality typicality);

/// \param p  adjusted by Holm over all numbers that are judged together; a claim of its own is not adjusted
///
/// The bounds are Fisher's conventional 5 % and 1 %, whatever numbers are judged. A p-value by simulation falls on either
/// side of a bound that is close, by chance. Hence the interval decides and not the value (as do Gandy, Hahn and Ding
/// 2020), and a stronger word needs the whole of it, so that no verdict is an accident of the seed. "Not reproduced" needs
/// many draws: with none of n beyond the number, two-sided p is 2/(n+1) with an error as large.
[[nodiscard]] Typicality judge_number(const PValue& p);

/// A claim that one sampler's quantity is larger, by the contrast as printed (its p-value if both samplers are one) and
/// by the replicated medians. A real difference the way that is claimed: reproduced; the other way: contradicted. None,
/// and the samplers equivalent: consistent with chance if the printed contrast is (p of 0.05 and more), else not
/// supported; undecided if the Monte Carlo interval of p, as in judge_number, holds 0.05. Else not supported.
[[nodiscard]] Verdict judge_contrast(const PValue& printed, const Equivalence& replicated);

}  // namespace replication
