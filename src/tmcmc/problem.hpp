/// \file
/// What is sampled.
#pragma once

#include "tmcmc/prior.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// What is sampled: the posterior proportional to likelihood times prior.
struct Problem {
  /// Of the whole population, a row a point.
  LogLikelihood log_likelihood;
  /// Normalised.
  Prior prior;
};

}  // namespace tmcmc
