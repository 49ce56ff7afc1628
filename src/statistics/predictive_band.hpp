/// \file
/// What the posterior predicts for one measurement: bands of the model and of a new measurement.
#pragma once

#include <span>

#include "statistics/summary.hpp"

namespace statistics {

/// A measurement y = m(theta) + sigma(theta) z, z standard normal, under the posterior of theta.
struct PredictiveBand {
  double median = 0.0;              ///< of the model m
  Interval95 model{};               ///< central 95 % of m: the uncertainty of the parameters alone
  Interval95 measurement{};         ///< central 95 % of a new y: with the noise too
  double standard_deviation = 0.0;  ///< of a new y: sqrt(var m + mean sigma^2), var m over N
  double probability_below = 0.0;   ///< P(new y < observed), from 0 to 1
};

/// The band from draws of the posterior. Median and interval of the model are linear between the order statistics of its outputs;
/// the distribution of y is the mean of one normal distribution for each draw, (1/N) sum Phi((y - m_i) / sigma_i), so that no error is
/// drawn at random. The probability is one of a measurement that has not been used: of one that has, it lies closer to 1/2.
/// \param outputs  m_i of the model at N equally weighted draws, at least one
/// \param noise    sigma_i at the same draws, positive
/// \param observed  the measurement, in the unit of the outputs
/// \throws errors::InvalidValue for no draw, another number of sigma_i, numbers that are not finite, or sigma_i <= 0.
[[nodiscard]] PredictiveBand predictive_band(std::span<const double> outputs, std::span<const double> noise,
                                             double observed);

}  // namespace statistics
