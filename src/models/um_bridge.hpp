/// \file
/// A log-likelihood behind UM-Bridge (Seelinger et al. 2023, J. Open Source Software 8(83), 4748):
/// a model that answers HTTP requests of version 1.0 of the protocol, one point per request, on
/// this machine or behind the load balancer of a cluster.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "models/json_connection.hpp"

namespace models {

/// Which model is used, and how many outputs it has.
struct UmBridgeOptions {
  /// The server; retries and time-out of one evaluation.
  ServerOptions server;
  /// Name of the model, as listed by /Info.
  std::string model;
  std::vector<std::string>
      /// d names; the coordinates in this order fill the model's input vectors.
      parameter_names;
  /// JSON object that is passed to the model.
  std::string config = "{}";
  /// Total length of its output vectors; 0: its one output is the log-likelihood.
  std::size_t outputs = 0;
};

/// The model as a function of a batch of points, in the form of tmcmc::LogLikelihood. May be called
/// concurrently: each call has its own connection and sends its points one after the other
/// (models::parallel_batches sends several at a time).
class UmBridge {
 public:
  /// Asks the server for its models and for the sizes of their inputs and outputs.
  /// \throws errors::InvalidValue for invalid options; ModelError if the server cannot be reached,
  ///         uses another version of the protocol, does not have the model, or if the number of
  ///         inputs is not d or the number of outputs differs from the options.
  explicit UmBridge(UmBridgeOptions options);

  /// \param points  n x d, one row per point
  /// \param log_likelihood  n values, overwritten
  /// \throws ModelError as JsonConnection::post, and, naming the point, for outputs whose sizes
  ///         differ from those announced or that are not numbers; io::Interrupted if a signal has
  ///         been received.
  void operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                  Eigen::Ref<Eigen::VectorXd> log_likelihood) const;

  /// As operator(), for the outputs of the model instead of log-likelihoods, for
  /// models::gaussian_likelihood.
  /// \param values  n x outputs, or n x 1 for the log-likelihood; overwritten
  void evaluate(const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::MatrixXd> values) const;

  /// Number of requests that were repeated after a lost connection, in all calls that have ended.
  [[nodiscard]] long repeated_requests() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace models
