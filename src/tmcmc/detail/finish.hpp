/// \file
/// A run whose finish is IndependentDraws.
#pragma once

#include "tmcmc/progress.hpp"
#include "tmcmc/sampler.hpp"

namespace tmcmc::detail {

/// The run from what `from` holds: nothing, or points that an earlier run with the same key has
/// evaluated. It is the same run from its beginning, in which these cost nothing.
/// \param options  valid, with the finish IndependentDraws
/// \throws as run()
[[nodiscard]] Result run_independent_draws(const Problem& problem, const Options& options,
                                           const StreamKey& key, const Progress& from,
                                           const Observer& observer);

}  // namespace tmcmc::detail
