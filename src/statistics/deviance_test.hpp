/// \file
/// Tables of counts in the null distribution of their deviance.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "statistics/counts.hpp"
#include "statistics/p_value.hpp"

namespace statistics {

/// How the null distribution of a deviance is simulated. The runs of a study are independent, so a
/// table of counts is multinomial; its probabilities come from all runs of the replicated studies,
/// not from tables of one study each.
struct TableDraws {
  /// Simulated tables.
  int tables = 200000;
  /// Of the replicated runs, at least 2: what their finite number adds to the error.
  int resamples = 100;
  /// Stream of its own (Purpose::statistics): not that of any study.
  std::uint64_t seed = 1;
  /// If set, called before each table and each resample; what it throws ends the test.
  std::function<void()> interrupt = {};
};

/// A deviance in its null distribution.
struct DevianceTest {
  /// Deviance of the printed tables.
  double statistic = 0.0;
  /// 95 % quantile of the null.
  double critical = 0.0;
  /// Central 95 % of the null.
  Interval95 interval{};
  /// Probability of a deviance at least as large. Its standard error has two parts: the number of
  /// tables drawn, and the number of replicated runs, by a parametric bootstrap of the
  /// probabilities that re-weights the same tables.
  PValue p;
};

/// Deviance 2 sum O log(O/E) of printed tables against the probabilities of replicated runs
/// (category_probabilities), summed over the tables.
/// \param replicated  counts of the studies behind each table; or one entry that is behind all of
///        them
/// \throws errors::InvalidValue if no study is behind a table, or for options out of range.
[[nodiscard]] DevianceTest test_tables(const std::vector<Counts>& printed,
                                       const std::vector<std::vector<Counts>>& replicated,
                                       const TableDraws& draws = {});

/// Two-sample deviance of two tables, E from their common shares (the likelihood-ratio statistic),
/// against two tables drawn from the one distribution of the replicated runs.
/// \throws as test_tables.
[[nodiscard]] DevianceTest test_two_tables(const Counts& first, const Counts& second,
                                           const std::vector<Counts>& replicated,
                                           const TableDraws& draws = {});

}  // namespace statistics
