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

/// Columns of each sampler's runs, from a file with columns `sampler`, `run` and at least one
/// column of numbers.
struct GroupedColumns {
  /// Names of the samplers, in the order in which they first appear.
  std::vector<std::string> samplers;
  /// Names of all columns except sampler, run and weight.
  std::vector<std::string> columns;
  /// values[sampler][column][run]: the numbers in the order of the file.
  std::vector<std::vector<std::vector<std::vector<double>>>> values;
  /// weights[sampler][run] from the column `weight`; empty without that column, when all samples
  /// count equally.
  std::vector<std::vector<std::vector<double>>> weights = {};

  /// Weighted mean and standard deviation of a column of a run.
  [[nodiscard]] statistics::Moments moments_of(std::size_t sampler, std::size_t column,
                                               std::size_t run) const;
  /// Weighted distribution functions of a column, one per run.
  [[nodiscard]] std::vector<pbox::Ecdf> ecdfs(std::size_t sampler, std::size_t column) const;
};

/// Reads samples of a study (any parameters), grouped by sampler and run. A column `weight` holds
/// the weights of the samples.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] GroupedColumns read_samples(const std::string& path);
/// As read_samples(path), for a table that has been read.
[[nodiscard]] GroupedColumns read_samples(const io::CsvTable& table);

/// As read_samples, keeping only the named columns, in the given order; `expected` says which file
/// was expected.
/// \throws as read_samples; also if a column is missing.
[[nodiscard]] GroupedColumns read_samples(const io::CsvTable& table, const std::vector<std::string>& names,
                                          const std::string& expected);

/// Names of the mean and standard deviation of each parameter in turn, and of the log-evidence:
/// columns of the runs of a study.
[[nodiscard]] const std::vector<std::string>& estimated_quantities();

/// The estimates of each run, in the order of estimated_quantities, from the runs that
/// sampling_study writes.
/// \throws as read_samples; also for a second row of the same run or a negative standard deviation.
[[nodiscard]] GroupedColumns read_estimates(const std::string& path);

/// Columns of the runs of a study; if `diagnosed`, with the columns of the runs' diagnostics.
[[nodiscard]] std::vector<std::string> run_columns(bool diagnosed);
/// The cells of a run in the columns that `diagnosed` adds.
[[nodiscard]] std::vector<double> diagnosed_cells(const Run& run);

/// Columns of the samples of a study.
/// \param is_weighted  whether there is a column `weight`
[[nodiscard]] std::vector<std::string> sample_columns(bool is_weighted = false);
/// Columns of the stages of the runs of a study.
[[nodiscard]] std::vector<std::string> stage_columns();

/// The samples of a run as rows of a table with sample_columns(is_weighted).
/// \throws as io::CsvWriter::row; this also holds for the two functions below.
void write_samples(io::CsvWriter& table, const std::string& sampler, std::size_t index, const Run& run,
                   bool is_weighted = false);
/// A run as a row of a table with run_columns(diagnosed).
void write_run(io::CsvWriter& table, const std::string& sampler, std::size_t index, const Run& run,
               bool diagnosed);
/// The stages of a run as rows of a table with stage_columns().
void write_stages(io::CsvWriter& table, const std::string& sampler, std::size_t index, const Run& run);

/// Diagnostics of the runs of one sampler.
struct Diagnoses {
  /// Log-evidence by bridge sampling, over the runs.
  statistics::Moments log_evidence;
  /// Standard error of the log-evidence of a run: root mean square of the errors that the runs
  /// state.
  double standard_error;
  /// Smallest effective sample size of any parameter and run.
  double smallest_effective_size;
  /// Number of runs by kind of warning.
  std::map<std::string, long> warned;
};
/// \param runs  runs with diagnostics (Options::diagnose), at least one
[[nodiscard]] Diagnoses diagnoses_of(const std::vector<Run>& runs);

}  // namespace replication
