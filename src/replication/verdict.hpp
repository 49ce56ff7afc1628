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
using statistics::mean_ratio_equivalence;
using statistics::median_ratio_equivalence;
using statistics::percentile;
using statistics::PValue;
using statistics::RatioTest;
using statistics::sample_quantile;
using statistics::test_ratio_of_equals;
using statistics::two_sided_p;
using statistics::upper_p;

/// Half a unit of the last digit of a number as printed: 0.08151 -> 5e-6, 9 -> 0.5, 1.5e-3 -> 5e-5.
/// \throws errors::InvalidValue unless the text is a decimal number.
[[nodiscard]] double rounding_half_width(const std::string& printed);

/// What the evidence says of a claim.
enum class Verdict {
  holds,                     ///< the claim is borne out
  true_and_uninformative,    ///< it is true, and would be so whatever the samplers did
  holds_in_part,             ///< a part of it is borne out
  not_supported,             ///< the samplers are neither equivalent nor different
  does_not_follow,           ///< what it is inferred from does not carry it
  contradicted,              ///< the evidence says otherwise
  not_rejected,              ///< a test of it, which could have failed, does not reject it
  off_by_one,                ///< two counts of the same thing, perhaps from 0 and from 1
  internally_contradictory,  ///< the paper's own numbers say otherwise
  cannot_be_tested           ///< with what is public
};

/// "holds", "true, and uninformative", ...
[[nodiscard]] const std::string& name_of(Verdict verdict);

/// Below it, a printed number is not compatible with the sampler, and a contrast very unlikely by chance.
constexpr double strict_significance = 0.01;
/// Below it, a contrast is unlikely by chance.
constexpr double significance_level = 0.05;

// The bounds are Fisher's conventional 5 % and 1 %; they were set after the first results existed. A p-value by simulation falls on
// either side of a bound that is close, by chance. Hence its 95 % Monte Carlo interval, p +- 1.96 standard errors, decides and not
// the value (as do Gandy, Hahn and Ding 2020): a word needs the whole of it, so that no verdict is an accident of the seed.

/// Whether a printed number, or several together, can be one that the sampler makes.
enum class Compatibility {
  compatible,      ///< all of the interval is 0.01 or more
  not_compatible,  ///< all of it is below 0.01
  undecided        ///< it holds 0.01: more studies would decide
};

/// "compatible", "not compatible", "undecided".
[[nodiscard]] const std::string& name_of(Compatibility compatibility);

/// \param p  not adjusted for other numbers: an adjustment would make compatibility easier
[[nodiscard]] Compatibility judge_number(const PValue& p);

/// How likely a contrast as printed is by chance, between two studies of one sampler.
enum class Chance {
  ordinary,       ///< all of the interval is 0.05 or more
  unlikely,       ///< all of it is below 0.05, but not below 0.01
  very_unlikely,  ///< all of it is below 0.01
  undecided       ///< it holds 0.05: more studies would decide
};

/// "ordinary by chance", "unlikely by chance", "very unlikely by chance", "undecided".
[[nodiscard]] const std::string& name_of(Chance chance);

/// \param p  of the contrast if both samplers are one
[[nodiscard]] Chance judge_chance(const PValue& p);

/// A claim that one sampler's quantity is larger, by the replicated studies of both: holds if they differ the way that is claimed;
/// contradicted if they differ the other way or are equivalent; else not supported. How likely the printed contrast is by chance is
/// another question: see judge_chance.
[[nodiscard]] Verdict judge_contrast(const Equivalence& replicated);

}  // namespace replication
