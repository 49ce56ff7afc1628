/// \file
/// What a stage does with its starts: the chains of each Move, and the adaptation of the proposal
/// scale.
#pragma once

#include <vector>

#include "tmcmc/detail/metropolis_step.hpp"
#include "tmcmc/options.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc::detail {

/// Memory of move_population(), to be reused from stage to stage.
struct StageMoveWorkspace {
  /// Present states of the chains of waste-free.
  Walkers chains;
  /// Where the mixing is measured.
  Population starts;
};

/// The kernel of a stage; with Options::cross_fit one for each half of the starts.
struct StageKernels {
  /// One or two.
  std::vector<MetropolisKernel> kernels;
  /// Rows of each of two kernels; empty for one.
  std::vector<std::vector<Index>> rows;
};

/// What the moves of a stage did.
struct StageMoves {
  /// Over all chains and steps.
  MoveCounts counts;
  /// See StageRecord::equilibrium_t.
  double equilibrium_t = 0.0;
  /// Metropolis steps of each chain; of the longest one with growing chains.
  Index steps = 0;
};

/// Moves the starts of a stage.
/// \param kernels  their scale is adapted (TargetAcceptance)
/// \param steps   Metropolis steps of each chain; not used by growing chains
/// \param most_steps  if more than `steps`, resample-move goes on after these as
///                    ResampleMove::mixing_correlation has it
/// \param walkers in: the starts, of growing chains in ascending order of their `ancestors`; out:
///                the population, of waste-free (steps + 1) times as many
StageMoves move_population(const Options& options, StageKernels& kernels, std::span<const Index> ancestors,
                           Index steps, Index most_steps, Walkers& walkers, Mover& mover,
                           StageMoveWorkspace& work);

/// Largest absolute correlation, over the parameters, between the rows of two populations; constant
/// parameters are left out.
[[nodiscard]] double largest_correlation(const Population& a, const Population& b);

/// Whether the log-likelihood drifts along the chains of a population: StageRecord::equilibrium_t.
/// \param log_likelihood  state k of chain c at entry k * chains + c
[[nodiscard]] double equilibrium_t(const Eigen::VectorXd& log_likelihood, Index chains);

}  // namespace tmcmc::detail
