/// \file
/// Number of Metropolis steps of a stage, also under a budget of log-likelihoods.
#pragma once

#include "tmcmc/options.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc::detail {

/// Number of chains of a stage after the first.
[[nodiscard]] Index chains_of(const Options& options);

/// Numbers of Metropolis steps of each chain in a stage.
struct StageSteps {
  Index least = 0;
  /// More than `least` if the chains continue until they have mixed.
  Index most = 0;
};

/// Steps of the stage from `from` to the temperature `next`: as given in the options, or in the
/// last stage as many as the budget holds. Before the last stage, waste-free chains share the
/// budget with the stages that are expected to follow, so that the number of stages does not decide
/// whether beta = 1 is reached.
[[nodiscard]] StageSteps steps_of(const Options& options, const State& from, double next);

/// Whether the budget holds the stage from `from` to the temperature `next`.
[[nodiscard]] bool fits_budget(const Options& options, const State& from, double next);

}  // namespace tmcmc::detail
