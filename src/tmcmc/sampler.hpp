/// \file
/// Transitional Markov Chain Monte Carlo (Ching and Chen 2007; Lye and Marino 2023, Section 2). One sampler:
/// the criterion, the moves and every other difference between texts are values in Options.
#pragma once

#include <functional>
#include <vector>

#include "tmcmc/detail/population_move.hpp"
#include "tmcmc/detail/resample.hpp"
#include "tmcmc/options.hpp"
#include "tmcmc/progress.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// What is sampled: the posterior proportional to likelihood times prior.
struct Problem {
  LogLikelihood log_likelihood;  ///< of the whole population, a row a point
  Prior prior;                   ///< normalised
};

/// Memory of a run that every stage uses again.
struct Workspace {
  /// The problem stays referred to.
  Workspace(const Problem& problem, const Options& options, const StreamKey& key);

  detail::Mover mover;                     ///< work space of the Metropolis steps
  std::vector<double> weights;             ///< of the rows of the population, relative to the largest
  std::vector<double> by_chain;            ///< the weights in the order of the chains
  std::vector<Index> ancestors;            ///< row that each chain starts from
  detail::ResamplingWorkspace resampling;  ///< work space of resample()
  detail::StageMoveWorkspace moves;        ///< work space of move_population()
};

/// Called with the draws from the prior, when progress.stages is empty, and after each stage.
using Observer = std::function<void(const Progress& progress)>;

/// Chooses the step from a population with beta < 1.
using StepRule = std::function<TemperingStep(const State&)>;

/// Draws from the prior and evaluates them: beta = 0.
/// \throws SamplingError for a log-likelihood of NaN or plus infinity; InfeasiblePriorError if no draw is
///        feasible.
[[nodiscard]] State initial_state(const Problem& problem, const Options& options, const StreamKey& key);

/// One stage: weights of the step, covariance, resampling and moves. `to` is overwritten; its memory is
/// reused.
StageRecord advance(const Problem& problem, const Options& options, const StreamKey& key,
                    const TemperingStep& transition, const State& from, State& to, Workspace& work);

/// The sampler: options.criterion chooses the steps.
/// \throws std::invalid_argument for invalid options; SamplingError if a criterion cannot be met or the likelihood
///        fails.
[[nodiscard]] Result run(const Problem& problem, const Options& options, const StreamKey& key,
                         const Observer& observer = {});

/// The same with steps from elsewhere.
[[nodiscard]] Result run(const Problem& problem, const Options& options, const StreamKey& key,
                         const StepRule& rule, const Observer& observer = {});

/// Goes on from what an observer of the same run saw after any stage, to the same result bit for bit as if it had never been
/// stopped. `run` is this from the draws from the prior on.
/// \param key  the run's; threads, batch_rows and max_stages may be others than before
/// \param observer  sees what comes after `from`
/// \throws std::invalid_argument for a progress that cannot be of this problem and these options; as run.
[[nodiscard]] Result resume(const Problem& problem, const Options& options, const StreamKey& key,
                            Progress from, const Observer& observer = {});

/// The same with steps from elsewhere.
[[nodiscard]] Result resume(const Problem& problem, const Options& options, const StreamKey& key,
                            Progress from, const StepRule& rule, const Observer& observer = {});

/// Steps through the given temperatures.
/// \param betas  ascending, positive, the last one 1
[[nodiscard]] StepRule fixed_schedule(std::vector<double> betas);

}  // namespace tmcmc
