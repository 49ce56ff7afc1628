/// \file
/// The measurements and priors that the paper's problem is made of, read from files.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "estimation/exact_posterior.hpp"
#include "friction/observations.hpp"
#include "replication/reading.hpp"
#include "tmcmc/prior.hpp"

namespace replication {

/// Where measurements and prior are.
struct ProblemFiles {
  /// Measurements in the columns of table1_observations.csv.
  std::string observations;
  /// Prior of the user; empty for Table 2, with the reading's bound of the natural frequency.
  std::string prior;
  /// Matrix of correlations; empty for independent parameters.
  std::string prior_correlation;
  /// Table 2 as printed.
  std::string table2;
};

/// Measurements in the columns r_nominal, r_measured, driving_frequency_hz and phase_deg.
/// \param warn  called with one line that names the file, if unit or sign of the phases is doubtful
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] friction::Observations read_observations(const std::string& path,
                                                       const std::function<void(const std::string&)>& warn);

/// The prior of the four parameters of the paper from a file (problem/prior_file.hpp); none of them
/// may be negative.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] tmcmc::Prior read_prior(const std::string& path, const std::string& correlations = {});

/// The prior of the files: the user's as it stands; otherwise Table 2 as the reading has it.
/// \throws as read_prior.
[[nodiscard]] tmcmc::Prior prior_for(const ProblemFiles& files, const Reading& reading);

/// The bounds of a uniform prior.
/// \param what  what needs them, for the message
/// \throws io::InputError for another prior.
[[nodiscard]] estimation::ParameterBounds bounds_of(const tmcmc::Prior& prior, std::string_view what);

/// A prior of independent parameters in the form that the quadrature needs, with quantiles as
/// breaks.
/// \throws io::InputError for parameters that are not independent.
[[nodiscard]] estimation::ParameterPriors quadrature_priors(const tmcmc::Prior& prior);

/// The exact posterior under a prior that was read from the files.
/// \throws io::InputError if the prior holds no friction force with continuous motion, or a bound
///         that a density cannot have, naming file, line, column and value of the prior; the file
///         alone if it cannot be read again.
[[nodiscard]] estimation::ExactPosterior exact_posterior_for(const ProblemFiles& files,
                                                             const friction::Likelihood& likelihood,
                                                             const tmcmc::Prior& prior);

}  // namespace replication
