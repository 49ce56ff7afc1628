/// \file
/// Posterior prediction of one measurement: bands of the model and of a new measurement.
#pragma once

#include <span>

#include "statistics/summary.hpp"

namespace statistics {

/// Prediction of a measurement y = m(theta) + sigma(theta) z, z standard normal, under the
/// posterior of theta.
struct PredictiveBand {
  /// Median of the model output m.
  double median = 0.0;
  /// Central 95 % of m: the uncertainty of the parameters alone.
  Interval95 model{};
  /// Central 95 % of a new y: including the noise.
  Interval95 measurement{};
  /// Standard deviation of a new y: sqrt(var m + mean sigma^2), where var m is taken with 1/N.
  double standard_deviation = 0.0;
  /// P(new y < observed), from 0 to 1.
  double probability_below = 0.0;
};

/// The band computed from draws of the posterior. Median and interval of the model are interpolated
/// linearly between the order statistics of its outputs; the distribution of y is the mean of the
/// normal distributions of the draws, (1/N) sum Phi((y - m_i) / sigma_i), so that no error is drawn
/// at random. The probability applies to a measurement that has not been used in the inference: for
/// one that has, it lies closer to 1/2.
/// \param outputs  outputs m_i of the model at N equally weighted draws, at least one
/// \param noise  sigma_i at the same draws, positive
/// \param observed  the measurement, in the unit of the outputs
/// \throws errors::InvalidValue if there is no draw, if the number of sigma_i differs, if a number
///         is not finite, or if sigma_i <= 0.
[[nodiscard]] PredictiveBand predictive_band(std::span<const double> outputs, std::span<const double> noise,
                                             double observed);

}  // namespace statistics
