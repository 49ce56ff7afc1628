/// \file
/// The accuracy of a sampler over many runs, measured against a known posterior.
#pragma once

#include <vector>

#include "estimation/exact_posterior.hpp"
#include "replication/study.hpp"

namespace replication {

/// The known properties of a posterior.
struct KnownPosterior {
  /// One entry per parameter.
  Eigen::VectorXd mean;
  /// One entry per parameter, positive.
  Eigen::VectorXd standard_deviation;
  /// log P(D).
  double log_evidence = 0.0;
};

/// The properties of the exact posterior as computed by quadrature.
[[nodiscard]] KnownPosterior known_posterior(const estimation::ExactPosterior& exact);

/// Errors over the runs. Errors of means are in units of posterior standard deviations.
struct Accuracy {
  /// Log-likelihoods, mean over the runs.
  double evaluations = 0.0;
  /// Largest over the runs.
  tmcmc::Index most_evaluations = 0;
  /// Mean over the runs.
  double stages = 0.0;
  /// Mean over the runs of (mean of a run - truth).
  Eigen::VectorXd mean_bias;
  /// Standard deviation over the runs of the mean of a run.
  Eigen::VectorXd mean_spread;
  /// Draws with the same mean-square error: 1 / (bias^2 + spread^2).
  Eigen::VectorXd effective_size;
  /// Bias of the estimate that the options select: the bridge estimate with Options::diagnose,
  /// otherwise the sum of log-mean weights.
  double evidence_bias = 0.0;
  /// Root-mean-square error of the log-evidence.
  double evidence_rms = 0.0;
  /// The same for the sum of log-mean weights.
  double weight_evidence_rms = 0.0;
  /// Root-mean-square of the runs' own standard errors; NaN without diagnose.
  double standard_error_rms = 0.0;
  /// Fraction of the runs with a warning.
  double warned = 0.0;
};

/// \throws errors::InvalidValue unless there are at least two runs, with as many parameters as the
///         known posterior.
[[nodiscard]] Accuracy accuracy(const std::vector<Run>& runs, const KnownPosterior& truth);

/// One sampler of the comparison: which setting differs from the published one, and its value.
struct Configuration {
  /// Name of the group: what is varied.
  std::string family;
  /// Value of what is varied.
  std::string value;
  /// Complete options of the sampler.
  tmcmc::Options options;
};

/// P-box areas of a study, one entry per parameter. From weighted samples 1000 are drawn for each
/// run by multinomial resampling, as many as the paper's runs have, so that their p-box has the
/// area of independent draws and no less. This is repeated ten times, each time with its own area,
/// since the area of 1000 draws scatters more than the effect that it is meant to show.
/// \param runs  runs of the study options.study and of the arm
[[nodiscard]] std::vector<Eigen::VectorXd> paper_sized_areas(const std::vector<Run>& runs,
                                                             std::uint32_t arm_index,
                                                             const StudyOptions& options);

/// The settings that the comparison of cost and accuracy covers: single changes to `published`,
/// then accumulated changes of the moves, then the best of these and the recommended options, under
/// either rule, for several budgets. All with Options::diagnose.
/// \param published  the sampler of the paper (N = 1000, N_eff = N/2, 3 steps)
[[nodiscard]] std::vector<Configuration> configurations(const tmcmc::Options& published);

}  // namespace replication
