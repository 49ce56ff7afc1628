/// \file
/// Transitional Markov Chain Monte Carlo (Ching and Chen 2007; Lye and Marino 2023, Section 2). One
/// sampler: the criterion, the moves and every other difference between texts are values in
/// Options.
#pragma once

#include <functional>
#include <vector>

#include "tmcmc/options.hpp"
#include "tmcmc/problem.hpp"
#include "tmcmc/progress.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// Called with the draws from the prior, when progress.stages is empty, and after each stage. With the
/// finish IndependentDraws: about forty times a run, with all points that have been evaluated so far
/// (Progress), possibly from one of several threads, but never from two at a time.
using Observer = std::function<void(const Progress& progress)>;

/// Chooses the step from a population with beta < 1.
using StepRule = std::function<TemperingStep(const State&)>;

/// The sampler: draws from the prior, and stages until beta is 1; or what options.finish makes of it.
/// \param observer  sees the draws from the prior and the population after each stage
/// \param rule  chooses the steps; without it, options.criterion does. Not with IndependentDraws
/// \throws errors::InvalidValue for invalid options; SamplingError if a criterion cannot be met or
///         the likelihood fails; InfeasiblePriorError if no draw from the prior is feasible.
[[nodiscard]] Result run(const Problem& problem, const Options& options, const StreamKey& key,
                         const Observer& observer = {}, const StepRule& rule = {});

/// Goes on from what an observer of the same run saw after any stage, to the same result bit for
/// bit as if it had never been stopped. `run` is this from the draws from the prior on.
/// \param key  the run's; threads, batch_rows and max_stages may be others than before
/// \param observer  sees what comes after `from`
/// \throws errors::InvalidValue for a progress that cannot be of this problem and these options; as
///         run.
[[nodiscard]] Result resume(const Problem& problem, const Options& options, const StreamKey& key,
                            Progress from, const Observer& observer = {}, const StepRule& rule = {});

/// Draws from the prior and evaluates them: the state with beta = 0. The finish has no part in it.
/// \throws as run.
[[nodiscard]] State init(const Problem& problem, const Options& options, const StreamKey& key);

/// What a stage makes of a state.
struct NextStage {
  /// At the next beta.
  State state;
  /// What the stage did.
  StageRecord record;
};

/// One stage as a pure function: weights of the step, resampling, fitted proposals and moves. The
/// finish has no part in it.
/// \param tempering  as choose_step() or a StepRule gives it
/// \throws as run.
[[nodiscard]] NextStage step(const Problem& problem, const Options& options, const StreamKey& key,
                             const TemperingStep& tempering, const State& from);

/// Steps through the given temperatures.
/// \param betas  ascending, positive, the last one 1
/// \throws errors::InvalidValue for others.
[[nodiscard]] StepRule fixed_schedule(std::vector<double> betas);

}  // namespace tmcmc
