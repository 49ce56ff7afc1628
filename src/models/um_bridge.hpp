/// \file
/// A log-likelihood behind UM-Bridge (Seelinger et al. 2023, J. Open Source Software 8(83), 4748): a model that answers HTTP
/// requests of the protocol's version 1.0, one point a request, on this machine or behind the load balancer of a cluster.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "models/json_connection.hpp"

namespace models {

/// Which model, and how many outputs it has.
struct UmBridgeOptions {
  ServerOptions server;  ///< where it is; retries and time-out of one evaluation
  std::string model;     ///< its name, one of those that /Info lists
  std::vector<std::string>
      parameter_names;        ///< d names; the coordinates in this order fill the model's input vectors
  std::string config = "{}";  ///< JSON object that is passed to the model
  std::size_t outputs = 0;    ///< all of its output vectors together; 0: the one output is the log-likelihood
};

/// The model as a function of a batch of points, in the form of tmcmc::LogLikelihood. May be called by several threads: each call
/// has a connection of its own and sends its points one after the other (models::parallel_batches sends several at a time).
class UmBridge {
 public:
  /// Asks the server for its models and for the sizes of inputs and outputs.
  /// \throws errors::InvalidValue for invalid options; ModelError if the server cannot be reached, speaks another version of
  ///         the protocol, has no such model, or if its inputs are not d, and its outputs not as many as the options say.
  explicit UmBridge(UmBridgeOptions options);

  /// \param points  n x d
  /// \param log_likelihood  n, overwritten
  /// \throws ModelError as JsonConnection::post, and for outputs of other sizes than announced or that are no numbers, naming
  ///         the point; io::Interrupted if a signal has come.
  void operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                  Eigen::Ref<Eigen::VectorXd> log_likelihood) const;

  /// The same with the outputs of the model in the place of log-likelihoods, for models::gaussian_likelihood.
  /// \param values  n x outputs, or n x 1 for the log-likelihood; overwritten
  void evaluate(const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::MatrixXd> values) const;

  /// Requests that were repeated after a lost connection, in all calls that have ended.
  [[nodiscard]] long repeated_requests() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace models
