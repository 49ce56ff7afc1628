/// \file
/// A log-likelihood that is a program which keeps running: it is started once, or once for each call at a time, and answers batch
/// after batch, so that its start, an import of NumPy or a licence, is paid once.
///
/// The program is started without a shell, in a directory of its own (io::ScratchDirectory), with the names of the parameters as
/// its arguments. For a batch of n points it gets n + 1 lines on its standard input: n, then the coordinates of each point,
/// with commas between them. It writes n lines to its standard output, one log-likelihood each in the order of the points, a
/// decimal number or -inf, and has to flush them. It ends when its standard input does.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace models {

/// What is started, and how long it may take.
struct WorkerOptions {
  std::string program;                       ///< path of the executable; no search along PATH
  std::vector<std::string> parameter_names;  ///< d names
  double timeout_seconds = 0.0;              ///< of one batch; 0: no limit
  /// Told in one line, from any thread, why a worker is started in the place of another.
  std::function<void(const std::string& reason)> on_restart = [](const std::string&) {};
  std::size_t outputs =
      0;  ///< numbers of a line that it writes, with commas between them; 0: one, the log-likelihood
};

/// The workers as a function of a batch of points, in the form of tmcmc::LogLikelihood. May be called by several threads: as many
/// workers run as there are calls at a time (models::parallel_batches). Copies share them; they end with the last copy.
class Worker {
 public:
  /// \throws errors::InvalidValue for no parameter or a time-out that is negative or not finite; ModelError if the program is not
  ///         an executable file.
  explicit Worker(WorkerOptions options);

  /// A worker that dies is replaced once, and the batch repeated.
  /// \param points  n x d
  /// \param log_likelihood  n, overwritten
  /// \throws ModelError, naming a point, if the program cannot be started, dies twice at this batch, takes longer than the time-out (it and
  ///         its process group are killed), or writes a line that is neither a number nor -inf, or more lines than points;
  ///         io::Interrupted if a signal has come: the process groups of all workers are killed with the last copy of this.
  void operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                  Eigen::Ref<Eigen::VectorXd> log_likelihood) const;

  /// The same of a worker that writes its outputs in the place of log-likelihoods, for models::gaussian_likelihood.
  /// \param values  n x outputs, or n x 1 for the log-likelihood; overwritten
  void evaluate(const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::MatrixXd> values) const;

  /// Workers that were started in the place of one that had died.
  [[nodiscard]] long restarts() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace models
