/// \file
/// What a run returns.
#pragma once

#include <string>
#include <vector>

#include "tmcmc/types.hpp"

namespace tmcmc {

/// Descent of the chains of a population.
struct Genealogy {
  Index chains = 0;  ///< row i of the population belongs to chain i modulo this
  /// ancestors[t][c]: chain of the population after stage t from which chain c descends; t = 0 is the prior, where each
  /// draw is a chain, and the last t the stage before. Empty for the prior itself.
  std::vector<std::vector<Index>> ancestors;
};

/// Points with their log-likelihoods.
struct Walkers {
  Population points;               ///< n x d
  Eigen::VectorXd log_likelihood;  ///< n

  /// Takes the given rows of a population.
  void gather(const Population& from_points, const Eigen::VectorXd& from_log_likelihood,
              std::span<const Index> rows, int threads = 1);
};

/// A population at one temperature.
struct State : Walkers {
  double beta = 0.0;            ///< temperature: the points follow L^beta times the prior
  double log_evidence = 0.0;    ///< sum of the log-mean weights up to beta
  Index stage = 0;              ///< stages behind it; 0 for draws from the prior
  Index evaluations = 0;        ///< log-likelihoods so far
  double proposal_scale = 0.0;  ///< what the rules that adapt it have come to; 0 before the first stage
  Genealogy genealogy;          ///< without Options::diagnose the number of chains alone
};

/// What a stage did: choice of the step, resampling and moves.
struct StageRecord {
  Index stage = 0;                        ///< from 1
  double beta = 0.0;                      ///< after the stage
  double step = 0.0;                      ///< dbeta
  double effective_sample_size = 0.0;     ///< of the weights of the step
  double coefficient_of_variation = 0.0;  ///< of the weights, as the step rule reports it
  double log_evidence_increment = 0.0;    ///< log of the mean weight
  double acceptance_rate = 0.0;  ///< of all proposals, those outside the box (Boundary::reject) included
  Index feasible = 0;            ///< samples before the stage with a log-likelihood above infeasible_level
  Index distinct_ancestors = 0;  ///< different rows among the starts
  Index evaluations = 0;         ///< log-likelihoods in this stage
  Index redraws = 0;             ///< proposals drawn again (Boundary::redraw)
  Index move_steps = 0;          ///< Metropolis steps of each chain; of the longest one with growing chains
  double proposal_scale =
      0.0;  ///< at the end of the stage; before a division by the square root of a subset's size
  /// Drift of the log-likelihood along the chains of the stage, as a t value with chains - 1 degrees of freedom: the mean
  /// over the chains of (mean of the last third - mean of the first third), over its standard error. 0 for fewer than 3
  /// chains and without drift; waste-free alone.
  double equilibrium_t = 0.0;
  int transition_evaluations = 0;  ///< evaluations of all weights to find the step
};

/// Why a run ended.
enum class StopReason {
  completed,       ///< beta = 1
  stage_limit,     ///< max_stages
  step_too_small,  ///< a step below minimum_step
  budget           ///< the next stage would need more than evaluation_budget
};

/// A log-evidence with its standard error.
struct Evidence {
  double log_evidence = 0.0;    ///< log P(D), the prior normalised
  double standard_error = 0.0;  ///< of the log-evidence, from one run
};

/// Signs of a run that should not be believed without a second look. src/tmcmc/README.md says what to do about each.
enum class WarningKind {
  not_completed,       ///< stop is not completed: the samples are those of a tempered posterior
  few_feasible,        ///< less than 1 % of the draws from the prior, or fewer than 20, are feasible
  few_ancestors,       ///< after a resampling less than 5 % of the starts differ (or fewer than 3)
  low_acceptance,      ///< a stage accepted less than 5 % of its proposals
  low_effective_size,  ///< effective sample size of a parameter below 50
  uncertain_evidence,  ///< standard error of the log-evidence above 1
  /// fewer than 10 effective samples to each of the d (d + 1) / 2 entries of the proposal covariance: proposals that have
  /// been fitted to so few bias the log-evidence upwards, by 1 in 20 and by 8 in 50 dimensions with 3 samples an entry,
  /// and its standard error does not see it
  few_for_covariance,
  /// the log-likelihood rises along the chains of one stage or of all, more than chance explains: beta has crossed a
  /// transition faster than the chains reach equilibrium, and log-evidence and samples are those of no stationary chain
  not_in_equilibrium
};

/// One finding.
struct Warning {
  WarningKind kind;     ///< for programs
  std::string message;  ///< what was found, against which bound, and what helps
};

/// What a run says of its own quality.
struct Diagnostics {
  Eigen::VectorXd effective_sample_size;  ///< of each parameter
  std::vector<Warning> warnings;          ///< empty for a run that looks healthy
};

/// A finished run.
struct Result {
  State final;                              ///< samples of the posterior if stop is completed
  std::vector<StageRecord> stages;          ///< one a stage, in order
  StopReason stop = StopReason::completed;  ///< why the run ended
  Evidence
      evidence;  ///< by bridge sampling up to final.beta; final.log_evidence is the sum of log-mean weights
  Diagnostics diagnostics;  ///< empty, as is evidence, without Options::diagnose
};

}  // namespace tmcmc
