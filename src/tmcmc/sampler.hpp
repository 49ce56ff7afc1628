/// \file
/// Transitional Markov Chain Monte Carlo (Ching and Chen 2007; Lye and Marino 2023, Section 2).
/// There is one sampler: the criterion, the moves and every other difference between texts are
/// values in Options.
#pragma once

#include <functional>
#include <vector>

#include "tmcmc/options.hpp"
#include "tmcmc/problem.hpp"
#include "tmcmc/progress.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// Called with the draws from the prior, when progress.stages is empty, and after each stage. With
/// the finish IndependentDraws it is called about forty times per run, with all points evaluated so
/// far (Progress), possibly from different threads, but never from two at the same time.
using Observer = std::function<void(const Progress& progress)>;

/// Chooses the step from a population with beta < 1.
using StepRule = std::function<TemperingStep(const State&)>;

/// The sampler: draws from the prior, then stages until beta is 1; or the procedure that
/// options.finish selects.
/// \param observer  receives the draws from the prior and the population after each stage
/// \param rule  chooses the steps; without it options.criterion does. Not with IndependentDraws
/// \throws errors::InvalidValue for invalid options; SamplingError if a criterion cannot be met or
///         the likelihood fails; InfeasiblePriorError if no draw from the prior is feasible.
[[nodiscard]] Result run(const Problem& problem, const Options& options, const StreamKey& key,
                         const Observer& observer = {}, const StepRule& rule = {});

/// Continues from the progress that an observer of the same run received after any stage. The
/// result is bit for bit the same as if the run had never been stopped. `run` is equivalent to
/// resuming from the draws from the prior.
/// \param key  key of the run; threads, batch_rows and max_stages may differ from before
/// \param observer  receives the progress after `from`
/// \throws errors::InvalidValue for a progress that cannot belong to this problem and these
///         options; also as run.
[[nodiscard]] Result resume(const Problem& problem, const Options& options, const StreamKey& key,
                            Progress from, const Observer& observer = {}, const StepRule& rule = {});

/// Draws from the prior and evaluates them: the state with beta = 0. The finish is ignored.
/// \throws as run.
[[nodiscard]] State init(const Problem& problem, const Options& options, const StreamKey& key);

/// The result of one stage.
struct NextStage {
  /// The state at the next beta.
  State state;
  /// The record of the stage.
  StageRecord record;
};

/// One stage as a pure function: weights of the step, resampling, fitted proposals and moves. The
/// finish is ignored.
/// \param tempering  the step, as returned by choose_step() or a StepRule
/// \throws as run.
[[nodiscard]] NextStage step(const Problem& problem, const Options& options, const StreamKey& key,
                             const TemperingStep& tempering, const State& from);

/// A step rule that follows the given temperatures.
/// \param betas  ascending, positive, the last one equal to 1
/// \throws errors::InvalidValue for any other betas.
[[nodiscard]] StepRule fixed_schedule(std::vector<double> betas);

}  // namespace tmcmc
