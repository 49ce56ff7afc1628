/// \file
/// A noise level given the misfit: the density proportional to sigma^-n exp(-S / (2 sigma^2)) on an
/// interval, where S is a sum of n squared residuals.
#pragma once

#include <cstddef>

#include "estimation/parameter_bounds.hpp"
#include "estimation/tabulated_density.hpp"

namespace estimation {

/// Logarithm of the integral of sigma^-n exp(-S / (2 sigma^2)) d sigma over [noise.lower,
/// noise.upper], by Gauss-Legendre quadrature in log(sigma), outward from the maximum, in panels as
/// wide as the slope and the curvature there allow. The relative error of the integral is below
/// 1e-12 times (1 + 1e-4 times the size of the logarithm), for any n >= 1 and S >= 0 including 0.
/// (In closed form the integral is a difference of incomplete gamma functions, for n = 1 of
/// exponential integrals; the tests compare with these.)
/// \param count  n
/// \param misfit  S, in squared units of sigma
[[nodiscard]] double log_noise_integral(std::size_t count, const Interval& noise, double misfit);

/// The smallest noise level in the interval at which the conditional density exceeds e^-nats times
/// its maximum.
[[nodiscard]] double smallest_noise(std::size_t count, const Interval& noise, double misfit, double nats);

/// Quantiles of the noise level given the misfit, from one table for all misfits: t = S / (2
/// sigma^2) has density proportional to t^((n-3)/2) e^-t, in which S enters only through the ends
/// of the interval. The table is in log(t). Const members may be called concurrently.
class NoiseConditional {
 public:
  /// \param smallest_misfit, largest_misfit  range of misfits for which quantile() may be called
  /// \throws IntegrationError if the table needs too many panels
  NoiseConditional(std::size_t count, const Interval& noise, double smallest_misfit, double largest_misfit);

  /// The p-quantile of the noise level given the misfit, 0 < p < 1.
  [[nodiscard]] double quantile(double misfit, double p) const;

  /// Estimated error of any probability from which a quantile is computed, see
  /// TabulatedDensity::relative_error.
  [[nodiscard]] double relative_error() const { return table_.relative_error(); }

 private:
  [[nodiscard]] static TabulatedDensity make_table(std::size_t count, const Interval& noise,
                                                   double smallest_misfit, double largest_misfit);

  Interval noise_;
  TabulatedDensity table_;
};

}  // namespace estimation
