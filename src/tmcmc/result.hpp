/// \file
/// What a run returns.
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
  /// n x d.
  Population points;
  /// n.
  Eigen::VectorXd log_likelihood;

  /// Takes the given rows of a population.
  void gather(const Population& from_points, const Eigen::VectorXd& from_log_likelihood,
              std::span<const Index> rows, int threads = 1);
};

/// A population at one temperature.
struct State : Walkers {
  /// Temperature: the points follow L^beta times the prior.
  double beta = 0.0;
  /// Sum of the log-mean weights up to beta.
  double log_evidence = 0.0;
  /// Stages behind it; 0 for draws from the prior.
  Index stage = 0;
  /// Log-likelihoods so far.
  Index evaluations = 0;
  /// Scale gamma of the proposals, as Options::scale_rule has adapted it; 0 before the first stage.
  double proposal_scale = 0.0;
  /// Without Options::diagnose the number of chains alone.
  Genealogy genealogy;
};

/// What a stage did: choice of the step, resampling and moves.
struct StageRecord {
  /// From 1.
  Index stage = 0;
  /// After the stage.
  double beta = 0.0;
  /// dbeta.
  double step = 0.0;
  /// Of the weights of the step.
  double effective_sample_size = 0.0;
  /// Of the weights, as the step rule reports it.
  double coefficient_of_variation = 0.0;
  /// Logarithm of the mean weight.
  double log_evidence_increment = 0.0;
  /// Of all proposals, those outside the support of the prior included.
  double acceptance_rate = 0.0;
  /// Samples before the stage with a log-likelihood above infeasible_level.
  Index feasible = 0;
  /// Different rows among the starts.
  Index distinct_ancestors = 0;
  /// Log-likelihoods in this stage.
  Index evaluations = 0;
  /// Proposals drawn again (RedrawnWalk).
  Index redraws = 0;
  /// Metropolis steps of each chain; of the longest one with growing chains.
  Index move_steps = 0;
  /// At the end of the stage; before a division by the square root of a subset's size.
  double proposal_scale = 0.0;
  /// Drift of the log-likelihood along the chains of the stage, as a t value with chains - 1
  /// degrees of freedom: the mean over the chains of (mean of the last third - mean of the first
  /// third), over its standard error. 0 for fewer than 3 chains and without drift; waste-free
  /// alone.
  double equilibrium_t = 0.0;
  /// Evaluations of all weights to find the step.
  int transition_evaluations = 0;
};

/// Why a run ended.
enum class StopReason {
  /// beta = 1.
  completed,
  /// max_stages.
  stage_limit,
  /// A step below minimum_step.
  step_too_small,
  /// The next stage would need more than evaluation_budget.
  budget
};
constexpr std::array<std::string_view, 4> enumerator_names(std::type_identity<StopReason>) {
  return {"posterior reached", "max_stages reached", "next step below minimum_step",
          "next stage beyond evaluation_budget"};
}

/// A log-evidence with its standard error.
struct Evidence {
  /// log P(D), the prior normalised.
  double log_evidence = 0.0;
  /// Of the log-evidence, from one run.
  double standard_error = 0.0;
};

/// Signs of a run that should not be believed without a second look. src/tmcmc/README.md says what
/// to do about each.
enum class WarningKind {
  /// `stop` is not completed: the samples are those of a tempered posterior.
  not_completed,
  /// Less than 1 % of the draws from the prior, or fewer than 20, are feasible.
  few_feasible,
  /// After a resampling less than 5 % of the starts differ (or fewer than 3).
  few_ancestors,
  /// A stage accepted less than 5 % of its proposals.
  low_acceptance,
  /// Effective sample size of a parameter below 50.
  low_effective_size,
  /// Standard error of the log-evidence above 1.
  uncertain_evidence,
  /// Fewer than 10 effective samples to each of the d (d + 1) / 2 entries of the proposal
  /// covariance: proposals that have been fitted to so few bias the log-evidence upwards, by 1 in
  /// 20 and by 8 in 50 dimensions with 3 samples an entry, and its standard error does not see it.
  few_for_covariance,
  /// The log-likelihood rises along the chains of one stage or of all, more than chance explains:
  /// beta has crossed a transition faster than the chains reach equilibrium, and log-evidence and
  /// samples are those of no stationary chain.
  not_in_equilibrium,
  /// Independent draws: neither search has come near the posterior. The result is that of TMCMC on
  /// the remaining evaluations.
  search_not_completed,
  /// Independent draws: the searches have missed different parts of the posterior, so that both may
  /// have missed another.
  searches_differ,
  /// Independent draws: their effective number is below 250 or below a twentieth of the draws.
  low_overlap,
  /// Independent draws: k-hat is above min(1 - 1 / log10(n), 0.7); the error of the log-evidence is
  /// a lower bound.
  heavy_weights,
  /// Independent draws: beta was chosen by fewer than 40 effective draws, or, where there are
  /// several separate modes, by fewer than 25 for each of them and one more; another mode may have
  /// been lost. Where a search has ended below beta = 1 there are taken to be two at least. Or the
  /// searches have made fewer than 2400 draws, which can miss a small part.
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

/// One finding.
struct Warning {
  /// For programs.
  WarningKind kind;
  /// What was found, against which bound, and what helps.
  std::string message;
};

/// What a run says of its own quality.
struct Diagnostics {
  /// Of each parameter.
  Eigen::VectorXd effective_sample_size;
  /// Empty for a run that looks healthy.
  std::vector<Warning> warnings;
};

/// What a run with the finish IndependentDraws says besides.
struct Measurement {
  /// (sum w)^2 / sum w^2: draws from the posterior that the weighted ones are worth.
  double effective_sample_size = 0.0;
  /// k-hat of the largest weights, see pareto_shape(): errors are to be believed up to 0.7.
  double pareto_shape = 0.0;
  /// Temperature that each search has reached.
  std::array<double, 2> search_beta{};
  /// Posterior mass where each search has hardly drawn.
  std::array<double, 2> missed_mass{};
};

/// A finished run.
struct Result {
  /// Samples of the posterior if stop is completed. With independent draws they are weighted,
  /// final.log_evidence is the logarithm of their mean weight, and each is a chain of its own.
  State final;
  /// One per sample, with a mean of 1. All are 1 unless the finish is IndependentDraws.
  Eigen::VectorXd weights;
  /// One per stage, in order. With independent draws: one per round of the first search, which know
  /// stage, beta, step, effective_sample_size and evaluations.
  std::vector<StageRecord> stages;
  /// Why the run ended.
  StopReason stop = StopReason::completed;
  /// By bridge sampling up to final.beta; final.log_evidence is the sum of log-mean weights. With
  /// independent draws: the logarithm of the mean weight, and the error of independent weights.
  Evidence evidence;
  /// Empty, as is evidence, without Options::diagnose.
  Diagnostics diagnostics;
  /// Only with the finish IndependentDraws, unless TMCMC took over from the searches.
  std::optional<Measurement> measurement;
};

}  // namespace tmcmc
