/// \file
/// A log-likelihood that is another program: a script in Python or MATLAB, a finite-element code.
///
/// The program is called once a batch as
///
///     PROGRAM points.csv log_likelihoods.csv
///
/// without a shell, in a directory of its own that is removed afterwards (io::ScratchDirectory); its standard output goes to standard error. It reads
/// the first file, a header with the names of the parameters and a row per point, and writes the second, a column
/// `log_likelihood` with a row per point in the same order: decimal numbers, or -inf where the model excludes the point. If it
/// writes columns with names of parameters too, these have to repeat the points, so that rows in another order are seen. A model
/// with outputs writes a column for each of them, of any name, in the order of the observations.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace io {
class CsvTable;
}

namespace models {

/// What is called, and how long it may take.
struct ProgramOptions {
  std::string program;                       ///< path of the executable; no search along PATH
  std::vector<std::string> parameter_names;  ///< header of the points, d names
  double timeout_seconds = 0.0;              ///< of one call; 0: no limit
  std::size_t outputs = 0;  ///< columns that it writes besides those of parameters; 0: `log_likelihood`
};

/// The program as a function of a batch of points, in the form of tmcmc::LogLikelihood. May be called by several threads.
class Program {
 public:
  /// \throws errors::InvalidValue for no parameter or a timeout that is negative or not finite; ModelError if the program
  ///         is not an executable file.
  explicit Program(ProgramOptions options);

  /// \param points  n x d
  /// \param log_likelihood  n, overwritten
  /// \throws ModelError if the program cannot be started, ends with another status than 0 or by a signal, exceeds the time
  ///         (it and its process group are killed), or writes no file, other than n rows, a cell that is neither a number nor minus infinity, or
  ///         parameters other than those of the row's point;
  ///         io::OutputError if the points cannot be written; io::Interrupted as run_child.
  void operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                  Eigen::Ref<Eigen::VectorXd> log_likelihood) const;

  /// The same of a program that writes its outputs in the place of log-likelihoods, for models::gaussian_likelihood.
  /// \param values  n x outputs, or n x 1 for the log-likelihood; overwritten
  void evaluate(const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::MatrixXd> values) const;

 private:
  [[nodiscard]] std::vector<std::string> columns_in(const io::CsvTable& table) const;

  ProgramOptions options_;
};

}  // namespace models
