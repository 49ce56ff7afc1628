/// \file
/// One batch of points evaluated by several calls of a model at a time.
#pragma once

#include "models/forward_model.hpp"
#include "tmcmc/types.hpp"

namespace models {

/// How a batch is shared out.
struct ParallelOptions {
  int calls = 1;                ///< most calls of the model at a time
  tmcmc::Index batch_rows = 0;  ///< most rows of a call; 0: equal shares, one for each of the calls
};

/// A log-likelihood that cuts each batch into smaller ones, contiguous in the order of the rows, and evaluates up to
/// `calls` of them at a time, each by the first thread that is free. The values have the same bytes with any options, since
/// a row's value does not depend on the other rows of its batch.
///
/// For a run set Options::threads = 1 and Options::batch_rows = 0: the sampler then hands over whole batches. The returned function
/// throws what the model throws for the lowest rows that failed; no call begins after a failure.
/// \throws errors::InvalidValue for calls < 1 or batch_rows < 0.
[[nodiscard]] tmcmc::LogLikelihood parallel_batches(tmcmc::LogLikelihood model,
                                                    const ParallelOptions& options);

/// The same of a model with outputs.
/// \throws as parallel_batches
[[nodiscard]] ForwardModel parallel_outputs(ForwardModel model, const ParallelOptions& options);

}  // namespace models
