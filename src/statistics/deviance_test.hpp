/// \file
/// Tests of tables of counts by the null distribution of their deviance.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "statistics/counts.hpp"
#include "statistics/p_value.hpp"

namespace statistics {

/// Settings for simulating the null distribution of a deviance. The runs of a study are
/// independent, so a table of counts is multinomial; its probabilities come from all runs of the
/// replicated studies, not from the tables of single studies.
struct TableDraws {
  /// Number of simulated tables.
  int tables = 200000;
  /// Number of resamples of the replicated runs, at least 2; they give the part of the error that
  /// is due to the finite number of runs.
  int resamples = 100;
  /// Seed of a stream of its own (Purpose::statistics), which differs from that of any study.
  std::uint64_t seed = 1;
  /// If set, called before each table and each resample; an exception from it ends the test.
  std::function<void()> interrupt = {};
};

/// A deviance and its null distribution.
struct DevianceTest {
  /// Deviance of the printed tables.
  double statistic = 0.0;
  /// 95 % quantile of the null distribution.
  double critical = 0.0;
  /// Central 95 % of the null distribution.
  Interval95 interval{};
  /// Probability of a deviance at least as large. Its standard error has two parts: one due to the
  /// number of tables drawn, and one due to the number of replicated runs, estimated by a
  /// parametric bootstrap of the probabilities that re-weights the same tables.
  PValue p;
};

/// Deviance 2 sum O log(O/E) of printed tables against the probabilities of replicated runs
/// (category_probabilities), summed over the tables.
/// \param replicated  counts of the studies behind each table; or one entry that applies to all
///        tables
/// \throws errors::InvalidValue if there is no study behind a table, or for options out of range.
[[nodiscard]] DevianceTest test_tables(const std::vector<Counts>& printed,
                                       const std::vector<std::vector<Counts>>& replicated,
                                       const TableDraws& draws = {});

/// Two-sample deviance of two tables, with E from their common shares (the likelihood-ratio
/// statistic), against pairs of tables drawn from the one distribution of the replicated runs.
/// \throws as test_tables.
[[nodiscard]] DevianceTest test_two_tables(const Counts& first, const Counts& second,
                                           const std::vector<Counts>& replicated,
                                           const TableDraws& draws = {});

}  // namespace statistics
