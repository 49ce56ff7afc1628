/// \file
/// The sampler on problems with known evidence, over many runs with a given number of evaluations.
#pragma once

#include "replication/benchmark_problems.hpp"
#include "replication/study.hpp"

namespace replication {

/// The samplers that the benchmark compares, each with the same number of evaluations.
enum class BenchmarkSampler {
  /// The paper's, N_eff = N/2 and N = evaluations / 31: 31 000 evaluations are ten of its stages.
  published,
  /// tmcmc::recommended_moves().
  better_moves,
  /// tmcmc::recommended_options(): measured by independent draws.
  recommended
};

/// Name of the sampler as used in the tables.
[[nodiscard]] const char* describe(BenchmarkSampler sampler);

/// The log-evidence estimated by one run, and its errors.
struct BenchmarkRun {
  /// Estimated minus exact log-evidence.
  double error = 0.0;
  /// Standard error stated by the run.
  double standard_error = 0.0;
  /// Equivalent independent draws; smallest over the parameters.
  double effective_draws = 0.0;
  /// Largest error of the mass of a mode.
  double worst_mode_mass = 0.0;
  /// Whether the run gave a warning.
  bool warned = false;
  /// Whether the run reached the posterior.
  bool finished = true;
};

/// Errors of the runs. Runs that have not reached the posterior count only in `unfinished` and
/// `warned`.
struct BenchmarkScore {
  /// Root-mean-square error of the log-evidence.
  double rms_error = 0.0;
  /// Mean error of the log-evidence.
  double bias = 0.0;
  /// Root mean square of error / stated standard error.
  double rms_z = 0.0;
  /// Largest |error| / stated standard error.
  double worst_z = 0.0;
  /// The same over runs without a warning.
  double worst_z_without_warning = 0.0;
  /// Share of the runs with a warning.
  double warned = 0.0;
  /// Mean over the runs.
  double effective_draws = 0.0;
  /// Share of the runs that ended before beta = 1 or with an error.
  double unfinished = 0.0;
  /// Share of the runs whose mode masses are all within 0.05.
  double mode_masses_found = 0.0;
};

/// Runs 0 to runs - 1 of the seed, with `arm` as the arm of their streams; the result does not
/// depend on the number of threads.
/// \throws errors::InvalidValue for too few evaluations.
[[nodiscard]] std::vector<BenchmarkRun> benchmark_runs(const BenchmarkProblem& problem,
                                                       BenchmarkSampler sampler, tmcmc::Index evaluations,
                                                       std::uint32_t arm, const StudyOptions& options,
                                                       const RunObserver& observer = {});

/// \throws errors::InvalidValue if there is no run.
[[nodiscard]] BenchmarkScore score(const std::vector<BenchmarkRun>& runs);

}  // namespace replication
