/// \file
/// Tables that a study writes: samples and runs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "pbox/pbox.hpp"
#include "replication/study.hpp"

namespace replication {

/// Columns of one sampler's runs, from a file with columns `sampler`, `run` and one or more of
/// numbers.
struct GroupedColumns {
  /// In the order in which they first appear.
  std::vector<std::string> samplers;
  /// All but sampler, run and weight.
  std::vector<std::string> columns;
  /// values[sampler][column][run]: the numbers in the order of the file
  std::vector<std::vector<std::vector<std::vector<double>>>> values;
  /// weights[sampler][run] from the column `weight`; empty without it, when all samples count the same
  std::vector<std::vector<std::vector<double>>> weights = {};

  /// Mean and standard deviation of a column of a run, weighted.
  [[nodiscard]] statistics::Moments moments_of(std::size_t sampler, std::size_t column,
                                               std::size_t run) const;
  /// Distribution functions of a column, one a run, weighted.
  [[nodiscard]] std::vector<pbox::Ecdf> ecdfs(std::size_t sampler, std::size_t column) const;
};

/// Reads samples of a study (any parameters), grouped by sampler and run. A column `weight` holds the weights of the samples.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] GroupedColumns read_samples(const std::string& path);
/// The same of a table that was read.
[[nodiscard]] GroupedColumns read_samples(const io::CsvTable& table);

/// The same, of which only the columns with the names stay, in their order; `expected` says what
/// file was expected.
/// \throws as read_samples; for a column that is missing.
[[nodiscard]] GroupedColumns read_samples(const io::CsvTable& table, const std::vector<std::string>& names,
                                          const std::string& expected);

/// Mean and standard deviation of each parameter in turn, and the log-evidence: columns of the runs
/// of a study.
[[nodiscard]] const std::vector<std::string>& estimated_quantities();

/// What each run estimates, in the order of estimated_quantities, from the runs that sampling_study
/// writes.
/// \throws as read_samples; for a second row of a run or a negative standard deviation.
[[nodiscard]] GroupedColumns read_estimates(const std::string& path);

/// Columns of the runs of a study; with diagnosed, those of what the runs say of themselves too.
[[nodiscard]] std::vector<std::string> run_columns(bool diagnosed);
/// The cells of a run in the columns that diagnosed adds.
[[nodiscard]] std::vector<double> diagnosed_cells(const Run& run);

/// Columns of the samples of a study, and of the stages of its runs.
/// \param is_weighted  whether there is a column `weight`
[[nodiscard]] std::vector<std::string> sample_columns(bool is_weighted = false);
/// See sample_columns.
[[nodiscard]] std::vector<std::string> stage_columns();

/// The samples of a run as rows of a table with sample_columns(is_weighted).
/// \throws as io::CsvWriter::row, as the two below.
void write_samples(io::CsvWriter& table, const std::string& sampler, std::size_t index, const Run& run,
                   bool is_weighted = false);
/// A run as a row of a table with run_columns(diagnosed).
void write_run(io::CsvWriter& table, const std::string& sampler, std::size_t index, const Run& run,
               bool diagnosed);
/// The stages of a run as rows of a table with stage_columns().
void write_stages(io::CsvWriter& table, const std::string& sampler, std::size_t index, const Run& run);

/// What the runs of one sampler say of themselves.
struct Diagnoses {
  /// By bridge sampling, over the runs.
  statistics::Moments log_evidence;
  /// Of the log-evidence of a run: root mean square of what the runs say.
  double standard_error;
  /// Of any parameter and run.
  double smallest_effective_size;
  /// Number of runs by kind of warning.
  std::map<std::string, long> warned;
};
/// \param runs  with diagnostics (Options::diagnose), at least one
[[nodiscard]] Diagnoses diagnoses_of(const std::vector<Run>& runs);

}  // namespace replication
