/// \file
/// A log-likelihood that all ranks evaluate.
#pragma once

#include "distributed/farm.hpp"
#include "tmcmc/sampler.hpp"

namespace distributed {

/// Every rank calls this with the same problem. On rank 0 it calls `lead` with a problem whose log-likelihood is evaluated by
/// all ranks, that one included; the others evaluate until `lead` returns or throws. Rows go to the ranks as these become
/// free, as many at a time as take about 0.1 s and at most a quarter of a rank's share; the values come back into their rows, so that
/// the result of a run has the same bytes with any number of ranks.
///
/// Only the rows of one call are shared out. For a run, set Options::threads = 1 (calls from several threads wait for each other)
/// and Options::batch_rows = 0: then one call has all the samples, or with waste-free moves all Options::chains, and more
/// ranks than that have nothing to do.
///
/// An exception of the model on any rank reaches rank 0 as Farm::run says, that of the lowest row if there are several. NaN and
/// plus infinity come back as values, and the sampler's error names the point.
/// \throws AnotherRankFailed as lead_or_serve; on rank 0 what `lead` throws.
void share(Ranks& ranks, const tmcmc::Problem& problem,
           const std::function<void(const tmcmc::Problem& shared)>& lead);

}  // namespace distributed
