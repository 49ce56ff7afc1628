/// \file
/// Command lines of the experiments: options that they share, and exit statuses.
///
/// Status 0: done. 1: the computation failed. 2: bad input or an output that cannot be written.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "distributed/ranks.hpp"
#include "io/csv.hpp"
#include "io/progress.hpp"
#include "study/reading.hpp"
#include "study/study.hpp"

namespace experiments {

/// What every experiment has: --help, --version, --show-options, --quiet, --output.
class Program {
 public:
  Program(const std::string& name, const std::string& purpose);

  /// For a program that mpirun may start as several ranks, which share out its work: one of them speaks.
  Program(const std::string& name, const std::string& purpose, distributed::Ranks& ranks);

  ~Program();  // out of line, as add_input: else each experiment compiles most of CLI11 once more
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  CLI::App& app() { return app_; }

  /// Adds an option for a CSV file that is read.
  CLI::Option* add_input(const std::string& option, std::string& path, const std::string& description);

  /// Adds --output, a CSV file ("-": standard output). Without it no file is written.
  void add_output(const std::string& description);
  /// Adds a further output file.
  void add_file_output(const std::string& option, std::string& path, const std::string& description);

  [[nodiscard]] const std::string& output() const { return output_; }
  void set_default_output(const std::string& path) { output_ = path; }
  [[nodiscard]] bool quiet() const { return quiet_; }

  /// Parses, calls body, and turns errors into one line on stderr and an exit status.
  int run(int argc, char** argv, const std::function<void()>& body);

  /// Part of the report, to stdout (to stderr if stdout carries a CSV); nothing with --quiet. One that cannot be written
  /// does not stop the work: the exit status tells.
  template <class... Args>
  void report(fmt::format_string<Args...> format, Args&&... args) const {
    if (!quiet_ && leads()) {
      const std::string text = fmt::format(format, std::forward<Args>(args)...);
      std::fwrite(text.data(), 1, text.size(), output_ == "-" ? stderr : stdout);
    }
  }

 private:
  void check_paths() const;
  [[nodiscard]] bool leads() const { return ranks_ == nullptr || ranks_->rank() == 0; }

  CLI::App app_;
  std::string output_;
  bool quiet_ = false;
  bool show_options_ = false;
  distributed::Ranks* ranks_ = nullptr;
};

/// The CSV file of an optional output; none if the path is empty.
/// \throws io::OutputError if it cannot be opened.
[[nodiscard]] std::optional<io::CsvWriter> open_csv(const std::string& path,
                                                    const std::vector<std::string>& columns);

/// A number with so many significant digits as do not depend on the C library, for results of Ceres and of special
/// functions; "nan" unless it is finite.
[[nodiscard]] std::string digits(double value, int significant = 10);

/// --reading, the physics behind it option by option, --driving-force.
struct PhysicsOptions {
  std::string reading_name = "as_published";
  std::optional<std::string> limit;
  std::optional<std::string> phase;
  std::optional<double> infeasible_log_likelihood;
  double driving_force_n = 2.5;

  void add_to(CLI::App& app);
  /// --driving-force alone.
  void add_driving_force_to(CLI::App& app);
  /// The reading with the options applied.
  [[nodiscard]] study::Reading reading() const;
};

/// The sampler behind --reading, option by option; or the recommended one, with the same options.
struct SamplerOptions {
  std::optional<std::string> deviation, counted, move, centre, boundary;
  std::optional<std::string> sampler, resampling, scale_rule, coordinates, random_subsets, cross_fit;
  std::optional<long> samples, chains, move_steps, max_move_steps, max_stages, evaluation_budget;
  std::optional<double> proposal_scale, minimum_step, mixing_correlation, target_acceptance,
      independent_fraction;
  double cov_target = 1.0;
  double ess_fraction = 0.5;
  bool diagnose = false;

  void add_to(CLI::App& app);
  /// Replaces the sampler of the reading as the options say. Kind and target of the criterion, which belong to the two
  /// samplers that are compared, are not touched (study::paper_arms).
  /// \throws std::invalid_argument naming the option, for values that do not go together.
  void apply(study::Reading& reading) const;
};

/// --runs, --seed, --threads.
struct RunOptions {
  long runs = 50;
  std::uint64_t seed = 1;
  int threads = 0;  ///< 0: as many as the machine has

  void add_to(CLI::App& app, long least_runs = 1);
  void add_seed_to(CLI::App& app);
  void add_threads_to(CLI::App& app);
  [[nodiscard]] study::StudyOptions study_options() const;
};

}  // namespace experiments
