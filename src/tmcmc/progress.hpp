/// \file
/// The data that a run carries from one stage to the next: everything needed to resume it.
#pragma once

#include <vector>

#include "tmcmc/evidence.hpp"
#include "tmcmc/options.hpp"
#include "tmcmc/prior.hpp"
#include "tmcmc/result.hpp"

namespace tmcmc {

/// A run after some of its stages, from which `resume` continues. With the finish IndependentDraws
/// it holds the points evaluated so far, in any order, with their log-likelihoods; beta is 0 and
/// there are no stages. `resume` then repeats the run, and takes the values of these points from
/// here.
struct Progress {
  /// Population at the last beta.
  State state;
  /// Records of the stages so far.
  std::vector<StageRecord> stages;
  /// Bridge sums; empty without Options::diagnose.
  BridgeEvidence bridge;
};

/// Checks the assumptions of resume: consistent sizes, indices within them, points in the support
/// of the prior, log-likelihoods that are neither NaN nor plus infinity, and beta in [0, 1].
/// \throws errors::InvalidValue naming the field, its value and what was expected.
void require_valid(const Progress& progress, const Prior& prior, const Options& options);

}  // namespace tmcmc
