/// \file
/// One batch of points evaluated by several concurrent calls of a model.
#pragma once

#include "models/forward_model.hpp"
#include "tmcmc/types.hpp"

namespace models {

/// How a batch is divided.
struct ParallelOptions {
  /// Largest number of concurrent calls of the model.
  int calls = 1;
  /// Largest number of rows per call; 0: equal shares, one per call.
  tmcmc::Index batch_rows = 0;
};

/// A log-likelihood that cuts each batch into smaller ones, contiguous in the order of the rows,
/// and evaluates up to `calls` of them at a time, each by the first thread that is free. The values
/// are byte-identical for all options, since a row's value does not depend on the other rows of its
/// batch.
///
/// For a run set Options::threads = 1 and Options::batch_rows = 0: the sampler then hands over
/// whole batches. If calls fail, the returned function throws the exception of the failed call with
/// the lowest rows; no call begins after a failure.
/// \throws errors::InvalidValue for calls < 1 or batch_rows < 0.
[[nodiscard]] tmcmc::LogLikelihood parallel_batches(tmcmc::LogLikelihood model,
                                                    const ParallelOptions& options);

/// As parallel_batches, for a model with outputs.
/// \throws as parallel_batches
[[nodiscard]] ForwardModel parallel_outputs(ForwardModel model, const ParallelOptions& options);

}  // namespace models
