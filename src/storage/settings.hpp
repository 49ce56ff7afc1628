/// \file
/// The settings on which the numbers of a run depend, as names and values: they distinguish runs,
/// and show where two runs differ.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tmcmc/options.hpp"
#include "tmcmc/prior.hpp"
#include "tmcmc/random.hpp"

namespace storage {

/// Everything on which the numbers of a run depend.
struct RunDescription {
  /// Options of the sampler; threads, batch_rows and max_stages do not count.
  tmcmc::Options options;
  /// Key of the random streams.
  tmcmc::StreamKey key;
  /// Prior of the parameters.
  tmcmc::Prior prior;
  /// One line from the caller that identifies everything else: the model, its data, their version,
  /// and a step rule if one is used.
  std::string model;
};

/// Name and value; the value is one line, and numbers have enough digits to be read back as the
/// same double.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// The options (tmcmc::sample_settings), seed, study, arm, run, prior.lower, prior.upper, the text
/// of a prior that is not a box, and model.
/// \throws errors::InvalidValue if the model's description is not one line.
[[nodiscard]] Settings settings(const RunDescription& run);

}  // namespace storage
