/// \file
/// A log-likelihood computed by a program that keeps running: it is started once, or once for each
/// concurrent call, and answers batch after batch, so that the cost of its start, such as an import
/// of NumPy or a licence, is paid once.
///
/// The program is started without a shell, in a directory of its own (io::ScratchDirectory), with
/// the names of the parameters as its arguments. For a batch of n points it reads n + 1 lines from
/// its standard input: n, then the coordinates of each point, separated by commas. It writes n
/// lines to its standard output, one log-likelihood each in the order of the points, a decimal
/// number or -inf, and must flush them. It ends when its standard input does.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace models {

/// Which program is started, and how long a batch may take.
struct WorkerOptions {
  /// Path of the executable; no search along PATH.
  std::string program;
  /// d names.
  std::vector<std::string> parameter_names;
  /// Limit of one batch; 0: no limit.
  double timeout_seconds = 0.0;
  /// Called, from any thread, with a one-line reason when a worker is started to replace another.
  std::function<void(const std::string& reason)> on_restart = [](const std::string&) {};
  /// Comma-separated numbers per line that it writes; 0: one number, the log-likelihood.
  std::size_t outputs = 0;
};

/// The workers as a function of a batch of points, in the form of tmcmc::LogLikelihood. May be
/// called concurrently: as many workers run as there are concurrent calls
/// (models::parallel_batches). Copies share the workers, which end with the last copy.
class Worker {
 public:
  /// \throws errors::InvalidValue if there is no parameter, or if the time-out is negative or not
  ///         finite; ModelError if the program is not an executable file.
  explicit Worker(WorkerOptions options);

  /// Evaluates a batch. A worker that dies is replaced once, and the batch is repeated.
  /// \param points  n x d, one row per point
  /// \param log_likelihood  n values, overwritten
  /// \throws ModelError, naming a point, if the program cannot be started, dies twice at this
  ///         batch, exceeds the time limit (it and its process group are killed), or writes a line
  ///         that is neither a number nor -inf, or more lines than points; io::Interrupted if a
  ///         signal has been received: the process groups of all workers are killed with the last
  ///         copy of this object.
  void operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                  Eigen::Ref<Eigen::VectorXd> log_likelihood) const;

  /// As operator(), for a worker that writes its outputs instead of log-likelihoods, for
  /// models::gaussian_likelihood.
  /// \param values  n x outputs, or n x 1 for the log-likelihood; overwritten
  void evaluate(const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::MatrixXd> values) const;

  /// Number of workers that were started to replace one that had died.
  [[nodiscard]] long restarts() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace models
