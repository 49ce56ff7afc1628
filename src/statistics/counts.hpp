/// \file
/// Numbers of runs by category (how many iterations they took): multinomial statistics.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

namespace statistics {

/// Number of runs by category.
using Counts = std::map<std::int64_t, std::int64_t>;

/// Sum of the counts over all categories.
[[nodiscard]] std::int64_t total_of(const Counts& counts);

/// Category probabilities of pooled counts, with half a count added to each category of
/// `categories` and to each category that occurs, so that no probability is 0 (Jeffreys' prior, as
/// in Krichevsky and Trofimov 1981).
[[nodiscard]] std::map<std::int64_t, double> category_probabilities(const std::vector<Counts>& pooled,
                                                                    const Counts& categories);

/// Logarithm of the multinomial probability of the counts.
/// \throws errors::InvalidValue for a category that occurs and has no probability.
[[nodiscard]] double log_multinomial(const Counts& counts,
                                     const std::map<std::int64_t, double>& probabilities);

}  // namespace statistics
