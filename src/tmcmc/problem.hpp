/// \file
/// The problem to be sampled.
#pragma once

#include <functional>

#include "tmcmc/prior.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// The problem to be sampled: the posterior is proportional to likelihood times prior.
struct Problem {
  /// Log-likelihood of the whole population, one row per point.
  LogLikelihood log_likelihood;
  /// Normalised prior.
  Prior prior;
  /// Called from time to time during long pieces of the sampler's own work, such as the fit of a
  /// mixture, on the thread that called run(), for example to check for an interrupt. An exception
  /// that it throws ends the run; it does not change any result. May be empty.
  std::function<void()> look = {};
};

}  // namespace tmcmc
