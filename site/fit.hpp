/// \file
/// Least squares in the browser: the minima of estimation::fit_least_squares, without Ceres'
/// solver, which cannot be had there. TinySolver (Levenberg-Marquardt, of the same project) and
/// automatic derivatives take its place.
#pragma once

#include "friction/observations.hpp"
#include "friction/response.hpp"

namespace site {

/// A weighted fit with one unknown, as estimation::BlockFit has it.
struct Fit {
  /// N or Hz.
  double estimate = 0.0;
  /// Maximum-likelihood noise level; NaN for one observation or a perfect fit.
  double noise = 0.0;
  /// With that noise; NaN where it is.
  double standard_error = 0.0;
  /// The limit of continuous motion, or 0.
  bool at_bound = false;
};

/// F_mu from the phases, in the interval of continuous motion.
/// \throws errors::InvalidValue for invalid observations or physics.
[[nodiscard]] Fit fit_friction_force(const friction::Observations& observations,
                                     const friction::Physics& physics);

/// omega_n from the nominal ratios: linear in 1/omega_n, hence in closed form.
[[nodiscard]] Fit fit_natural_frequency(const friction::Observations& observations);

}  // namespace site
