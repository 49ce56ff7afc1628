/// \file
/// What a run carries from one stage to the next: all that it takes to go on.
#pragma once

#include <vector>

#include "tmcmc/evidence.hpp"
#include "tmcmc/options.hpp"
#include "tmcmc/prior.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// A run after some of its stages. `resume` goes on from here. With the finish IndependentDraws: the
/// points that have been evaluated so far, in any order, with their log-likelihoods; beta is 0 and there
/// are no stages. `resume` then repeats the run, and takes the values of these points from here.
struct Progress {
  /// Population at the last beta.
  State state;
  /// So far.
  std::vector<StageRecord> stages;
  /// Empty without Options::diagnose.
  BridgeEvidence bridge;
};

/// Checks what resume relies on: sizes that go together, indices within them, points in the support
/// of the prior, log-likelihoods that are none of NaN and plus infinity, beta in [0, 1].
/// \throws errors::InvalidValue naming the field, what it is and what was expected.
void require_valid(const Progress& progress, const Prior& prior, const Options& options);

}  // namespace tmcmc
