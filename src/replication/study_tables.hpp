/// \file
/// Summaries of whole studies as replicated_study writes them, and the printed tables.
#pragma once

#include <string>
#include <vector>

#include "replication/published.hpp"
#include "replication/replication.hpp"

namespace replication {

/// Header line of the studies that replicated_study writes.
[[nodiscard]] std::string study_header();
/// The summary of one study and sampler as a line below the header.
[[nodiscard]] std::string study_line(const StudySummary& summary);

/// A column of lines of one sampler, from 0; the text of a line is not checked.
[[nodiscard]] std::vector<double> study_column(const std::vector<std::string>& lines,
                                               const std::string& sampler, std::size_t column);

/// Studies as replicated_study writes them: each study must occur once with each sampler.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] std::vector<StudySummary> read_studies(const std::string& path);

/// Tables 3 and 4 as printed, read from the directory of printed tables.
struct PrintedTables {
  /// Areas of friction force and natural frequency for each sampler.
  std::vector<PrintedArea> areas;
  /// Runs of each sampler by number of iterations.
  std::vector<PrintedCounts> counts;
  /// File of the counts, for messages.
  std::string counts_path;
};
/// Reads both tables, which must name the same samplers.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] PrintedTables read_printed_tables(const std::string& table3, const std::string& table4);

/// As read_studies(path), requiring studies of every printed sampler.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] std::vector<StudySummary> read_studies(const std::string& path, const PrintedTables& printed);

/// The null distribution for the two printed samplers: the studies of both samplers if they are
/// equivalent. The bootstrap used for that decision has its own fixed seed.
/// \throws io::InputError unless exactly two samplers are printed.
[[nodiscard]] Null null_of(const std::vector<StudySummary>& studies, const PrintedTables& printed);

}  // namespace replication
