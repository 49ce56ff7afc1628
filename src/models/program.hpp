/// \file
/// A log-likelihood computed by another program: a script in Python or MATLAB, a finite-element
/// code.
///
/// The program is called once per batch as
///
///     PROGRAM points.csv log_likelihoods.csv
///
/// without a shell, in a directory of its own that is removed afterwards (io::ScratchDirectory);
/// its standard output is sent to standard error. It reads the first file, which has a header with
/// the names of the parameters and one row per point, and writes the second, which has a column
/// `log_likelihood` with one row per point in the same order: decimal numbers, or -inf where the
/// model excludes the point. If it also writes columns with names of parameters, these must repeat
/// the points, so that a changed order of rows is detected. A model with outputs writes one column
/// per output, with any name, in the order of the observations.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace io {
class CsvTable;
}

namespace models {

/// Which program is called, and how long a call may take.
struct ProgramOptions {
  /// Path of the executable; no search along PATH.
  std::string program;
  /// Header of the points, d names.
  std::vector<std::string> parameter_names;
  /// Limit of one call; 0: no limit.
  double timeout_seconds = 0.0;
  /// Columns written besides the parameters; 0: `log_likelihood`.
  std::size_t outputs = 0;
};

/// The program as a function of a batch of points, in the form of tmcmc::LogLikelihood. May be
/// called concurrently.
class Program {
 public:
  /// \throws errors::InvalidValue if there is no parameter, or if the time-out is negative or not
  ///         finite; ModelError if the program is not an executable file.
  explicit Program(ProgramOptions options);

  /// \param points  n x d, one row per point
  /// \param log_likelihood  n values, overwritten
  /// \throws ModelError if the program cannot be started, ends with a status other than 0 or by a
  ///         signal, exceeds the time limit (it and its process group are killed), or writes no
  ///         file, a number of rows other than n, a cell that is neither a number nor minus
  ///         infinity, or parameters other than those of the row's point; io::OutputError if the
  ///         points cannot be written; io::Interrupted as run_child.
  void operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                  Eigen::Ref<Eigen::VectorXd> log_likelihood) const;

  /// As operator(), for a program that writes its outputs instead of log-likelihoods, for
  /// models::gaussian_likelihood.
  /// \param values  n x outputs, or n x 1 for the log-likelihood; overwritten
  void evaluate(const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::MatrixXd> values) const;

 private:
  [[nodiscard]] std::vector<std::string> columns_in(const io::CsvTable& table) const;

  ProgramOptions options_;
};

}  // namespace models
