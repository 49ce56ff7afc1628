/// \file
/// The whole study repeated K times, so that every printed number has a distribution.
#pragma once

#include <string>

#include "replication/study.hpp"

namespace replication {

/// The results of one study for one sampler; vectors have one entry per parameter.
struct StudySummary {
  /// Number of the study in its random streams.
  std::uint32_t study = 0;
  /// Name of the arm.
  std::string sampler;
  /// Areas of the p-boxes (Eq. 25).
  std::vector<double> areas;
  /// Mean over the runs of the posterior means.
  std::vector<double> means;
  /// Standard deviation over the runs of the posterior means.
  std::vector<double> standard_errors;
  /// Smallest sample of all runs: lower end of the p-box.
  std::vector<double> smallest;
  /// Largest sample of all runs: upper end of the p-box.
  std::vector<double> largest;
  /// Mean over the runs.
  double log_evidence_mean = 0.0;
  /// Standard deviation over the runs (N - 1).
  double log_evidence_sd = 0.0;
  /// Number of runs by number of iterations.
  std::map<tmcmc::Index, tmcmc::Index> iterations;

  /// Whether two summaries are equal in every number, bit for bit.
  friend bool operator==(const StudySummary&, const StudySummary&) = default;
};

/// \param threads  number of threads; the summary does not depend on it
[[nodiscard]] StudySummary summarise(std::uint32_t study, const std::string& sampler,
                                     const std::vector<Run>& runs, int threads = 1);

/// One study of all arms.
/// \throws as run_arm.
[[nodiscard]] std::vector<StudySummary> run_study(const tmcmc::Problem& problem, const std::vector<Arm>& arms,
                                                  const StudyOptions& options);

/// All settings on which the summaries of a study depend, except its number, as one line: a journal
/// is resumed only under the same key.
[[nodiscard]] std::string study_key(const Reading& reading, const std::vector<Arm>& arms,
                                    const StudyOptions& options, const friction::Observations& observations,
                                    const tmcmc::BoxPrior& prior);

/// Text such as "9:2 10:45 11:3": pairs of a number of iterations and its number of runs.
[[nodiscard]] std::string format_iterations(const std::map<tmcmc::Index, tmcmc::Index>& counts);

/// Reads the text of format_iterations.
/// \throws errors::InvalidValue unless the text has the form of format_iterations, with each number
///         of iterations occurring once and at least 1, and with 1 to 1000000 runs each.
[[nodiscard]] std::map<tmcmc::Index, tmcmc::Index> parse_iterations(const std::string& text);

}  // namespace replication
