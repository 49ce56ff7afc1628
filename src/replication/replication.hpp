/// \file
/// The whole study many times over: what one study reports, K times, so that every printed number has a distribution.
#pragma once

#include <string>

#include "replication/study.hpp"

namespace replication {

/// What one study reports of one sampler; vectors have one entry per parameter.
struct StudySummary {
  std::uint32_t study = 0;              ///< number of the study in its random streams
  std::string sampler;                  ///< name of the arm
  std::vector<double> areas;            ///< of the p-boxes (Eq. 25)
  std::vector<double> means;            ///< mean over the runs of the posterior means
  std::vector<double> standard_errors;  ///< standard deviation over the runs of the posterior means
  std::vector<double> smallest;         ///< smallest and largest sample of all runs: the ends of the p-box
  std::vector<double> largest;          ///< see smallest
  double log_evidence_mean = 0.0;       ///< over the runs
  double log_evidence_sd = 0.0;         ///< over the runs (N - 1)
  std::map<tmcmc::Index, tmcmc::Index> iterations;  ///< number of runs by number of iterations

  /// Equal in every number, to the last bit.
  friend bool operator==(const StudySummary&, const StudySummary&) = default;
};

/// \param threads  the summary does not depend on it
[[nodiscard]] StudySummary summarise(std::uint32_t study, const std::string& sampler,
                                     const std::vector<Run>& runs, int threads = 1);

/// One study of all arms.
/// \throws as run_arm.
[[nodiscard]] std::vector<StudySummary> run_study(const tmcmc::Problem& problem, const std::vector<Arm>& arms,
                                                  const StudyOptions& options);

/// Everything but the number of the study that its summaries depend on, as one line: a journal goes on only under the same.
[[nodiscard]] std::string study_key(const Reading& reading, const std::vector<Arm>& arms,
                                    const StudyOptions& options, const friction::Observations& observations,
                                    const tmcmc::BoxPrior& prior);

/// "9:2 10:45 11:3": number of iterations and of runs.
[[nodiscard]] std::string format_iterations(const std::map<tmcmc::Index, tmcmc::Index>& counts);

/// \throws errors::InvalidValue unless the text has the form of format_iterations, each number of iterations once and at
///         least 1, with 1 to 1000000 runs.
[[nodiscard]] std::map<tmcmc::Index, tmcmc::Index> parse_iterations(const std::string& text);

}  // namespace replication
