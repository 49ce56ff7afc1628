/// \file
/// What is sampled.
#pragma once

#include "tmcmc/prior.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// What is sampled: the posterior proportional to likelihood times prior.
struct Problem {
  LogLikelihood log_likelihood;  ///< of the whole population, a row a point
  Prior prior;                   ///< normalised
};

}  // namespace tmcmc
