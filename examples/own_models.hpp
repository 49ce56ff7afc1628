/// \file
/// The models of own_model: those in C++ by their names, or another program.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "problem_options.hpp"
#include "storage/inference_data.hpp"
#include "tmcmc/sampler.hpp"

namespace examples {

/// What is known of the measurements, for the NetCDF file.
struct Measurements {
  std::vector<storage::Column> observed = {};  ///< what was measured
  std::vector<storage::Column> constant = {};  ///< what else is known of each measurement
  /// Log-likelihoods of single observations of a population by the name of an observed variable; may be empty.
  std::function<std::vector<std::pair<std::string, Eigen::MatrixXd>>(const Eigen::MatrixXd& points)>
      pointwise = {};
};

/// A log-likelihood, its prior, and what is known of both.
struct Model {
  tmcmc::Prior prior;                   ///< of the parameters, in the order of the columns of the points
  tmcmc::LogLikelihood log_likelihood;  ///< of a batch of points
  std::string description;         ///< one line that names all that the values depend on, for the checkpoint
  Measurements measurements = {};  ///< empty for a program that keeps its data to itself
};

/// Who follows a run.
struct Listeners {
  /// Told what the user should know.
  std::function<void(const std::string& text)> note;
  /// Told, from any thread, how many log-likelihoods a call of the model has given.
  std::function<void(tmcmc::Index rows)> evaluated;
};

/// Names of the models in C++, the default first.
[[nodiscard]] std::vector<std::string> built_in_names();

/// The model of the options; another program is called several times at a time.
/// \throws std::invalid_argument for more than one model, or a server without a name of a model;
///         io::InputError naming file, line, field and value; models::ModelError if the program
///         cannot be run.
[[nodiscard]] Model make_model(const ProblemOptions& options, const Listeners& listeners);

}  // namespace examples
