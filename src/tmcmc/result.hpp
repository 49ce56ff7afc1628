/// \file
/// Result of a run.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tmcmc/genealogy.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// Points with their log-likelihoods.
struct Walkers {
  /// Points, n x d.
  Population points;
  /// Log-likelihoods, n.
  Eigen::VectorXd log_likelihood;

  /// Copies the given rows of a population.
  void gather(const Population& from_points, const Eigen::VectorXd& from_log_likelihood,
              std::span<const Index> rows, int threads = 1);
};

/// A population at one temperature.
struct State : Walkers {
  /// Temperature: the points follow L^beta times the prior.
  double beta = 0.0;
  /// Sum of the log-mean weights of the steps up to beta.
  double log_evidence = 0.0;
  /// Number of stages completed; 0 for draws from the prior.
  Index stage = 0;
  /// Number of log-likelihoods evaluated so far.
  Index evaluations = 0;
  /// Scale gamma of the proposals, as adapted by Options::scale_rule; 0 before the first stage.
  double proposal_scale = 0.0;
  /// Genealogy of the chains; only the number of chains without Options::diagnose.
  Genealogy genealogy;
};

/// Record of a stage: choice of the step, resampling and moves.
struct StageRecord {
  /// Number of the stage, from 1.
  Index stage = 0;
  /// beta after the stage.
  double beta = 0.0;
  /// Step dbeta.
  double step = 0.0;
  /// Effective sample size of the weights of the step.
  double effective_sample_size = 0.0;
  /// Coefficient of variation of the weights, as reported by the step rule.
  double coefficient_of_variation = 0.0;
  /// Logarithm of the mean weight.
  double log_evidence_increment = 0.0;
  /// Acceptance rate of all proposals, including those outside the support of the prior.
  double acceptance_rate = 0.0;
  /// Samples before the stage with a log-likelihood above infeasible_level.
  Index feasible = 0;
  /// Number of distinct rows among the starts.
  Index distinct_ancestors = 0;
  /// Number of log-likelihoods evaluated in this stage.
  Index evaluations = 0;
  /// Number of proposals drawn again (RedrawnWalk).
  Index redraws = 0;
  /// Metropolis steps of each chain; with growing chains those of the longest chain.
  Index move_steps = 0;
  /// Proposal scale at the end of the stage, before any division by the square root of a subset's
  /// size.
  double proposal_scale = 0.0;
  /// Drift of the log-likelihood along the chains of the stage, as a t value with chains - 1
  /// degrees of freedom: the mean over the chains of (mean of the last third - mean of the first
  /// third), divided by its standard error. 0 for fewer than 3 chains and without drift; computed
  /// for waste-free only.
  double equilibrium_t = 0.0;
  /// Number of evaluations of all weights that were needed to find the step.
  int transition_evaluations = 0;
};

/// Why a run ended.
enum class StopReason {
  /// beta = 1 was reached.
  completed,
  /// max_stages was reached.
  stage_limit,
  /// The step was below minimum_step.
  step_too_small,
  /// The next stage would exceed evaluation_budget.
  budget
};
constexpr std::array<std::string_view, 4> enumerator_names(std::type_identity<StopReason>) {
  return {"posterior reached", "max_stages reached", "next step below minimum_step",
          "next stage beyond evaluation_budget"};
}

/// A log-evidence with its standard error.
struct Evidence {
  /// log P(D), for a normalised prior.
  double log_evidence = 0.0;
  /// Standard error of the log-evidence, from one run.
  double standard_error = 0.0;
};

