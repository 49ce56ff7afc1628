/// \file
/// Options that several executables share, as values with the functions that add them to a command
/// line.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "command_line/checks.hpp"
#include "command_line/report.hpp"
#include "replication/reading.hpp"
#include "replication/study.hpp"
#include "replication/synthetic.hpp"
#include "statistics/deviance_test.hpp"

namespace experiments {

using namespace command_line;

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

  void add_to(CLI::App& app);
  /// Replaces the sampler of the reading as the options say. Kind and target of the criterion,
  /// which belong to the two samplers that are compared, are not touched (replication::paper_arms).
  /// \throws errors::InvalidValue naming the option, for values that are incompatible.
  void apply(replication::Reading& reading) const;
};

/// The truth of synthetic observations, option by option.
struct TruthOptions {
  replication::Truth truth;

  void add_to(CLI::App& app);
  /// Whether one of the options was given.
  [[nodiscard]] static bool is_given(const CLI::App& app);
};

/// --tables.
struct TableOptions {
  statistics::TableDraws draws;

  void add_to(CLI::App& app);
};

/// --runs, --seed, --threads.
struct RunOptions {
  long runs = 50;
  std::uint64_t seed = 1;
  /// 0: as many as the machine has.
  int threads = 0;

  void add_to(CLI::App& app, long least_runs = 1);
  void add_seed_to(CLI::App& app);
  void add_threads_to(CLI::App& app);
  [[nodiscard]] replication::StudyOptions study_options() const;
};

}  // namespace experiments
