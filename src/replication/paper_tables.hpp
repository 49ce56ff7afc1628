/// \file
/// Contents of Tables 4 and 5 and of Figures 4 and 5, from the files of a study.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "replication/sample_tables.hpp"

namespace replication {

/// Number of runs by number of iterations (Table 4).
struct IterationTable {
  /// Names of the samplers, in the order in which they first appear.
  std::vector<std::string> samplers;
  /// By number of iterations: number of runs of each sampler.
  std::map<long, std::vector<long>> runs;
};

/// Counts the runs in the columns sampler and iterations.
/// \throws io::InputError naming file, line, column and value; also for a second row of the same
///         run, if there is a column run.
[[nodiscard]] IterationTable count_iterations(const io::CsvTable& runs);

/// Spread of the posterior means of one parameter over the runs of one sampler (Table 5), in the
/// unit of the parameter.
struct StandardError {
  /// Name of the sampler.
  std::string sampler;
  /// Name of the parameter's column.
  std::string parameter;
  /// Mean of the means of the runs.
  double mean = 0.0;
  /// Standard deviation over the runs (N - 1); NaN for one run.
  double standard_error = 0.0;
  /// Standard deviation of the pooled posterior: within the runs and, if there are several, between
  /// them.
  double posterior_sd = 0.0;
  /// Standard error of as many independent samples as a run has.
  double independent = 0.0;
  /// Number of independent samples with this standard error.
  double effective_size = 0.0;
};

/// One entry for each sampler and column.
[[nodiscard]] std::vector<StandardError> standard_errors(const GroupedColumns& samples);

/// A bar of each sampler (Figure 4).
struct BarPair {
  /// "area" or "iterations".
  std::string panel;
  /// "printed" or "reproduced".
  std::string source;
  /// Column of the parameter, or number of iterations.
  std::string category;
  /// Heights for the first and the second sampler.
  std::array<double, 2> heights;
};

/// Tables 3 and 4 from one source.
struct AreasAndCounts {
  /// Columns sampler, friction_force_n and natural_frequency_hz.
  io::CsvTable areas;
  /// Column iterations, and one for each sampler.
  io::CsvTable counts;
};

/// The bars of both sources; each has a bar for every number of iterations that occurs in one of
/// them.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] std::vector<BarPair> bar_pairs(const AreasAndCounts& printed, const AreasAndCounts& reproduced,
                                             const std::array<std::string, 2>& samplers);

/// Tempering parameter after a stage (Figure 5).
struct StageOfRun {
  /// Name of the sampler.
  std::string sampler;
  /// Number of the run.
  long run;
  /// Number of the stage, from 1.
  long stage;
  /// Tempering parameter, from 0 to 1.
  double beta;
};

/// Reads the columns sampler, run, stage and beta.
/// \throws io::InputError naming file, line, column and value; also for a second row of the same
///         stage.
[[nodiscard]] std::vector<StageOfRun> read_stages(const io::CsvTable& table);

}  // namespace replication
