/// \file
/// Independent priors of the four parameters that are not uniform, prepared for quadrature.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "estimation/parameter_bounds.hpp"

namespace estimation {

/// Prior density of one parameter on an interval outside which there is practically no probability.
struct ParameterPrior {
  /// Logarithm of the density, normalised; finite between the first and the last of `breaks`.
  std::function<double(double)> log_density;
  /// Ascending, at least two: the ends of the interval, and points between them that split the
  /// density into pieces on which it is smooth and changes by a few powers of e, such as quantiles.
  std::vector<double> breaks;

  /// The interval from the first to the last break.
  [[nodiscard]] Interval range() const { return {breaks.front(), breaks.back()}; }
};

/// One prior per parameter, in the order and the units of friction::Parameter.
using ParameterPriors = std::array<ParameterPrior, friction::parameter_count>;

/// The intervals of the priors.
/// \throws errors::InvalidValue as validate(ParameterBounds), and for fewer than two breaks or
///         breaks that do not ascend.
[[nodiscard]] ParameterBounds ranges_of(const ParameterPriors& priors);

/// The integral over a noise level sigma of prior(sigma) sigma^-n exp(-S / (2 sigma^2)), for many
/// misfits S, by Gauss-Legendre quadrature in log(sigma). The nodes are chosen once; the panels end
/// at the breaks and are as narrow as n observations require.
class NoiseIntegral {
 public:
  /// \param count  number of observations n
  NoiseIntegral(std::size_t count, const ParameterPrior& prior);

  /// Logarithm of the integral.
  /// \param misfit  S, in squared units of sigma
  [[nodiscard]] double operator()(double misfit) const;

  /// The smallest noise level at which the integrand in log(sigma) exceeds e^-nats times its
  /// maximum.
  [[nodiscard]] double smallest_noise(double misfit, double nats) const;

 private:
  // log of (weight times prior(sigma) sigma^(1-n))
  std::vector<double> log_terms_;
  // 1 / (2 sigma^2)
  std::vector<double> half_precision_;
};

}  // namespace estimation
