/// \file
/// Command lines of the experiments: options that they share, and exit statuses.
///
/// Status 0: done. 1: the computation failed. 2: bad input or an output that cannot be written.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/csv.hpp"
#include "io/progress.hpp"
#include "option_checks.hpp"
#include "replication/reading.hpp"
#include "replication/study.hpp"
#include "statistics/deviance_test.hpp"

namespace CLI {
class
    App;  // CLI11 is included by one source, which spares the experiments to compile most of it once more each
}

namespace experiments {

/// What every experiment has: --help, --version, --show-options, --quiet, --output; and the options of its own that are added,
/// as --name. An option without a value of its own keeps the value that the variable has when it is added.
class Program {
 public:
  Program(const std::string& name, const std::string& purpose);

  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// Adds an option for a double, long, int or std::uint64_t, or an optional one of the first two; --help lists it in the group.
  template <class Number>
  void add_number(const std::string& option, Number& value, const Check& check,
                  const std::string& description, const std::string& group = "Options");

  /// Adds an option for a word; --help calls its values `type`.
  void add_text(const std::string& option, std::string& value, const std::string& type,
                const std::string& description);

  /// Adds an option for one of the names.
  void add_choice(const std::string& option, std::string& value, const std::vector<std::string>& names,
                  const std::string& description, const std::string& group = "Options");
  /// The same of one that may be left out.
  void add_choice(const std::string& option, std::optional<std::string>& value,
                  const std::vector<std::string>& names, const std::string& description,
                  const std::string& group = "Reading, option by option");

  /// Adds an option for what the check accepts; --help calls its values `type`.
  void add_checked_text(const std::string& option, std::optional<std::string>& value, const std::string& type,
                        const Check& check, const std::string& description, const std::string& group);

  /// Adds an option without a value.
  void add_flag(const std::string& option, bool& value, const std::string& description,
                const std::string& group);

  /// Adds an option for a CSV file that is read.
  void add_input(const std::string& option, std::string& path, const std::string& description);
  /// The same of one that has to be given.
  void add_required_input(const std::string& option, std::string& path, const std::string& description);

  /// Adds --output, a CSV file ("-": standard output). Without it no file is written.
  void add_output(const std::string& description);
  /// The same with a default.
  void add_output(const std::string& description, const std::string& path);
  /// Adds a further output file.
  void add_file_output(const std::string& option, std::string& path, const std::string& description);

  [[nodiscard]] const std::string& output() const { return output_; }
  [[nodiscard]] bool quiet() const { return quiet_; }

  /// From here on it says nothing, neither report nor error: what mpirun has started besides the rank that speaks.
  void be_silent() { is_silent_ = true; }

  /// Parses, calls body, and turns errors into one line on stderr and an exit status. When a signal has come, one line
  /// says what is kept, and the process dies by the signal (io::catch_interrupts).
  int run(int argc, char** argv, const std::function<void()>& body);

  /// Names a file that is read without an option of its own: no output may be written to it.
  /// \throws std::invalid_argument if an option that was parsed says so.
  void add_read_file(const std::string& path);

  /// Part of the report, without control characters, to stdout (to stderr if stdout carries an output); nothing with --quiet. One that cannot be written
  /// does not stop the work: the exit status tells.
  template <class... Args>
  void report(fmt::format_string<Args...> format, Args&&... args) const {
    if (!quiet_ && !is_silent_) {
      print(fmt::format(format, std::forward<Args>(args)...));
    }
  }

 private:
  int run_to_end(int argc, char** argv, const std::function<void()>& body);
  void check_paths();
  void print(std::string text) const;

  std::unique_ptr<CLI::App> app_;
  std::string output_;
  bool quiet_ = false;
  bool show_options_ = false;
  bool writes_to_stdout_ = false;
  bool is_parsed_ = false;
  std::vector<std::string> read_files_;
  bool is_silent_ = false;
};

/// The same log-likelihood; each call is a place where the program can be interrupted.
/// \throws io::Interrupted when it is called.
[[nodiscard]] tmcmc::LogLikelihood interruptible(tmcmc::LogLikelihood log_likelihood);
[[nodiscard]] tmcmc::Problem interruptible(tmcmc::Problem problem);

/// The CSV file of an optional output; none if the path is empty.
/// \throws io::OutputError if it cannot be opened.
[[nodiscard]] std::optional<io::CsvWriter> open_csv(const std::string& path,
                                                    const std::vector<std::string>& columns);

/// A number with so many significant digits as do not depend on the C library, for results of Ceres and of special
/// functions; "nan" unless it is finite.
[[nodiscard]] std::string digits(double value, int significant = 10);

/// A number of a report in the format given; "undefined" for NaN.
[[nodiscard]] std::string or_undefined(fmt::format_string<const double&> format, double value);

/// --reading, the physics behind it option by option, --driving-force.
struct PhysicsOptions {
  std::string reading_name = "as_published";
  std::optional<std::string> limit;
  std::optional<std::string> phase;
  std::optional<double> infeasible_log_likelihood;
  double driving_force_n = 2.5;

  void add_to(Program& program);
  /// --driving-force alone.
  void add_driving_force_to(Program& program);
  /// The reading with the options applied.
  [[nodiscard]] replication::Reading reading() const;
};

/// The sampler behind --reading, option by option; or the recommended one, with the same options.
struct SamplerOptions {
  std::optional<std::string> sampler;
  /// What was given, by the name that the option has in tmcmc::option_table().
  std::map<std::string, std::optional<std::string>, std::less<>> values;
  [[nodiscard]] std::optional<std::string> given(std::string_view name) const;
  double cov_target = 1.0;
  double ess_fraction = 0.5;
  bool diagnose = false;

  void add_to(Program& program);
  /// Replaces the sampler of the reading as the options say. Kind and target of the criterion, which belong to the two
  /// samplers that are compared, are not touched (replication::paper_arms).
  /// \throws errors::InvalidValue naming the option, for values that are incompatible.
  void apply(replication::Reading& reading) const;
};

/// --tables.
struct TableOptions {
  statistics::TableDraws draws;

  void add_to(Program& program);
};

/// --runs, --seed, --threads.
struct RunOptions {
  long runs = 50;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has

  void add_to(Program& program, long least_runs = 1);
  void add_seed_to(Program& program);
  void add_threads_to(Program& program);
  [[nodiscard]] replication::StudyOptions study_options() const;
};

}  // namespace experiments