/// Signs that the results of a run may be unreliable. src/tmcmc/README.md describes a remedy for
/// each.
enum class WarningKind {
  /// `stop` is not completed: the samples follow a tempered posterior.
  not_completed,
  /// Less than 1 % of the draws from the prior, or fewer than 20, are feasible.
  few_feasible,
  /// After a resampling less than 5 % of the starts are distinct (or fewer than 3).
  few_ancestors,
  /// A stage accepted less than 5 % of its proposals.
  low_acceptance,
  /// The effective sample size of a parameter is below 50.
  low_effective_size,
  /// The standard error of the log-evidence is above 1.
  uncertain_evidence,
  /// Fewer than 10 effective samples for each of the d (d + 1) / 2 entries of the proposal
  /// covariance: proposals fitted to so few samples bias the log-evidence upwards, by 1 in 20 and
  /// by 8 in 50 dimensions with 3 samples per entry, and its standard error does not include this
  /// bias.
  few_for_covariance,
  /// The log-likelihood rises along the chains of one stage or of all stages by more than chance
  /// explains: beta has crossed a transition faster than the chains reach equilibrium, so that
  /// log-evidence and samples do not come from stationary chains.
  not_in_equilibrium,
  /// Independent draws: neither search has come near the posterior. The result comes from TMCMC
  /// with the remaining evaluations.
  search_not_completed,
  /// Independent draws: the two searches have missed different parts of the posterior, so that both
  /// may have missed yet another part.
  searches_differ,
  /// Independent draws: their effective number is below 250 or below a twentieth of the draws.
  low_overlap,
  /// Independent draws: k-hat is above min(1 - 1 / log10(n), 0.7); the error of the log-evidence is
  /// a lower bound.
  heavy_weights,
  /// Independent draws: beta was chosen from fewer than 40 effective draws, or, if there are
  /// several separate modes, from fewer than 25 for each of them and one more; another mode may
  /// have been lost. If a search has ended below beta = 1, at least two modes are assumed. The
  /// warning is also given if the searches have made fewer than 2400 draws, which can miss a small
  /// part.
  few_draws_a_mode
};
constexpr std::array<std::string_view, 13> enumerator_names(std::type_identity<WarningKind>) {
  return {"not completed",
          "few feasible draws",
          "few ancestors",
          "low acceptance",
          "low effective sample size",
          "uncertain evidence",
          "few samples for the covariance",
          "not in equilibrium",
          "search not completed",
          "searches differ",
          "low overlap",
          "heavy weights",
          "few draws a mode"};
}

/// One warning.
struct Warning {
  /// Kind of the warning, for programs.
  WarningKind kind;
  /// What was found, which bound was violated, and what helps.
  std::string message;
};

/// Diagnostics of a run.
struct Diagnostics {
  /// Effective sample size of each parameter.
  Eigen::VectorXd effective_sample_size;
  /// Warnings; empty if no problem was found.
  std::vector<Warning> warnings;
};

/// Further results of a run with the finish IndependentDraws.
struct Measurement {
  /// (sum w)^2 / sum w^2: equivalent number of unweighted draws from the posterior.
  double effective_sample_size = 0.0;
  /// k-hat of the largest weights, see pareto_shape(): errors are reliable up to 0.7.
  double pareto_shape = 0.0;
  /// Temperature that each search has reached.
  std::array<double, 2> search_beta{};
  /// Posterior mass of the region in which each search has hardly any draws.
  std::array<double, 2> missed_mass{};
};

/// A finished run.
struct Result {
  /// Samples of the posterior if stop is completed. With independent draws the samples are
  /// weighted, final.log_evidence is the logarithm of their mean weight, and each sample is a chain
  /// of its own.
  State final;
  /// Weights, one per sample, with a mean of 1. All are 1 unless the finish is IndependentDraws.
  Eigen::VectorXd weights;
  /// Records, one per stage, in order. With independent draws: one per round of the first search;
  /// only stage, beta, step, effective_sample_size and evaluations are set.
  std::vector<StageRecord> stages;
  /// Why the run ended.
  StopReason stop = StopReason::completed;
  /// Log-evidence by bridge sampling up to final.beta; final.log_evidence is the sum of log-mean
  /// weights. With independent draws: the logarithm of the mean weight, with the error for
  /// independent weights.
  Evidence evidence;
  /// Diagnostics; empty, as is evidence, without Options::diagnose.
  Diagnostics diagnostics;
  /// Set only with the finish IndependentDraws, unless TMCMC took over from the searches.
  std::optional<Measurement> measurement;
};

}  // namespace tmcmc
