/// \file
/// The printed Tables 3 and 4 compared with replicated studies.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "replication/predictive.hpp"
#include "replication/replication.hpp"
#include "replication/verdict.hpp"
#include "statistics/deviance_test.hpp"

namespace replication {

using statistics::category_probabilities;
using statistics::Counts;
using statistics::DevianceTest;
using statistics::log_multinomial;
using statistics::TableDraws;
using statistics::test_tables;
using statistics::test_two_tables;
using statistics::total_of;

/// A printed area of Table 3.
struct PrintedArea {
  /// Sampler whose area it is.
  std::string sampler;
  /// Index into StudySummary::areas.
  std::size_t parameter;
  /// The area as printed; its digits give the rounding.
  std::string printed;
};

/// A printed column of Table 4.
struct PrintedCounts {
  /// Sampler whose column it is.
  std::string sampler;
  /// Number of runs by number of iterations.
  Counts counts;
};

/// The studies that form the null distribution of a sampler's printed numbers.
enum class Null {
  /// Studies of the sampler alone.
  own_studies,
  /// Studies of both samplers, if they are one algorithm: twice the draws.
  all_studies
};

/// Margin within which two samplers count as equivalent in the ratio of their median areas; the
/// printed effect is a factor of 2.1.
constexpr double area_margin = 0.10;
/// Margin of the ratio of mean iterations, a quarter of the printed effect of 2.02 % (10.08 against
/// 9.88 iterations).
constexpr double iteration_margin = 0.005;

/// A printed number in its null distribution. No p-value is adjusted: an adjustment would make
/// compatibility easier.
struct CellVerdict {
  /// Name of the sampler as printed.
  std::string sampler;
  /// Index into StudySummary::areas.
  std::size_t parameter = 0;
  /// The area as printed.
  double printed = 0.0;
  /// Median of the null studies.
  double median = 0.0;
  /// Central 95 % of the null studies.
  Interval95 interval{};
  /// Percentile of the printed area among the null studies.
  double percentile = 0.0;
  /// Two-sided.
  PValue p;
  /// Judged by p.
  Compatibility number = Compatibility::compatible;
};

/// Comparison of two samplers in one quantity.
struct ContrastVerdict {
  /// Ratio of areas, or two-sample deviance of counts.
  double printed = 0.0;
  /// Central 95 % of the null distribution.
  Interval95 interval{};
  /// p-value of the printed contrast if both samplers are one algorithm.
  PValue p;
  /// Second sampler over first: medians of areas, or means of iterations.
  Equivalence replicated{};
};

/// Judges each printed area against replicated studies.
/// \throws errors::InvalidValue if there is no study of a sampler.
[[nodiscard]] std::vector<CellVerdict> judge_areas(const std::vector<StudySummary>& studies,
                                                   const std::vector<PrintedArea>& areas, Null null);

/// Tests each printed column of Table 4 on its own, and then all columns together, by the deviance
/// from the probabilities of the replicated runs: columns.size() + 1 tests.
/// \throws errors::InvalidValue if there is no study of a sampler.
[[nodiscard]] std::vector<DevianceTest> judge_counts(const std::vector<StudySummary>& studies,
                                                     const std::vector<PrintedCounts>& columns, Null null,
                                                     const TableDraws& draws = {});

/// The numbers that the paper prints for one sampler: a column of Tables 3 and 4.
struct PrintedColumn {
  /// Sampler whose column it is.
  std::string sampler;
  /// Areas of friction force (N) and natural frequency (Hz), in this order.
  std::vector<double> areas;
  /// Number of runs by number of iterations.
  Counts counts;
};

/// The printed numbers by column, in the order of the counts.
/// \throws errors::InvalidValue unless each sampler has both areas.
[[nodiscard]] std::vector<PrintedColumn> printed_columns(const std::vector<PrintedArea>& areas,
                                                         const std::vector<PrintedCounts>& counts);

/// Absolute predictive p-values of the printed tables under the setting of the studies: see
/// predictive_p_of_pair.
struct JointTests {
  /// All printed areas.
  PValue areas;
  /// p-value of both columns of Table 4.
  PValue counts;
  /// Areas and counts of each sampler.
  std::vector<PValue> columns;
  /// All printed numbers.
  PValue all;
};

/// \param null  all_studies: one sampler made both columns; own_studies: each sampler made its own
///        column
/// \throws errors::InvalidValue unless there are two columns, and at least 3 studies of each
///         sampler.
[[nodiscard]] JointTests test_jointly(const std::vector<StudySummary>& studies,
                                      const std::vector<PrintedColumn>& printed, Null null);

/// Returns all_studies if the replicated studies of the two samplers are equivalent (the 95 %
/// intervals of the ratios lie within the margins: a test at 2.5 % per side) in the areas of the
/// first two parameters and in the number of iterations; otherwise own_studies. For the paper's
/// criteria pooling is justified by algebra: N_eff = N/2 is CoV = 1 with the population standard
/// deviation, and with the N - 1 standard deviation CoV = 1 is N_eff = 500.25 of 1000. This
/// function does not pool studies for which that does not hold, such as N/4.
/// \throws errors::InvalidValue if there is no study of a sampler.
[[nodiscard]] Null null_of(const std::vector<StudySummary>& studies, const std::string& first,
                           const std::string& second, std::uint64_t seed);

/// Ratio of the areas of two samplers, second over first, against the null hypothesis that they are
/// one algorithm: all pairs of studies, of either sampler, are equally likely.
[[nodiscard]] ContrastVerdict contrast_areas(const std::vector<StudySummary>& studies,
                                             const std::string& first, const std::string& second,
                                             std::size_t parameter, double printed_ratio, std::uint64_t seed);

/// Iteration counts of two samplers: the two-sample deviance against the deviance of two tables of
/// one algorithm, whose probabilities come from the runs of both samplers; and equivalence of the
/// mean numbers of iterations of all runs.
[[nodiscard]] ContrastVerdict contrast_iterations(const std::vector<StudySummary>& studies,
                                                  const Counts& first_printed, const Counts& second_printed,
                                                  const std::string& first, const std::string& second,
                                                  const TableDraws& draws = {});

/// C2 and C4 together: probability that two studies of one sampler differ as much as printed in the
/// ratio of their friction-force areas and in the deviance of their counts. The statistic is
/// Fisher's product of the two upper shares, calibrated against the same pairs of studies.
/// \param studies  studies of the one sampler, at least two; only the first 3000 are used
/// \param ratio  ratio of the printed areas, either way round
[[nodiscard]] PValue combined_contrast(const std::vector<StudySummary>& studies, double ratio,
                                       const Counts& first, const Counts& second);

/// Logarithm of the predictive density of all printed columns: see Prediction.
/// \throws as test_jointly, but for any number of columns.
[[nodiscard]] double log_likelihood_of_tables(const std::vector<StudySummary>& studies,
                                              const std::vector<PrintedColumn>& printed, Null null);

/// Studies of one sampler, in the order given.
/// \throws errors::InvalidValue if there is none.
[[nodiscard]] std::vector<StudySummary> studies_of(const std::vector<StudySummary>& studies,
                                                   const std::string& sampler);

/// The share of a sampler's studies in which a given number of runs took a given number of
/// iterations.
struct CountShare {
  /// Number of iterations, printed or in a study.
  std::int64_t iterations = 0;
  /// Number of runs in a study.
  std::int64_t runs = 0;
  /// Share of studies with exactly that many runs.
  double share_of_studies = 0.0;
  /// Runs in the printed column.
  std::int64_t printed = 0;
};
/// Shares in ascending order of iterations, then runs; there is no row for a share of 0.
/// \throws as studies_of.
[[nodiscard]] std::vector<CountShare> count_shares(const std::vector<StudySummary>& studies,
                                                   const PrintedCounts& printed);

/// The studies that form the null distribution of a sampler's numbers.
/// \throws as studies_of.
[[nodiscard]] std::vector<StudySummary> null_studies(const std::vector<StudySummary>& studies,
                                                     const std::string& sampler, Null null);

/// Mean number of iterations of a study.
[[nodiscard]] double mean_iterations(const Counts& counts);

}  // namespace replication
