/// \file
/// Printed numbers beside ours, each with its place among replicated studies.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "replication/published.hpp"

namespace replication {

/// A cell of a printed table, or a test of several cells together (table "joint"). What is not known is NaN or empty.
struct ComparedCell {
  /// NaN.
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

  std::string table,                         ///< where it stands: its table,
      row,                                   ///< its row,
      column;                                ///< its column
  double printed = unknown;                  ///< as printed
  double ours = unknown;                     ///< of one study of ours
  double median = unknown;                   ///< of replicated studies
  Interval95 interval = {unknown, unknown};  ///< central 95 % of them
  double printed_percentile = unknown;       ///< of the printed number among them
  double our_percentile = unknown;           ///< of ours
  PValue p = {unknown, unknown};             ///< not adjusted
  std::string verdict = {};                  ///< name_of(Compatibility)
};

/// Appends a cell for each row of either table and each of the columns; rows are found by the key column. Values that a table
/// lacks count as `missing`.
/// \throws io::InputError naming file, line, column and value; for a key that stands twice.
void compare(std::vector<ComparedCell>& cells, const std::string& name, const std::string& key,
             const std::vector<std::string>& columns, const io::CsvTable& printed, const io::CsvTable& ours,
             double missing);

/// Ours minus printed; of a phase angle, deg, the shortest way.
[[nodiscard]] double difference(const ComparedCell& cell);

/// Places the cells of "Table 3" (rows are samplers, columns parameters) and "Table 4" (rows are numbers of iterations, columns
/// samplers) among the studies, and appends the joint tests: rows "areas", "counts", each sampler, "all". One p-value is that of
/// the whole Table 4: its cells have none. The columns of the samplers, parts of "all", have no word.
/// \param parameters  names of the columns of Table 3, in the order of StudySummary::areas
/// \throws errors::InvalidValue as judge_areas and test_jointly.
void place_among_studies(std::vector<ComparedCell>& cells, const std::vector<StudySummary>& studies,
                         const std::vector<PrintedArea>& areas, const std::vector<PrintedCounts>& counts,
                         Null null, const std::vector<std::string>& parameters);

/// Tables 3 and 4 and the joint tests as a Markdown table: a row for each area, one for Table 4.
[[nodiscard]] std::string comparison_markdown(const std::vector<ComparedCell>& cells);

}  // namespace replication
