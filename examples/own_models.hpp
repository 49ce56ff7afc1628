/// \file
/// The models of own_model: those in C++ by their names, or another program.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "models/forward_model.hpp"
#include "problem/parameters.hpp"
#include "problem_options.hpp"
#include "storage/inference_data.hpp"
#include "tmcmc/sampler.hpp"

namespace examples {

/// Data about the measurements, for the NetCDF file.
struct Measurements {
  /// The measurements.
  std::vector<storage::Column> observed = {};
  /// Further data on each measurement.
  std::vector<storage::Column> constant = {};
  /// Log-likelihoods of single observations of a population, under the name of an observed
  /// variable; may be empty.
  std::function<std::vector<std::pair<std::string, Eigen::MatrixXd>>(const Eigen::MatrixXd& points)>
      pointwise = {};
};

/// The outputs of a model that its likelihood compares with the measurements.
struct ComparedOutputs {
  /// Outputs at points of all parameters, as many as there are values in Measurements::observed and
  /// in the same order; empty for a model that gives only the log-likelihood.
  models::ForwardModel outputs = {};
  /// Standard deviations of the measurement errors at a point, in the units of the outputs.
  std::function<Eigen::RowVectorXd(const Eigen::RowVectorXd& point, const Eigen::RowVectorXd& outputs)>
      noise = {};
  /// Short labels of the measurements; empty: their numbers.
  std::vector<std::string> labels = {};
};

/// A log-likelihood, its prior, and the data belonging to both.
struct Model {
  /// Prior of the parameters, in the order of the columns of the points.
  tmcmc::Prior prior;
  /// Log-likelihood of a batch of points.
  tmcmc::LogLikelihood log_likelihood;
  /// One line that names all that the values depend on, for the checkpoint.
  std::string description;
  /// Empty for a program that keeps its data to itself.
  Measurements measurements = {};
  /// Empty for a program that keeps its data to itself.
  ComparedOutputs compared = {};
};

/// Functions that are informed of the progress of a run.
struct Listeners {
  /// Called with messages for the user.
  std::function<void(const std::string& text)> note;
  /// Called, from any thread, with the number of points for which a call of the model has given
  /// log-likelihoods or outputs.
  std::function<void(tmcmc::Index rows)> evaluated;
};

/// The prior of the problem file, or the prior of the files given in the options.
/// \throws io::InputError naming file, line, key or column, and value
[[nodiscard]] tmcmc::Prior prior_of(const ProblemOptions& options, const problem::ParameterRules& rules);

/// The same log-likelihood or model, with its rows counted.
template <class Values>
[[nodiscard]] auto counted(
    std::function<void(const Eigen::Ref<const Eigen::MatrixXd>&, Eigen::Ref<Values>)> model,
    const Listeners& listeners) {
  return decltype(model)([model, evaluated = listeners.evaluated](const auto& points, auto values) {
    model(points, values);
    evaluated(points.rows());
  });
}

/// Names of the models in C++, the default first.
[[nodiscard]] std::vector<std::string> built_in_names();

/// The model selected by the options; another program is called concurrently.
/// \throws std::invalid_argument for more than one model, or for a server without the name of a
///         model; io::InputError naming file, line, field and value; models::ModelError if the
///         program cannot be run.
[[nodiscard]] Model make_model(const ProblemOptions& options, const Listeners& listeners);

}  // namespace examples
