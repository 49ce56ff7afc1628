#include "estimation/laplace.hpp"

#include <boost/math/differentiation/autodiff.hpp>
#include <cmath>

#include "friction/angle.hpp"

namespace estimation {

namespace {

/// Second derivative of the sum over the observations of residual(i, x)^2.
template <class Residual>
double misfit_curvature(std::size_t count, double x, Residual residual) {
  const auto variable = boost::math::differentiation::make_fvar<double, 2>(x);
  double sum = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = residual(i, variable);
    const auto square = value * value;
    sum += square.derivative(2U);
  }
  return sum;
}

}  // namespace

double LaplaceApproximation::marginal_density(std::size_t parameter, double x) const {
  const double sd = standard_deviation.at(parameter);
  const double z = (x - mode.at(parameter)) / sd;
  return portable_math::exp(-0.5 * z * z) / (sd * std::sqrt(2.0 * std::numbers::pi));
}

LaplaceApproximation laplace_approximation(const friction::Observations& observations,
                                           const friction::Physics& physics, const LeastSquaresFit& fit,
                                           const ParameterBounds& bounds) {
  validate(bounds);
  const friction::Likelihood likelihood(observations, physics);  // validates observations and physics
  const std::size_t count = observations.size();
  LaplaceApproximation result;
  result.mode = {fit.friction_force.estimate, fit.natural_frequency.estimate, fit.friction_force.noise_ml,
                 fit.natural_frequency.noise_ml};
  for (std::size_t p = 0; p < result.mode.size(); ++p) {
    if (!bounds[p].has_inside(result.mode[p])) {
      return result;
    }
  }
  if (fit.friction_force.at_bound || fit.natural_frequency.at_bound) {
    return result;
  }

  const double phase_curvature =
      misfit_curvature(count, result.mode[friction::friction_force], [&](std::size_t i, const auto& x) {
        using T = std::decay_t<decltype(x)>;
        const auto constants = friction::response_constants(observations.measured_ratio[i], physics);
        const T force_ratio = x / physics.driving_force_n;
        return T(friction::angle_residual_deg(observations.phase_deg[i],
                                              friction::phase_deg(constants, force_ratio)));
      });
  const double ratio_curvature =
      misfit_curvature(count, result.mode[friction::natural_frequency], [&](std::size_t i, const auto& x) {
        using T = std::decay_t<decltype(x)>;
        return T(observations.nominal_ratio[i] - observations.driving_frequency_hz[i] / x);
      });
  if (!(phase_curvature > 0.0 && ratio_curvature > 0.0)) {
    return result;
  }

  const double sigma_phase = result.mode[friction::phase_noise];
  const double sigma_ratio = result.mode[friction::frequency_ratio_noise];
  const double noise_scale = 1.0 / std::sqrt(2.0 * static_cast<double>(count));
  result.standard_deviation = {sigma_phase * std::sqrt(2.0 / phase_curvature),
                               sigma_ratio * std::sqrt(2.0 / ratio_curvature), sigma_phase * noise_scale,
                               sigma_ratio * noise_scale};
  result.log_evidence = fit.log_likelihood() + 2.0 * std::log(2.0 * std::numbers::pi) - log_volume(bounds);
  for (const double deviation : result.standard_deviation) {
    result.log_evidence += std::log(deviation);
  }
  result.regular = true;
  return result;
}

}  // namespace estimation
