/// \file
/// Tables that the experiments read: measurements, priors, samples of a study.
#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "command_line.hpp"
#include "estimation/exact_posterior.hpp"
#include "friction/observations.hpp"
#include "replication/published.hpp"
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

  void add_observations_to(Program& program);
  void add_prior_to(Program& program);
};

/// What stands behind the last "expected" of a complaint such as "friction_force.lower = 3: expected less than 2 N".
[[nodiscard]] std::string expectation(const std::string& complaint);

/// Path of a file in data/published/ of the current directory, or else of the source tree.
[[nodiscard]] std::string published(const std::string& file);

/// The same of data/examples/.
[[nodiscard]] std::string example(const std::string& file);

/// The values of a column, each of which the rule has to allow; `expected` completes the sentence "expected ...".
/// \throws io::InputError naming file, line, column and value.
template <class Value, class Rule>
[[nodiscard]] std::vector<Value> checked(const io::CsvTable& table, std::string_view column,
                                         std::vector<Value> values, Rule rule, std::string_view expected) {
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!rule(values[row])) {
      table.fail(row, column, expected);
    }
  }
  return values;
}

/// The numbers of a column, which have to be positive.
/// \throws as checked.
[[nodiscard]] std::vector<double> positive_numbers(const io::CsvTable& table, std::string_view column);

/// The numbers of a column, of which none may be negative.
/// \throws as checked.
[[nodiscard]] std::vector<double> nonnegative_numbers(const io::CsvTable& table, std::string_view column);

/// The integers of a column, from 1.
/// \throws as checked.
[[nodiscard]] std::vector<long> positive_integers(const io::CsvTable& table, std::string_view column);

/// Refuses the first row whose key another row had before, by its cell of the column.
/// \throws as checked.
template <class Key>
void require_once(const io::CsvTable& table, const std::vector<Key>& keys, std::string_view column,
                  std::string_view expected) {
  std::set<Key> seen;
  for (std::size_t row = 0; row < keys.size(); ++row) {
    if (!seen.insert(keys[row]).second) {
      table.fail(row, column, expected);
    }
  }
}

/// Refuses a second row of a run; columns sampler and run.
/// \throws as checked.
void require_runs_once(const io::CsvTable& table);

/// Measurements in the columns of table1_observations.csv: r_nominal, r_measured, driving_frequency_hz,
/// phase_deg. Warns on stderr of phases whose unit or sign is doubtful.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] friction::Observations read_observations(const std::string& path);

/// Uniform prior in the form of table2_prior.csv: one row a parameter, columns parameter, lower, upper.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] tmcmc::BoxPrior read_prior(const std::string& path);
/// The same of parameters with other names, in their order; none may be negative.
[[nodiscard]] tmcmc::BoxPrior read_prior(const std::string& path, const std::vector<std::string>& names);

/// Bounds and the names of the parameters that they belong to, in the order of the file.
struct NamedPrior {
  std::vector<std::string> names;
  tmcmc::BoxPrior prior;
};

/// A prior in the same form, of any parameters and with bounds of any sign.
/// \param require_name  throws errors::InvalidValue for a name that a parameter must not have
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] NamedPrior read_named_prior(const std::string& path,
                                          const std::function<void(const std::string& name)>& require_name);

/// The prior that the options ask for: a file of the user's as it stands; else Table 2 as the reading has it.
[[nodiscard]] tmcmc::BoxPrior prior_for(const InputFiles& inputs, const replication::Reading& reading);

[[nodiscard]] estimation::ParameterBounds bounds_of(const tmcmc::BoxPrior& prior);

/// The exact posterior under a prior that the inputs gave.
/// \throws io::InputError if the prior holds no friction force with continuous motion or a bound that a density cannot
///         have, naming file, line, column and value of the prior; the file alone if it cannot be read again.
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
/// The same of a table that was read.
[[nodiscard]] GroupedColumns read_samples(const io::CsvTable& table);

/// Studies as replicated_study writes them: each study once with each sampler.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] std::vector<replication::StudySummary> read_studies(const std::string& path);

/// Tables 3 and 4 as printed, from the directory of printed tables.
struct PrintedTables {
  std::vector<replication::PrintedArea> areas;  ///< friction force and natural frequency of each sampler
  std::vector<replication::PrintedCounts> counts;
  std::string counts_path;
};
/// Both tables have to name the same samplers.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] PrintedTables read_printed_tables(const std::string& table3, const std::string& table4);

/// The same, with studies of every printed sampler.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] std::vector<replication::StudySummary> read_studies(const std::string& path,
                                                                  const PrintedTables& printed);

/// The null distribution for the two printed samplers: both samplers' studies if they are equivalent. The bootstrap behind
/// that has a fixed seed of its own.
/// \throws io::InputError unless two samplers were printed.
[[nodiscard]] replication::Null null_of(const std::vector<replication::StudySummary>& studies,
                                        const PrintedTables& printed);

}  // namespace experiments
