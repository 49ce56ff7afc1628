/// \file
/// Tables that the experiments read: measurements, priors, samples of a study.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "estimation/exact_posterior.hpp"
#include "friction/observations.hpp"
#include "options.hpp"
#include "replication/columns.hpp"
#include "replication/published.hpp"
#include "replication/sample_tables.hpp"
#include "replication/study_tables.hpp"
#include "tmcmc/prior.hpp"

namespace experiments {

using replication::checked;
using replication::nonnegative_numbers;
using replication::null_of;
using replication::parameter_columns;
using replication::positive_integers;
using replication::positive_numbers;
using replication::PrintedTables;
using replication::read_printed_tables;
using replication::read_samples;
using replication::read_studies;
using replication::require_once;
using replication::require_runs_once;

/// --observations and --prior.
struct InputFiles {
  std::string observations;
  /// Empty: Table 2, with the reading's bound of the natural frequency.
  std::string prior;
  /// Empty: independent parameters.
  std::string prior_correlation;

  void add_observations_to(CLI::App& app);
  void add_prior_to(CLI::App& app);
};

/// What most executables begin with: measurements, prior and reading.
struct ProblemInputs : InputFiles {
  PhysicsOptions physics;

  void add_to(CLI::App& app);
};

/// Path of a file in data/published/ of the current directory, or else of the source tree.
[[nodiscard]] std::string published(const std::string& file);

/// The same of data/examples/.
[[nodiscard]] std::string example(const std::string& file);

/// Whether the path is that of the printed Table 1.
[[nodiscard]] bool is_table1(const std::string& observations);

/// Measurements in the columns of table1_observations.csv: r_nominal, r_measured,
/// driving_frequency_hz, phase_deg. Warns on stderr of phases whose unit or sign is doubtful.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] friction::Observations read_observations(const std::string& path);

/// The prior of the four parameters of the paper from a file (problem/prior_file.hpp); none of them may be
/// negative.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] tmcmc::Prior read_prior(const std::string& path, const std::string& correlations = {});

/// The prior that the options ask for: a file of the user's as it stands; else Table 2 as the
/// reading has it.
[[nodiscard]] tmcmc::Prior prior_for(const InputFiles& inputs, const replication::Reading& reading);

/// The bounds of a uniform prior.
/// \throws io::InputError for another prior, saying that `what` needs a uniform one
[[nodiscard]] estimation::ParameterBounds bounds_of(const tmcmc::Prior& prior, std::string_view what);

/// A prior of independent parameters as the quadrature takes it, with its quantiles as breaks.
/// \throws io::InputError for parameters that are not independent
[[nodiscard]] estimation::ParameterPriors quadrature_priors(const tmcmc::Prior& prior);

/// The exact posterior under a prior that the inputs gave.
/// \throws io::InputError if the prior holds no friction force with continuous motion or a bound
///         that a density cannot have, naming file, line, column and value of the prior; the file
///         alone if it cannot be read again.
[[nodiscard]] estimation::ExactPosterior exact_posterior_for(const InputFiles& inputs,
                                                             const friction::Likelihood& likelihood,
                                                             const tmcmc::Prior& prior);

}  // namespace experiments
