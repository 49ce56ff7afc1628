/// \file
/// Tables that the experiments read: measurements, priors, samples of a study.
#pragma once

#include <string>

#include "options.hpp"
#include "replication/columns.hpp"
#include "replication/inputs.hpp"
#include "replication/published.hpp"
#include "replication/sample_tables.hpp"
#include "replication/study_tables.hpp"

namespace experiments {

using replication::bounds_of;
using replication::checked;
using replication::exact_posterior_for;
using replication::nonnegative_numbers;
using replication::null_of;
using replication::parameter_columns;
using replication::positive_integers;
using replication::positive_numbers;
using replication::PrintedTables;
using replication::prior_for;
using replication::read_printed_tables;
using replication::read_prior;
using replication::read_samples;
using replication::read_studies;
using replication::require_once;
using replication::require_runs_once;

/// Path of a file in data/published.
[[nodiscard]] std::string published(const std::string& file);

/// --observations and --prior.
struct InputFiles : replication::ProblemFiles {
  InputFiles() { table2 = published("table2_prior.csv"); }
  void add_observations_to(CLI::App& app);
  void add_prior_to(CLI::App& app);
};

/// What most executables begin with: measurements, prior and reading.
struct ProblemInputs : InputFiles {
  PhysicsOptions physics;

  void add_to(CLI::App& app);
};

/// Whether the path is that of the printed Table 1.
[[nodiscard]] bool is_table1(const std::string& observations);

/// As replication::read_observations, with its warning on standard error.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] friction::Observations read_observations(const std::string& path);

}  // namespace experiments
