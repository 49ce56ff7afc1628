/// \file
/// A run with the finish IndependentDraws.
#pragma once

#include "tmcmc/progress.hpp"
#include "tmcmc/sampler.hpp"

namespace tmcmc::detail {

/// Runs from the contents of `from`: nothing, or points that an earlier run with the same key has
/// evaluated. The run is repeated from its beginning, with these points at no cost.
/// \param options  valid, with the finish IndependentDraws
/// \throws as run()
[[nodiscard]] Result run_independent_draws(const Problem& problem, const Options& options,
                                           const StreamKey& key, const Progress& from,
                                           const Observer& observer);

}  // namespace tmcmc::detail
