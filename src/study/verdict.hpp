/// \file
/// Statistics behind the verdicts: where a printed number lies in the distribution that replicated studies give it.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace study {

/// Half a unit of the last digit of a number as printed: 0.08151 -> 5e-6, 9 -> 0.5, 1.5e-3 -> 5e-5.
/// \throws std::invalid_argument unless the text is a decimal number.
[[nodiscard]] double rounding_half_width(const std::string& printed);

struct Interval95 {
  double low;
  double high;
};

/// Quantile of a sample by linear interpolation of the order statistics (type 7 of Hyndman and Fan 1996).
/// \param sorted  ascending, not empty
/// \param p  in [0, 1]
[[nodiscard]] double sample_quantile(std::span<const double> sorted, double p);

/// Two-sided Monte Carlo p-value of a value against draws from the null: twice the smaller tail, the value itself counted
/// as one draw (Davison and Hinkley 1997, Section 4.2), at most 1. A draw that rounds to the printed value counts to both
/// tails.
/// \param half_width  rounding of the value, see rounding_half_width
[[nodiscard]] double two_sided_p(std::span<const double> null, double value, double half_width = 0.0);

/// One-sided: the probability of a draw at least as large.
[[nodiscard]] double upper_p(std::span<const double> null, double value, double half_width = 0.0);

/// Central 95 % interval of the draws.
[[nodiscard]] Interval95 central_95(std::vector<double> null);

/// Holm's (1979) step-down adjustment of p-values, in the order given.
[[nodiscard]] std::vector<double> holm(const std::vector<double>& p);

using Counts = std::map<std::int64_t, std::int64_t>;

/// Category probabilities of pooled counts, with half a count added to each category of `categories` and to each that
/// occurs, so that none is 0.
[[nodiscard]] std::map<std::int64_t, double> category_probabilities(const std::vector<Counts>& pooled,
                                                                    const Counts& categories);

/// Deviance 2 sum O log(O/E) of counts against category probabilities.
/// \throws std::invalid_argument for a category without a probability.
[[nodiscard]] double deviance(const Counts& counts, const std::map<std::int64_t, double>& probabilities);

/// log of the multinomial probability of the counts.
[[nodiscard]] double log_multinomial(const Counts& counts,
                                     const std::map<std::int64_t, double>& probabilities);

/// Deviance of two samples of counts against their common probabilities: the two-sample likelihood-ratio statistic.
[[nodiscard]] double two_sample_deviance(const Counts& first, const Counts& second);

/// Equivalence of two samples of positive numbers by the ratio of their medians.
struct Equivalence {
  double ratio;         ///< median(second) / median(first)
  Interval95 interval;  ///< 95 % bootstrap percentile interval
  double margin;
  bool equivalent;  ///< the interval lies within [1/(1 + margin), 1 + margin]
  bool different;   ///< the interval does not hold 1
};

/// \param seed  of the bootstrap (resamples of each sample, `resamples` times)
/// \throws std::invalid_argument for an empty sample or a number that is not positive.
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
  cannot_be_tested
};

/// "reproduced", "consistent with chance", ...
[[nodiscard]] const std::string& name_of(Verdict verdict);

constexpr double significance_level = 0.05;

/// A claim that one sampler's quantity is larger, by the contrast as printed (its p-value if both samplers are one) and
/// by the replicated medians. A real difference the way that is claimed: reproduced; the other way: contradicted. None,
/// and the samplers equivalent: consistent with chance if the printed contrast is, else not supported. Else not supported.
[[nodiscard]] Verdict judge_contrast(double p_printed, const Equivalence& replicated);

}  // namespace study
