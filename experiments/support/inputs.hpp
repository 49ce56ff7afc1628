/// \file
/// Tables that the experiments read: measurements, priors, samples of a study.
#pragma once

#include <string>

#include "command_line.hpp"
#include "estimation/exact_posterior.hpp"
#include "friction/observations.hpp"
#include "study/published.hpp"
#include "tmcmc/prior.hpp"

namespace experiments {

/// Names of the four parameters in columns of generated files, in the order of friction::Parameter, with
/// units.
inline const std::vector<std::string> parameter_columns = {"friction_force_n", "natural_frequency_hz",
                                                           "phase_noise_deg", "frequency_ratio_noise"};

/// --observations and --prior.
struct InputFiles {
  std::string observations;
  std::string prior;  ///< empty: Table 2, with the reading's bound of the natural frequency

  void add_observations_to(CLI::App& app);
  void add_prior_to(CLI::App& app);
};

/// Path of a file in data/published/ of the current directory, or else of the source tree.
[[nodiscard]] std::string published(const std::string& file);

/// The same of data/examples/.
[[nodiscard]] std::string example(const std::string& file);

/// Measurements in the columns of table1_observations.csv: r_nominal, r_measured, driving_frequency_hz,
/// phase_deg. \throws io::InputError naming file, line, column and value.
[[nodiscard]] friction::Observations read_observations(const std::string& path);

/// Uniform prior in the form of table2_prior.csv: one row a parameter, columns parameter, lower, upper.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] tmcmc::BoxPrior read_prior(const std::string& path);
/// The same of parameters with other names, in their order; none may be negative.
[[nodiscard]] tmcmc::BoxPrior read_prior(const std::string& path, const std::vector<std::string>& names);

/// The prior that the options ask for: a file of the user's as it stands; else Table 2 as the reading has it.
[[nodiscard]] tmcmc::BoxPrior prior_for(const InputFiles& inputs, const study::Reading& reading);

[[nodiscard]] estimation::ParameterBounds bounds_of(const tmcmc::BoxPrior& prior);

/// The exact posterior under a prior that the inputs gave.
/// \throws io::InputError if the prior holds no friction force with continuous motion.
[[nodiscard]] estimation::ExactPosterior exact_posterior_for(const InputFiles& inputs,
                                                             const friction::Likelihood& likelihood,
                                                             const tmcmc::BoxPrior& prior);

/// Columns of one sampler's runs, from a file with columns `sampler`, `run` and one or more of numbers.
struct GroupedColumns {
  std::vector<std::string> samplers;  ///< in the order in which they first appear
  std::vector<std::string> columns;   ///< all but sampler and run
  /// values[sampler][column][run]: the numbers in the order of the file
  std::vector<std::vector<std::vector<std::vector<double>>>> values;
};

/// Reads samples of a study (any parameters), grouped by sampler and run.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] GroupedColumns read_samples(const std::string& path);

/// Studies as replicated_study writes them.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] std::vector<study::StudySummary> read_studies(const std::string& path);

/// Tables 3 and 4 as printed, from the directory of printed tables.
struct PrintedTables {
  std::vector<study::PrintedArea> areas;  ///< friction force and natural frequency of each sampler
  std::vector<study::PrintedCounts> counts;
};
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] PrintedTables read_printed_tables(const std::string& table3, const std::string& table4);

/// The null distribution for the two printed samplers: both samplers' studies if they are equivalent. The bootstrap behind
/// that has a fixed seed of its own.
/// \throws io::InputError unless two samplers were printed.
[[nodiscard]] study::Null null_of(const std::vector<study::StudySummary>& studies,
                                  const PrintedTables& printed);

}  // namespace experiments
