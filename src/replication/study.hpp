/// \file
/// A study: R independent runs of each sampler on one problem, and the statistics that the paper
/// reports.
#pragma once

#include <functional>
#include <map>

#include "pbox/pbox.hpp"
#include "replication/reading.hpp"
#include "statistics/summary.hpp"

namespace replication {

using statistics::Moments;
using statistics::moments;

/// Size of a study and its random streams.
struct StudyOptions {
  /// R, runs per sampler (Section 4 of the paper).
  tmcmc::Index runs = 50;
  /// Seed of the random streams.
  std::uint64_t seed = 1;
  /// Number of the study among its replications.
  std::uint32_t study = 0;
  /// Threads over the runs.
  int threads = 1;

  /// \throws errors::InvalidValue naming field, value and constraint.
  void validate() const;
};

/// One run: final samples, records of the stages, and moments.
struct Run {
  /// The result as the sampler returned it; samples may be weighted.
  tmcmc::Result result;
  /// Means of the final samples, one entry per parameter.
  Eigen::VectorXd mean;
  /// Standard deviations of the final samples (N - 1), one entry per parameter.
  Eigen::VectorXd standard_deviation;

  /// Number of stages, which Table 4 counts.
  [[nodiscard]] tmcmc::Index iterations() const { return static_cast<tmcmc::Index>(result.stages.size()); }
};

/// Called once after each run, possibly from several threads at a time.
using RunObserver = std::function<void()>;

/// One run of a study, with the random stream (seed, study, arm_index, index).
/// \param observer  observer of the run's populations, see tmcmc::run
/// \throws as run_arm.
[[nodiscard]] Run run_one(const tmcmc::Problem& problem, const Arm& arm, std::uint32_t arm_index,
                          const StudyOptions& options, tmcmc::Index index,
                          const tmcmc::Observer& observer = {});

/// R runs of one sampler; run i uses the stream (seed, study, arm, i).
/// \throws tmcmc::SamplingError naming sampler and run if a run fails or ends before beta = 1.
[[nodiscard]] std::vector<Run> run_arm(const tmcmc::Problem& problem, const Arm& arm, std::uint32_t arm_index,
                                       const StudyOptions& options, const RunObserver& observer = {});

/// Empirical distribution functions (weighted if the samples are) of a parameter, one per run.
[[nodiscard]] std::vector<pbox::Ecdf> ecdfs_of(const std::vector<Run>& runs, tmcmc::Index parameter);

/// Error, against an exact value, of a number that each run gives.
/// \param exact  without an exact value (0) the bias has no meaning
/// \throws errors::InvalidValue if there is no run.
[[nodiscard]] statistics::EstimateError error_over_runs(const std::vector<Run>& runs,
                                                        const std::function<double(const Run&)>& number,
                                                        double exact = 0.0);

/// Area (Eq. 25) of the p-box of the runs' ECDFs, one entry per parameter.
/// \param threads  threads over the parameters; the areas do not depend on the number
/// \throws errors::InvalidValue if there is no run.
[[nodiscard]] Eigen::VectorXd pbox_areas(const std::vector<Run>& runs, int threads = 1);

/// Number of runs that took each number of iterations (Table 4).
[[nodiscard]] std::map<tmcmc::Index, tmcmc::Index> iteration_counts(const std::vector<Run>& runs);

}  // namespace replication
