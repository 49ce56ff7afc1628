/// \file
/// The two criteria are the same equation: N_eff = N / (1 + CoV^2), with the population standard
/// deviation, so that CoV = 100 % (Eq. 6) and N_eff = N/2 (Eq. 9) choose the same step. This is
/// shown on the populations of whole runs.
#pragma once

#include <span>
#include <vector>

#include "replication/reading.hpp"

namespace replication {

/// A stage of TMCMC, with the result of each rule for its population; N is the number of samples.
struct StageUnderBothRules {
  /// Tempering parameter before the step.
  double beta = 0.0;
  /// Step chosen by CoV, and taken by the run.
  double step_cov = 0.0;
  /// Step chosen by N_eff.
  double step_ess = 0.0;
  /// Step chosen by CoV with the N - 1 standard deviation.
  double step_cov_sample = 0.0;
  /// N_eff after step_cov.
  double effective_sample_size = 0.0;
  /// CoV after step_cov, with the population's standard deviation.
  double coefficient_of_variation = 0.0;
  /// N / (1 + CoV^2).
  double samples_over_one_plus_cov_squared = 0.0;
  /// N_eff after step_cov_sample.
  double effective_sample_size_sample = 0.0;
  /// Tempering parameter of the run of TMCMC after the stage.
  double beta_tmcmc = 0.0;
  /// TMCMC-II after as many stages; NaN if it has ended earlier.
  double beta_tmcmc_ii = 0.0;
};

/// A run of each sampler on the same random stream.
struct RunUnderBothRules {
  /// Stages of the run of TMCMC.
  std::vector<StageUnderBothRules> stages;
  /// Largest relative difference of beta; 1 if TMCMC-II has fewer stages.
  double path_difference = 0.0;
  /// Same number of stages, and no difference beyond rounding.
  bool is_same_path = false;
};

/// Runs both samplers, and solves each rule as written on each population of the first sampler.
/// \param by_cov, by_ess  options with a coefficient of variation (TMCMC) and an effective sample
///        size (TMCMC-II) as criterion
/// \param key  key of the random stream, the same for both samplers
/// \throws as tmcmc::run.
[[nodiscard]] RunUnderBothRules run_under_both_rules(const tmcmc::Problem& problem,
                                                     const tmcmc::Options& by_cov,
                                                     const tmcmc::Options& by_ess,
                                                     const tmcmc::StreamKey& key);

/// Largest relative differences over all stages of the runs.
struct RuleDifferences {
  /// Largest difference between step_ess and step_cov.
  double of_steps = 0.0;
  /// Largest difference between N / (1 + CoV^2) and N_eff.
  double of_identity = 0.0;
  /// Largest difference between step_cov_sample and step_cov.
  double of_sample_deviation = 0.0;
  /// Largest difference between the paths of beta in whole runs.
  double of_paths = 0.0;
  /// Number of stages of all runs.
  std::size_t stages = 0;
  /// Runs with the same path.
  std::size_t same_paths = 0;
};
/// \param runs  results of run_under_both_rules
[[nodiscard]] RuleDifferences rule_differences(std::span<const RunUnderBothRules> runs);

}  // namespace replication
