/// \file
/// A noise level given the misfit: the density proportional to sigma^-n exp(-S / (2 sigma^2)) on an interval,
/// with S a sum of n squared residuals.
#pragma once

#include <cstddef>

#include "estimation/parameter_bounds.hpp"
#include "estimation/tabulated_density.hpp"

namespace estimation {

/// Logarithm of the integral of sigma^-n exp(-S / (2 sigma^2)) d sigma over [noise.lower, noise.upper],
/// by Gauss-Legendre quadrature in log(sigma), outward from the maximum, in panels as wide as the slope and
/// the curvature there allow; relative error of the integral below 1e-12 times (1 + 1e-4 times the size of
/// the logarithm), for any n >= 1 and S >= 0 including 0. (In closed form it is a difference of incomplete
/// gamma functions, for n = 1 of exponential integrals; the tests compare.) \param count  n \param misfit  S,
/// in squared units of sigma
[[nodiscard]] double log_noise_integral(std::size_t count, const Interval& noise, double misfit);

/// The smallest noise level in the interval at which the conditional density is above e^-nats of its largest.
[[nodiscard]] double smallest_noise(std::size_t count, const Interval& noise, double misfit, double nats);

/// Quantiles of the noise level given the misfit, by one table for all misfits: t = S / (2 sigma^2) has
/// density proportional to t^((n-3)/2) e^-t, which S enters through the ends of the interval only. The table
/// is in log(t). Const members may be called at the same time.
class NoiseConditional {
 public:
  /// \param smallest_misfit, largest_misfit  between which quantile() is wanted
  /// \throws IntegrationError if the table needs too many panels
  NoiseConditional(std::size_t count, const Interval& noise, double smallest_misfit, double largest_misfit);

  /// The noise level that is exceeded with probability 1 - p, 0 < p < 1, given the misfit.
  [[nodiscard]] double quantile(double misfit, double p) const;

  /// Estimated error of any probability behind a quantile, see TabulatedDensity::relative_error.
  [[nodiscard]] double relative_error() const { return table_.relative_error(); }

 private:
  [[nodiscard]] static TabulatedDensity make_table(std::size_t count, const Interval& noise,
                                                   double smallest_misfit, double largest_misfit);

  Interval noise_;
  TabulatedDensity table_;
};

}  // namespace estimation
