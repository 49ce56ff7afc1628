/// \file
/// What surrounds the work of an executable: its report, its output files and
/// its exit status. The options are CLI11's and stand in the mains.
///
/// Status 0: done. 1: the computation failed. 2: bad input or an output that
/// cannot be written.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "io/progress.hpp"
#include "tmcmc/sampler.hpp"

namespace command_line {

/// The report of an executable, and the options that all have: --version,
/// --quiet, --show-options.
class Report {
 public:
  /// Adds the options to the command line. The report must outlive it.
  explicit Report(CLI::App& app);
  Report(const Report&) = delete;
  Report& operator=(const Report&) = delete;

  /// Part of the report, without control characters, to standard output (to
  /// standard error if an output is written there); nothing with --quiet. One
  /// that cannot be written does not stop the work: the exit status tells.
  template <class... Args>
  void operator()(fmt::format_string<Args...> format, Args&&... args) const {
    if (!is_quiet_ && !is_silent_) {
      print(fmt::format(format, std::forward<Args>(args)...));
    }
  }

  /// Whether --quiet was given.
  [[nodiscard]] bool quiet() const { return is_quiet_; }
  /// From here on neither report nor warning nor error is printed: what mpirun
  /// has started besides the rank that speaks.
  void be_silent();

  /// Parses the command line, calls the body, and turns what it throws into one
  /// line on standard error and an exit status. When a signal has come, one
  /// line says what is kept, and the process dies by the signal
  /// (io::catch_interrupts).
  int run(int argc, char** argv, const std::function<void()>& body);

 private:
  int run_to_end(int argc, char** argv, const std::function<void()>& body);
  void print(std::string text) const;

  CLI::App& app_;
  bool is_quiet_ = false;
  bool shows_options_ = false;
  bool writes_to_stdout_ = false;
  bool is_silent_ = false;
};

/// One line, "warning: ...", on standard error, unless a report is silent.
void warn(const std::string& text);

/// Adds an option for a file that is written ("-": standard output), never one
/// that another option reads or writes.
CLI::Option* add_output(CLI::App& app, const std::string& option, std::string& path,
                        const std::string& description);
/// Adds --output; without it no file is written.
CLI::Option* add_output(CLI::App& app, std::string& path, const std::string& description);
/// Adds an option for a CSV file that is read.
CLI::Option* add_input(CLI::App& app, const std::string& option, std::string& path,
                       const std::string& description);

/// A CSV file, or none.
struct OptionalCsv : std::optional<io::CsvWriter> {
  using std::optional<io::CsvWriter>::optional;
  /// Writes a row as io::CsvWriter does, if there is a file.
  template <class... Cells>
  void row(const Cells&... cells) {
    if (has_value()) {
      (*this)->row(cells...);
    }
  }
};

/// The CSV file of an output; none if the path is empty.
/// \throws io::OutputError if it cannot be opened.
[[nodiscard]] OptionalCsv open_csv(const std::string& path, const std::vector<std::string>& columns);

/// The same problem; each call of the log-likelihood, and of Problem::look between them, is a place
/// where the program can be interrupted. Both throw io::Interrupted then.
[[nodiscard]] tmcmc::Problem interruptible(tmcmc::Problem problem);

/// A number with so many significant digits as do not depend on the C library,
/// for results of Ceres and of special functions; "nan" unless it is finite.
[[nodiscard]] std::string digits(double value, int significant = 10);
/// A number of a report in the format given; "undefined" for NaN.
[[nodiscard]] std::string or_undefined(fmt::format_string<const double&> format, double value);

}  // namespace command_line
