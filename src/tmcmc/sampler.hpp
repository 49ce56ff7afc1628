/// \file
/// Transitional Markov Chain Monte Carlo (Ching and Chen 2007; Lye and Marino 2023, Section 2). One sampler:
/// the criterion, the moves and every other difference between texts are values in Options.
#pragma once

#include <limits>
#include <vector>

#include "tmcmc/moves.hpp"
#include "tmcmc/proposal.hpp"
#include "tmcmc/transition.hpp"

namespace tmcmc {

/// How a stage turns weighted samples into equally weighted ones.
enum class MoveKind {
  resample_move,  ///< multinomial resampling to N starts, a chain of `move_steps` steps from each, last state
                  ///< kept
  /// The paper's wording: N times a chain is picked with probability w_i and its current state moved by one step; each
  /// updated state is kept (move_steps is not used). Biased at any N: the chance that a chain is picked k times or more
  /// is not proportional to its weight, so that short chains, which have moved little, count too much.
  growing_chains
};

struct Options {
  Index samples = 1000;  ///< N
  Criterion criterion;   ///< Eq. 6 or 9
  MoveKind move = MoveKind::resample_move;
  Index move_steps = 3;                   ///< Metropolis steps a chain and stage
  double proposal_scale = 0.2;            ///< gamma of Eq. 5
  Centre centre = Centre::weighted_mean;  ///< m of Eq. 5
  Boundary boundary = Boundary::reject;
  Index max_redraws = 100000;  ///< a proposal drawn again more often ends the run with an error
  /// Log-likelihoods at or below this count as infeasible where feasible samples are counted
  /// (StageRecord::feasible, and the check that the first population has any); for models that use a penalty
  /// in place of minus infinity.
  double infeasible_level = -std::numeric_limits<double>::infinity();
  Index max_stages = 1000;
  double minimum_step = 1e-15;  ///< a smaller step of beta that does not reach 1 ends the run
  int threads = 1;              ///< over the rows of one population
  Index batch_rows = 2048;  ///< most rows a call of the log-likelihood gets; 0: as many as are a thread's share

  /// \throws std::invalid_argument naming field, value and constraint.
  void validate() const;
};

struct Problem {
  LogLikelihood log_likelihood;
  BoxPrior prior;
};

/// A population at one temperature.
struct State {
  Population points;               ///< N x d
  Eigen::VectorXd log_likelihood;  ///< N
  double beta = 0.0;
  double log_evidence = 0.0;  ///< sum of the log-mean weights up to beta
  Index stage = 0;
  Index evaluations = 0;  ///< log-likelihoods so far
};

struct StageRecord {
  Index stage = 0;    ///< from 1
  double beta = 0.0;  ///< after the stage
  double step = 0.0;
  double effective_sample_size = 0.0;     ///< of the weights of the step
  double coefficient_of_variation = 0.0;  ///< of the weights, as the step rule reports it
  double log_evidence_increment = 0.0;
  double acceptance_rate = 0.0;  ///< of all proposals, those outside the box (Boundary::reject) included
  Index feasible = 0;            ///< samples before the stage with a log-likelihood above infeasible_level
  Index distinct_ancestors = 0;
  Index evaluations = 0;  ///< log-likelihoods in this stage
  Index redraws = 0;
  int transition_evaluations = 0;  ///< evaluations of all weights to find the step
};

enum class StopReason {
  completed,      ///< beta = 1
  stage_limit,    ///< max_stages
  step_too_small  ///< a step below minimum_step
};

struct Result {
  State final;  ///< samples of the posterior if stop is completed
  std::vector<StageRecord> stages;
  StopReason stop = StopReason::completed;
};

/// Memory of a run that every stage uses again.
struct Workspace {
  Workspace(const Problem& problem, const Options& options, const StreamKey& key);

  Mover mover;
  std::vector<double> weights;
  std::vector<double> partial_sums;
  std::vector<Index> ancestors;
};

/// Called after each stage with its record and the new population.
using Observer = std::function<void(const StageRecord&, const State&)>;

/// Chooses the step from a population with beta < 1.
using StepRule = std::function<Transition(const State&)>;

/// Draws from the prior and evaluates them: beta = 0.
/// \throws SamplingError for a log-likelihood of NaN or plus infinity; InfeasiblePriorError if no draw is
///        feasible.
[[nodiscard]] State initial_state(const Problem& problem, const Options& options, const StreamKey& key);

/// One stage: weights of the step, covariance, resampling and moves. `to` is overwritten; its memory is
/// reused.
StageRecord advance(const Problem& problem, const Options& options, const StreamKey& key,
                    const Transition& transition, const State& from, State& to, Workspace& work);

/// The sampler: options.criterion chooses the steps.
/// \throws std::invalid_argument for invalid options; SamplingError if a criterion cannot be met or the likelihood
///        fails.
[[nodiscard]] Result run(const Problem& problem, const Options& options, const StreamKey& key,
                         const Observer& observer = {});

/// The same with steps from elsewhere.
[[nodiscard]] Result run(const Problem& problem, const Options& options, const StreamKey& key,
                         const StepRule& rule, const Observer& observer = {});

/// Steps through the given temperatures.
/// \param betas  ascending, positive, the last one 1
[[nodiscard]] StepRule fixed_schedule(std::vector<double> betas);

}  // namespace tmcmc
