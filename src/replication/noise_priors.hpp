/// \file
/// Priors that differ from Table 2 in the noise levels alone.
#pragma once

#include <string>
#include <vector>

#include "tmcmc/prior.hpp"

namespace replication {

/// A prior of the four parameters, with a name.
struct NoisePrior {
  /// Distribution of the noise levels, as tmcmc::distributions() calls it.
  std::string name;
  /// With the uniform distributions of the box for force and frequency.
  tmcmc::Prior prior;
};

/// Noise levels that are uniform as in the box, log-uniform between the same bounds, and half-normal
/// with a standard deviation of half the upper bound.
/// \param box  bounds of the four parameters, in the order of friction::Parameter
/// \throws errors::InvalidValue for bounds that a distribution cannot have, such as a log-uniform 0.
[[nodiscard]] std::vector<NoisePrior> noise_priors(const tmcmc::Prior& box);

}  // namespace replication
