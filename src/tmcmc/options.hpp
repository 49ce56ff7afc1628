/// \file
/// Options of the sampler.
#pragma once

#include <limits>

#include "tmcmc/proposal_options.hpp"
#include "tmcmc/resampling.hpp"
#include "tmcmc/tempering_step.hpp"

namespace tmcmc {

/// How a stage turns weighted samples into equally weighted ones.
enum class MoveKind {
  resample_move,  ///< resampling to N starts, a chain of `move_steps` steps from each, last state kept
  /// The paper's wording: N times a chain is picked with probability w_i and its current state moved by one step; each
  /// updated state is kept (move_steps is not used). Biased at any N: the chance that a chain is picked k times or more
  /// is not proportional to its weight, so that short chains, which have moved little, count too much.
  growing_chains,
  /// Dau and Chopin (2022): resampling to M = `chains` starts, a chain of N/M - 1 steps from each, every state kept, the
  /// start included (move_steps is not used). Long chains and no evaluation thrown away.
  waste_free
};

/// Scale of a random-walk proposal, as a multiple of the population's covariance.
enum class ScaleRule {
  fixed,  ///< proposal_scale (Eq. 5: 0.2)
  dimension,  ///< 2.38 / sqrt(d), d the number of coordinates that a proposal changes (Roberts, Gelman and Gilks 1997)
  /// starts as `dimension`; after step k of a stage its logarithm grows by (acceptance rate of the random walks -
  /// target_acceptance) / sqrt(k), and the next stage goes on from there (after Betz, Papaioannou and Straub 2016, who
  /// adapt after groups of chains). Not for growing chains.
  target_acceptance,
  /// 1/9 + 8/9 of the acceptance rate of the random walks of the stage before (Minson, Simons and Beck 2013); first 1
  acceptance_linked
};

/// All that a run depends on besides problem and StreamKey. The defaults are the paper's sampler (N = 1000, CoV = 1, three
/// steps of scale 0.2) with the population standard deviation; recommended_options() samples better for the same cost.
struct Options {
  Index samples = 1000;                             ///< N
  Criterion criterion;                              ///< Eq. 6 or 9
  Resampling resampling = Resampling::multinomial;  ///< how the starts of a stage are drawn

  MoveKind move = MoveKind::resample_move;  ///< how the starts become samples
  Index move_steps =
      3;  ///< Metropolis steps a chain and stage (resample-move); the least number with mixing_correlation
  /// If positive: a stage of resample-move goes on until the correlation between the states of the chains and their
  /// starts is at most this in every parameter, or max_move_steps are done. Only with resample-move.
  double mixing_correlation = 0.0;
  Index max_move_steps = 1000;  ///< with mixing_correlation
  Index chains = 50;            ///< M of waste-free; has to divide samples

  ScaleRule scale_rule = ScaleRule::fixed;         ///< of the random walks
  double proposal_scale = 0.2;                     ///< gamma of Eq. 5, with ScaleRule::fixed
  double target_acceptance = 0.3;                  ///< with ScaleRule::target_acceptance
  Centre centre = Centre::weighted_mean;           ///< m of Eq. 5
  Coordinates coordinates = Coordinates::natural;  ///< of the proposals
  bool random_subsets =
      false;  ///< a proposal changes a random set of (whitened) coordinates: detail::MetropolisKernel
  double independent_fraction = 0.0;  ///< share of independent proposals: detail::MetropolisKernel
  /// Each half of the chains (by the parity of their chain before the resampling) gets a kernel that was fitted to the
  /// other half, so that no chain is moved by proposals that it has shaped itself. In many dimensions (20 and more) that
  /// takes away most of the bias of the log-evidence; in few it costs a little precision. Not for growing chains.
  bool cross_fit = false;
  Boundary boundary = Boundary::reject;  ///< redraw needs a random walk in all natural coordinates
  Index max_redraws = 100000;            ///< a proposal drawn again more often ends the run with an error

  /// Log-likelihoods at or below this count as infeasible where feasible samples are counted
  /// (StageRecord::feasible, and the check that the first population has any); for models that use a penalty
  /// in place of minus infinity.
  double infeasible_level = -std::numeric_limits<double>::infinity();
  Index max_stages = 1000;      ///< a run that needs more ends with StopReason::stage_limit
  double minimum_step = 1e-15;  ///< a smaller step of beta that does not reach 1 ends the run
  /// Most log-likelihoods of a run; 0: no limit. The chains of the last stage go on until it is used up. Before it,
  /// waste-free shortens its chains where more stages are expected than `samples` of them would fit, so that `samples`
  /// is the size of the first population and an upper bound for the others. A run whose budget does not hold one step
  /// of each chain ends with StopReason::budget. Not for growing chains.
  Index evaluation_budget = 0;
  /// Bridge estimate of the log-evidence with its error, effective sample sizes and warnings (Result::evidence and
  /// Result::diagnostics).
  bool diagnose = true;
  int threads = 1;  ///< over the rows of one population
  Index batch_rows =
      2048;  ///< most rows a call of the log-likelihood gets; 0: as many as are a thread's share

  /// \throws std::invalid_argument naming field, value and constraint.
  void validate() const;
};

/// What we would use: the paper's N_eff = N/2 (of the feasible samples) with better moves: waste-free with 10 chains,
/// systematic resampling, half of the proposals random walks of scale 2.38/sqrt(d) and half independent, in random subsets
/// of unbounded coordinates. Found by experiments/cost_accuracy on the friction benchmark and checked by
/// experiments/calibration and benchmark_problems. Posteriors of several separate modes want more chains (Options::chains):
/// each mode keeps only the mass of the chains that started in it.
/// \param evaluations  budget of log-likelihoods, at least 500 and 26 a chain. A 13th of it is the first population, no later one
///                     is larger but the last, which gets what is left; more stages get smaller populations
///                     (Options::evaluation_budget)
/// \param chains       Options::chains
/// \throws std::invalid_argument for a smaller budget.
[[nodiscard]] Options recommended_options(Index evaluations = 31000, Index chains = 10);

}  // namespace tmcmc
