/// \file
/// Printed numbers compared with ours, each with its position among replicated studies.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "replication/published.hpp"
#include "tmcmc/prior.hpp"

namespace replication {

/// A cell of a printed table, or a test of several cells together (table "joint"). Unknown values
/// are NaN or empty.
struct ComparedCell {
  /// NaN, for unknown numbers.
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  /// Table that the cell is in.
  std::string table;
  /// Row of the cell.
  std::string row;
  /// Column of the cell.
  std::string column;
  /// The number as printed.
  double printed = unknown;
  /// The same number from one study of ours.
  double ours = unknown;
  /// Median of replicated studies.
  double median = unknown;
  /// Central 95 % of the replicated studies.
  Interval95 interval = {unknown, unknown};
  /// Percentile of the printed number among the studies.
  double printed_percentile = unknown;
  /// Percentile of our number among the studies.
  double our_percentile = unknown;
  /// p-value of the printed number, not adjusted for multiple tests.
  PValue p = {unknown, unknown};
  /// name_of(Compatibility).
  std::string verdict = {};
};

/// Appends a cell for each row of either table and each of the columns; rows are matched by the key
/// column. Values that a table lacks count as `missing`.
/// \throws io::InputError naming file, line, column and value; also for a key that occurs twice.
void compare(std::vector<ComparedCell>& cells, const std::string& name, const std::string& key,
             const std::vector<std::string>& columns, const io::CsvTable& printed, const io::CsvTable& ours,
             double missing);

/// Appends the cells of "Table 2", the bounds of each parameter.
void compare_bounds(std::vector<ComparedCell>& cells, const tmcmc::Prior& printed, const tmcmc::Prior& ours);

/// Our number minus the printed one; for a phase angle, deg, the shortest rotation.
[[nodiscard]] double difference(const ComparedCell& cell);

/// Places the cells of "Table 3" (rows are samplers, columns parameters) and "Table 4" (rows are
/// numbers of iterations, columns samplers) among the studies, and appends the joint tests in rows
/// "areas", "counts", each sampler, and "all". Table 4 as a whole has one p-value; its cells have
/// none. The rows of the samplers, which are parts of "all", get no verdict.
/// \throws errors::InvalidValue as judge_areas and test_jointly.
void place_among_studies(std::vector<ComparedCell>& cells, const std::vector<StudySummary>& studies,
                         const std::vector<PrintedArea>& areas, const std::vector<PrintedCounts>& counts,
                         Null null, const std::vector<std::string>& parameters);

/// The cells as text: each table with one row per cell.
[[nodiscard]] std::string comparison_text(const std::vector<ComparedCell>& cells);

/// Tables 3 and 4 and the joint tests as a Markdown table: a row for each area, one for Table 4.
[[nodiscard]] std::string comparison_markdown(const std::vector<ComparedCell>& cells);

}  // namespace replication
