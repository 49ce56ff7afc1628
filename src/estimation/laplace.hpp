/// \file
/// Laplace approximation of the four-dimensional posterior, for comparison with the exact one.
#pragma once

#include <array>
#include <limits>

#include "estimation/least_squares.hpp"
#include "estimation/parameter_bounds.hpp"
#include "friction/observations.hpp"
#include "friction/response.hpp"

namespace estimation {

/// Normal approximation at the mode; arrays in the order and the units of friction::Parameter. All
/// values are NaN until the approximation is computed.
struct LaplaceApproximation {
  /// Whether the mode is a regular maximum inside the bounds and below the limit of continuous
  /// motion, with noise levels that the observations determine (BlockFit::fitted_noise). If not,
  /// standard_deviation and log_evidence are NaN.
  bool regular = false;
  /// Maximiser of the likelihood.
  std::array<double, friction::parameter_count> mode{nan, nan, nan, nan};
  /// Standard deviations H_ii^(-1/2).
  std::array<double, friction::parameter_count> standard_deviation{nan, nan, nan, nan};
  /// log P(D) under normalised uniform priors.
  double log_evidence = nan;

  /// Normal density of one parameter, per its unit; NaN unless regular.
  [[nodiscard]] double marginal_density(std::size_t parameter, double x) const;

 private:
  static constexpr double nan = std::numeric_limits<double>::quiet_NaN();
};

/// Approximates the posterior under uniform priors on the bounds by a normal density at the mode,
/// which is the maximum of the likelihood. There the Hessian H of minus the log-likelihood is
/// diagonal,
///
///     H_xx = S''(x) / (2 sigma^2),   H_sigma,sigma = 2 n / sigma^2,   sigma^2 = S(x) / n,
///
/// for x = F_mu with sigma_phase and x = omega_n with sigma_r. S is the misfit; its full second
/// derivative is used (boost::math::differentiation), not the Gauss-Newton approximation. The
/// standard deviations are H_ii^(-1/2) and the log-evidence is log L + 2 log(2 pi) - 1/2 log det H
/// - log(prior volume). The error of the evidence is of order 1/n.
/// \param fit  fit_least_squares of the same observations and physics
/// \throws errors::InvalidValue for invalid bounds, observations or physics.
[[nodiscard]] LaplaceApproximation laplace_approximation(const friction::Observations& observations,
                                                         const friction::Physics& physics,
                                                         const LeastSquaresFit& fit,
                                                         const ParameterBounds& bounds);

}  // namespace estimation
