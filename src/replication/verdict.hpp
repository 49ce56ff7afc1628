/// \file
/// Statistics behind the verdicts: where a printed number lies in the distribution that replicated studies give it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "statistics/p_value.hpp"

namespace replication {

using statistics::central_95;
using statistics::Equivalence;
using statistics::holm;
using statistics::Interval95;
using statistics::median_ratio_equivalence;
using statistics::PValue;
using statistics::RatioTest;
using statistics::sample_quantile;
using statistics::test_ratio_of_equals;
using statistics::two_sided_p;
using statistics::upper_p;

/// Half a unit of the last digit of a number as printed: 0.08151 -> 5e-6, 9 -> 0.5, 1.5e-3 -> 5e-5.
/// \throws errors::InvalidValue unless the text is a decimal number.
[[nodiscard]] double rounding_half_width(const std::string& printed);

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
