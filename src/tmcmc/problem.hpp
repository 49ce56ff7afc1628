/// \file
/// What is sampled.
#pragma once

#include <functional>

#include "tmcmc/prior.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// What is sampled: the posterior proportional to likelihood times prior.
struct Problem {
  /// Of the whole population, a row per point.
  LogLikelihood log_likelihood;
  /// Normalised.
  Prior prior;
  /// Called now and then between pieces of the sampler's own work where that takes long, such as the fit of a mixture, on the
  /// thread that called run(), to look for an interrupt for instance. What it throws ends the run; it changes no result. Empty
  /// for none.
  std::function<void()> look = {};
};

}  // namespace tmcmc
