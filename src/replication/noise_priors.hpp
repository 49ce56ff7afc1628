/// \file
/// Priors that differ from Table 2 only in the noise levels.
#pragma once

#include <string>
#include <vector>

#include "tmcmc/prior.hpp"

namespace replication {

/// A named prior of the four parameters.
struct NoisePrior {
  /// Distribution of the noise levels, as named in tmcmc::distributions().
  std::string name;
  /// The prior, with the uniform distributions of the box for force and frequency.
  tmcmc::Prior prior;
};

/// Priors whose noise levels are uniform as in the box, log-uniform between the same bounds, and
/// half-normal with a standard deviation of half the upper bound.
/// \param box  bounds of the four parameters, in the order of friction::Parameter
/// \throws errors::InvalidValue for bounds that a distribution cannot have, such as a log-uniform
///         0.
[[nodiscard]] std::vector<NoisePrior> noise_priors(const tmcmc::Prior& box);

}  // namespace replication
