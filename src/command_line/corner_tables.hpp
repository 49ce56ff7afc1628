/// \file
/// The tables behind a corner plot of samples: what `corner` and `own_model --figures` write.
#pragma once

#include <string>
#include <vector>

#include "command_line/report.hpp"

namespace command_line {

/// Samples by parameter.
struct CornerSamples {
  /// Names of the parameters.
  std::vector<std::string> names;
  /// One a parameter, all of one length.
  std::vector<std::vector<double>> columns;
  /// Weights of the samples; empty for equal weights.
  std::vector<double> weights;
};

/// Files, or none.
struct CornerTables {
  /// Of each pair: the middle of a cell, its density, and the probability of the cells at least as
  /// dense.
  OptionalCsv joint;
  /// For each parameter: bins with their density.
  OptionalCsv marginals;
  /// A row per parameter: moments, quantiles, the range that is drawn and its tics.
  OptionalCsv summary;

  /// \throws io::OutputError for a path that cannot be written; an empty one is no file.
  CornerTables(const std::string& joint_path, const std::string& marginals_path,
               const std::string& summary_path);

  /// Writes the rows of all tables. \param bins  of each parameter
  /// \param report  where the summary is printed too; may be null
  void write(const CornerSamples& samples, long bins, const Report* report = nullptr);
};

}  // namespace command_line
