/// \file
/// Statistics behind the verdicts: the position of a printed number in the distribution obtained
/// from replicated studies.
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

/// Half a unit of the last printed digit of a number: 0.08151 -> 5e-6, 9 -> 0.5, 1.5e-3 -> 5e-5.
/// \throws errors::InvalidValue unless the text is a decimal number.
[[nodiscard]] double rounding_half_width(const std::string& printed);

/// The verdict of the evidence on a claim.
enum class Verdict {
  /// The claim is borne out.
  holds,
  /// The claim is true, and would be whatever the samplers did.
  true_and_uninformative,
  /// A part of the claim is borne out.
  holds_in_part,
  /// The samplers are neither equivalent nor different.
  not_supported,
  /// The claim does not follow from what it is inferred from.
  does_not_follow,
  /// The evidence contradicts the claim.
  contradicted,
  /// A test that could have rejected the claim does not.
  not_rejected,
  /// Two counts of the same thing, perhaps from 0 and from 1.
  off_by_one,
  /// The paper's own numbers contradict the claim.
  internally_contradictory,
  /// The claim cannot be tested with public material.
  cannot_be_tested
};

/// Text of a verdict: "holds", "true, and uninformative", ...
[[nodiscard]] const std::string& name_of(Verdict verdict);

/// Below this p-value a printed number is not compatible with the sampler, and a contrast is very
/// unlikely by chance.
constexpr double strict_significance = 0.01;
/// Below this p-value a contrast is unlikely by chance.
constexpr double significance_level = 0.05;

// The bounds are Fisher's conventional 5 % and 1 %; they were set after the first results existed.
// A simulated p-value close to a bound falls on either side of it by chance. Hence its 95 % Monte
// Carlo interval, p +- 1.96 standard errors, decides and not the value itself (as in Gandy, Hahn
// and Ding 2020): a verdict requires that the whole interval lies on one side, so that no verdict
// is an accident of the seed.

/// Whether a printed number, or several together, can have been produced by the sampler.
enum class Compatibility {
  /// The whole interval is 0.01 or more.
  compatible,
  /// The whole interval is below 0.01.
  not_compatible,
  /// The interval contains 0.01: more studies would decide.
  undecided
};

/// Text of a compatibility: "compatible", "not compatible", "undecided".
[[nodiscard]] const std::string& name_of(Compatibility compatibility);

/// \param p  p-value, not adjusted for other numbers: an adjustment would make compatibility easier
[[nodiscard]] Compatibility judge_number(const PValue& p);

/// How likely the printed contrast is by chance, between two studies of one sampler.
enum class Chance {
  /// The whole interval is 0.05 or more.
  ordinary,
  /// The whole interval is below 0.05, but not below 0.01.
  unlikely,
  /// The whole interval is below 0.01.
  very_unlikely,
  /// The interval contains 0.05: more studies would decide.
  undecided
};

/// Text of a chance: "ordinary by chance", "unlikely by chance", "very unlikely by chance",
/// "undecided".
[[nodiscard]] const std::string& name_of(Chance chance);

/// \param p  p-value of the contrast if both samplers are one algorithm
[[nodiscard]] Chance judge_chance(const PValue& p);

/// Verdict on the claim that one sampler's quantity is larger, from the replicated studies of both:
/// it holds if they differ in the claimed direction; it is contradicted if they differ in the other
/// direction or are equivalent; otherwise it is not supported. How likely the printed contrast is
/// by chance is a separate question: see judge_chance.
[[nodiscard]] Verdict judge_contrast(const Equivalence& replicated);

}  // namespace replication
