/// \file
/// The models of own_model: the shear frame, or another program; and what is kept of a run of one.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "prior_file.hpp"
#include "shear_frame.hpp"
#include "storage/inference_data.hpp"
#include "tmcmc/sampler.hpp"

namespace examples {

/// A log-likelihood, its prior, and what is known of both.
struct Model {
  /// One for each column of the points.
  std::vector<std::string> parameter_names;
  /// Of the parameters in the same order.
  tmcmc::Prior prior;
  /// Of a batch of points.
  tmcmc::LogLikelihood log_likelihood;
  /// One line that names all that the values depend on, for the checkpoint.
  std::string description;
  /// The frame with its observations; none of another program.
  std::optional<FrameLikelihood> frame;
};

/// Where a model and its data are.
struct ModelOptions {
  /// Measured natural frequencies; with a command, a file that the program reads.
  std::string observations = {};
  /// Whether they are the reader's own, and not those of data/examples.
  bool has_own_observations = false;
  /// Distributions of the parameters, and the correlations between them if there are any.
  experiments::PriorFiles prior = {};
  /// Program that computes the log-likelihoods of a batch; empty: none. Without any of the three: the shear frame.
  std::string command = {};
  /// Program that keeps running and answers lines with lines; empty: none.
  std::string worker = {};
  /// Address of a UM-Bridge server; empty: none. With own observations its outputs are compared with them.
  std::string um_bridge = {};
  /// Name of the model on that server.
  std::string model = {};
  /// Limit of one call of the program, s; 0: none.
  double timeout_seconds = 0.0;
  /// Most calls of the program at a time.
  int parallel = 1;
  /// Most points of a call of the program; 0: as many as the batch has for each of the calls at a time.
  long batch = 0;
  /// Told what the user should know while the run goes.
  std::function<void(const std::string&)> note = [](const std::string&) {};
  /// Whether the names have to be those of variables in a NetCDF file.
  bool for_netcdf = false;
};

/// Whether the model is another program.
[[nodiscard]] bool is_other_program(const ModelOptions& options);

/// The program of the options, called several times at a time, or the shear frame.
/// \throws std::invalid_argument for more than one program, or a server without a name of a model;
///         io::InputError naming file, line, column and value; models::ModelError if the program
///         cannot be run.
[[nodiscard]] Model make_model(const ModelOptions& options);

/// Samples, stages and observations in the layout of ArviZ.
[[nodiscard]] storage::InferenceData inference_data(const tmcmc::Result& result, const Model& model,
                                                    std::uint64_t seed);

}  // namespace examples
