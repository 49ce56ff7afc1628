/// \file
/// The whole study repeated K times, so that every printed number has a distribution.
#pragma once

#include <string>

#include "replication/study.hpp"

namespace replication {

/// The results of one study for one sampler; vectors have one entry per parameter.
struct StudySummary {
  std::uint32_t study = 0;              ///< number of the study in its random streams
  std::string sampler;                  ///< name of the arm
  std::vector<double> areas;            ///< areas of the p-boxes (Eq. 25)
  std::vector<double> means;            ///< mean over the runs of the posterior means
  std::vector<double> standard_errors;  ///< standard deviation over the runs of the posterior means
  std::vector<double> smallest;         ///< smallest sample of all runs: lower end of the p-box
  std::vector<double> largest;          ///< largest sample of all runs: upper end of the p-box
  double log_evidence_mean = 0.0;       ///< mean over the runs
  double log_evidence_sd = 0.0;         ///< standard deviation over the runs (N - 1)
  std::map<tmcmc::Index, tmcmc::Index> iterations;  ///< number of runs by number of iterations

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

/// All settings on which the summaries of a study depend, except its number, as one line: a journal is
/// resumed only under the same key.
[[nodiscard]] std::string study_key(const Reading& reading, const std::vector<Arm>& arms,
                                    const StudyOptions& options, const friction::Observations& observations,
                                    const tmcmc::BoxPrior& prior);

/// Text such as "9:2 10:45 11:3": pairs of a number of iterations and its number of runs.
[[nodiscard]] std::string format_iterations(const std::map<tmcmc::Index, tmcmc::Index>& counts);

/// Reads the text of format_iterations.
/// \throws errors::InvalidValue unless the text has the form of format_iterations, with each number of
///         iterations occurring once and at least 1, and with 1 to 1000000 runs each.
[[nodiscard]] std::map<tmcmc::Index, tmcmc::Index> parse_iterations(const std::string& text);

}  // namespace replication
