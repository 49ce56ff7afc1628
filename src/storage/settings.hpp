/// \file
/// What the numbers of a run depend on, as names and values: to tell one run from another, and to
/// say where they differ.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tmcmc/options.hpp"
#include "tmcmc/prior.hpp"
#include "tmcmc/random.hpp"

namespace storage {

/// All that the numbers of a run depend on.
struct RunDescription {
  /// Threads, batch_rows and max_stages do not count.
  tmcmc::Options options;
  /// Of the random streams.
  tmcmc::StreamKey key;
  /// Of the parameters.
  tmcmc::Prior prior;
  /// One line of the caller's that names all else: the model, its data, their version, and a step
  /// rule if one is used.
  std::string model;
};

/// Name and value, the latter one line; numbers in digits that read back as the same double.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// The options (tmcmc::sample_settings), seed, study, arm, run, prior.lower, prior.upper, the text of a prior that is no
/// box, and model.
/// \throws errors::InvalidValue if the model's description is not one line.
[[nodiscard]] Settings settings(const RunDescription& run);

}  // namespace storage
