/// \file
/// The moves of a stage from its starts: the chains of each Move, and the adaptation of the
/// proposal scale.
#pragma once

#include <vector>

#include "tmcmc/detail/metropolis_step.hpp"
#include "tmcmc/options.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc::detail {

/// Work space of move_population(), reused from stage to stage.
struct StageMoveWorkspace {
  /// Current states of the waste-free chains.
  Walkers chains;
  /// Starts of the chains, from which the mixing is measured.
  Population starts;
};

/// The kernel of a stage; with Options::cross_fit one kernel for each half of the starts.
struct StageKernels {
  /// One or two kernels.
  std::vector<MetropolisKernel> kernels;
  /// Rows of each kernel if there are two; empty for one.
  std::vector<std::vector<Index>> rows;
};

/// Results of the moves of a stage.
struct StageMoves {
  /// Counts over all chains and steps.
  MoveCounts counts;
  /// See StageRecord::equilibrium_t.
  double equilibrium_t = 0.0;
  /// Metropolis steps of each chain; with growing chains those of the longest chain.
  Index steps = 0;
};

/// Moves the starts of a stage.
/// \param kernels  their scale is adapted (TargetAcceptance)
/// \param steps   Metropolis steps of each chain; not used by growing chains
/// \param most_steps  if more than `steps`, resample-move continues after `steps` steps as
///        specified by ResampleMove::mixing_correlation
/// \param walkers  in: the starts, which for growing chains are in ascending order of their
///        `ancestors`; out: the population, which for waste-free has (steps + 1) times as many rows
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
