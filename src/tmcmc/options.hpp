/// \file
/// Options of the sampler.
#pragma once

#include <limits>

#include "tmcmc/finish.hpp"
#include "tmcmc/move.hpp"
#include "tmcmc/proposal_options.hpp"
#include "tmcmc/resampling.hpp"
#include "tmcmc/tempering_step.hpp"

namespace tmcmc {

/// All settings on which a run depends, apart from problem and StreamKey. The defaults are the
/// paper's sampler (N = 1000, CoV = 1, three steps of scale 0.2) with the population standard
/// deviation; recommended_options() give better estimates of the posterior for the same cost.
struct Options {
  /// Number of samples N.
  Index samples = 1000;
  /// Criterion that chooses the tempering step: Eq. 6 or Eq. 9.
  Criterion criterion;
  /// Scheme by which the starts of a stage are drawn.
  Resampling resampling = Resampling::multinomial;
  /// Method by which the starts become samples.
  Move move;
  /// Rule for the scale of the random walks.
  ScaleRule scale_rule;
  /// Method by which a state is proposed.
  Proposal proposal;
  /// Centre m of Eq. 5.
  Centre centre = Centre::weighted_mean;
  /// Each half of the chains (by the parity of their chain before the resampling) gets a kernel
  /// that was fitted to the other half, so that no chain is moved by proposals that depend on the
  /// chain itself. In many dimensions (20 and more) this removes most of the bias of the
  /// log-evidence; in few dimensions it costs a little precision. Not for growing chains.
  bool cross_fit = false;
  /// Log-likelihoods at or below this level count as infeasible where feasible samples are counted
  /// (StageRecord::feasible, and the check that the first population has any); for models that use
  /// a penalty instead of minus infinity.
  double infeasible_level = -std::numeric_limits<double>::infinity();
  /// Largest number of stages; a run that needs more ends with StopReason::stage_limit.
  Index max_stages = 1000;
  /// A step of beta that is smaller than this and does not reach 1 ends the run.
  double minimum_step = 1e-15;
  /// Largest number of log-likelihoods of a run; 0: no limit. The chains of the last stage continue
  /// until the budget is used up. Before the last stage, waste-free shortens its chains if the
  /// budget would not hold the expected number of stages with `samples` samples each, so that
  /// `samples` is the size of the first population and an upper bound for the others. A run whose
  /// budget does not hold one step of each chain ends with StopReason::budget. Not for growing
  /// chains.
  Index evaluation_budget = 0;
  /// What measures the posterior. IndependentDraws use evaluation_budget up, at least 2000.
  Finish finish;
  /// Whether to compute the bridge estimate of the log-evidence with its error, effective sample
  /// sizes and warnings (Result::evidence and Result::diagnostics).
  bool diagnose = true;
  /// Number of threads over the rows of a population. Results do not depend on it.
  int threads = 1;
  /// Largest number of rows that a call of the log-likelihood gets; 0: the share of a thread.
  Index batch_rows = 2048;

  /// \throws errors::InvalidValue naming the option, its value and what was expected, for a value
  ///         outside its range and for options that are incompatible.
  void validate() const;
};

/// Calls visit(OptionInfo, pointer to the value) for each option of a run; the pointer is null
/// where an option has no meaning under the other options.
/// \param options  Options or const Options
template <class AnyOptions, class Visit>
void visit_options(AnyOptions& options, Visit&& visit) {
  using enum OptionGroup;
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  visit({"samples", paper, whole_from(2), "N, the samples of a run"}, &options.samples);
  visit_criterion_options(options.criterion, visit);
  visit({"resampling", beyond_the_paper, named(), "Choice of the starts"}, &options.resampling);
  visit_move_options(options.move, visit);
  visit_scale_options(options.scale_rule, visit);
  visit_proposal_options(options.proposal, visit);
  visit({"centre", paper, named(), "Mean in the proposal covariance (Eq. 5)"}, &options.centre);
  visit({"cross_fit", beyond_the_paper, named(), "Fit the proposals of half the chains to the others"},
        &options.cross_fit);
  visit({"infeasible_level",
         computation,
         {.least = -unlimited, .most = unlimited},
         "Log-likelihoods up to this count as infeasible"},
        &options.infeasible_level);
  visit({.name = "max_stages",
         .group = paper,
         .range = whole_from(1),
         .help = "Most stages of a run",
         .changes_samples = false},
        &options.max_stages);
  visit({"minimum_step", paper, {.least = 0.0, .most = 1.0, .below_most = true}, "Smallest step of beta"},
        &options.minimum_step);
  visit({"evaluation_budget", beyond_the_paper, whole_from(0, 1e15),
         "Most log-likelihoods of a run; 0: no limit"},
        &options.evaluation_budget);
  visit_finish_options(options.finish, visit);
  visit({"diagnose", computation, named(), "Error of the log-evidence, effective sample sizes, warnings"},
        &options.diagnose);
  visit({.name = "threads",
         .group = computation,
         .range = whole_from(1, 4096),
         .help = "Threads of a run",
         .changes_samples = false},
        &options.threads);
  visit({.name = "batch_rows",
         .group = computation,
         .range = whole_from(0),
         .help = "Most rows that a call of the log-likelihood gets; 0: a thread's share",
         .changes_samples = false},
        &options.batch_rows);
}

/// TMCMC with better moves than the paper's: N_eff = N/2 (of the feasible samples), waste-free with
/// 10 chains, systematic resampling, half of the proposals random walks of scale 2.38/sqrt(d) and
/// half independent, in random subsets of unbounded coordinates. These settings were found by
/// experiments/cost_accuracy on the friction benchmark and checked by benchmark_problems.
/// Posteriors with several separate modes need more chains: each mode keeps only the mass of the
/// chains that started in it. All samples have the same weight.
/// \param evaluations  budget of log-likelihoods, at least 500 and 26 per chain. The first
///        population uses a 13th of it; no later population is larger except the last, which gets
///        the rest; if there are more stages, their populations are smaller
///        (Options::evaluation_budget)
/// \param chains  WasteFree::chains
/// \throws errors::InvalidValue for a smaller budget.
[[nodiscard]] Options recommended_moves(Index evaluations = 31000, Index chains = 10);

/// The recommended options: the posterior is measured by IndependentDraws, so that the samples are
/// weighted (Result::weights). On 39 problems at 3000, 10 000 and 31 000 evaluations
/// (experiments/benchmark_problems) they came closer to the log-evidence than recommended_moves()
/// on 38, 38 and 39 problems (the losses: five narrow modes, with a warning), and closer than the
/// paper's setting on 38, 39 and 39. Below 3000 evaluations, where this has not been measured, the
/// function returns recommended_moves(); these moves also take over if the searches fail.
/// \param evaluations  budget of log-likelihoods, which is used up; at least 500 and 26 per chain
/// \param chains  number of chains of the moves that take over
/// \throws errors::InvalidValue for a smaller budget.
[[nodiscard]] Options recommended_options(Index evaluations = 31000, Index chains = 10);

}  // namespace tmcmc
