/// \file
/// Den Hartog's solution and the published discretisation compared with integration of Eq. 10 in
/// time.
#pragma once

#include <vector>

#include "friction/response.hpp"

namespace replication {

/// The same motion in the exact model and in the published discretisation (phase from a 901-point
/// transform, limit of Eq. 18 on a grid of 14 points).
struct BothModels {
  /// friction::Physics with its defaults.
  friction::ResponseConstants exact;
  /// LimitRule::grid and PhaseRule::discrete_bin.
  friction::ResponseConstants published;
  /// \throws errors::InvalidValue for a ratio without a response.
  BothModels(double frequency_ratio, double driving_force_n);
};

/// One motion: phases in deg, NaN where a model has none.
struct PhasePoint {
  /// Friction force over driving force.
  double force_ratio = 0.0;
  /// Closed form.
  double exact_deg = 0.0;
  /// Bin of the published transform.
  double published_deg = 0.0;
  /// Phase by integration in time.
  double integrated_deg = 0.0;
  /// Stops per period of the integrated motion.
  int stops_per_period = 0;
};

/// Motions at one frequency ratio, and the comparison of the models with the integration in time.
struct PhaseCheck {
  /// Driving over natural frequency.
  double frequency_ratio = 0.0;
  /// phi_lim, exact.
  double limit_force_ratio = 0.0;
  /// phi_lim as published.
  double limit_force_ratio_grid = 0.0;
  /// Force ratios equidistant from 0 to 1.
  std::vector<PhasePoint> points;
  /// Exact against integrated, below the limit.
  double largest_difference_deg = 0.0;
  /// Points behind largest_difference_deg.
  long compared = 0;
  /// Motions among the compared ones that stop.
  long stopping_below = 0;
  /// Largest error of the published phase between exact and published limit.
  double published_error_deg = 0.0;
  /// Smallest phase beyond the limit.
  double lowest_deg = 360.0;
  /// Largest phase beyond the limit.
  double highest_deg = 0.0;
  /// Fewest stops per period beyond the limit.
  int fewest_stops = 1000000;
  /// Most stops per period beyond the limit.
  int most_stops = 0;
  /// Motions beyond the limit that do not stop.
  long continuous_beyond = 0;
};

/// Analytic and integrated phases over force ratios. Points within 1e-3 of the limit, where the
/// integrator can mistake a near stop for a stop, and motions that are not periodic are not
/// compared.
/// \param points  2 or more
[[nodiscard]] PhaseCheck check_phase(double frequency_ratio, double driving_force_n, long points);

/// The error of the published discretisation at one frequency ratio.
struct DiscretisationError {
  /// Driving over natural frequency.
  double frequency_ratio = 0.0;
  /// Published phase minus the exact one.
  double phase_deg = 0.0;
  /// Published limit over the exact one, minus 1.
  double limit_relative = 0.0;
};

/// Errors of the published discretisation at frequency ratios equidistant from `lowest` to
/// `highest`, without the singular ones.
/// \param points  2 or more
[[nodiscard]] std::vector<DiscretisationError> discretisation_errors(double lowest, double highest,
                                                                     long points, double friction_force_n,
                                                                     double driving_force_n);

/// A point of the curves of Figure 2. Phases are in deg, NaN where the motion is not continuous.
struct CurvePoint {
  /// Driving over natural frequency.
  double frequency_ratio;
  /// Phase with the friction force.
  double phase_deg;
  /// On Den Hartog's boundary, where the force ratio is at its limit.
  double boundary_phase_deg;
  /// Limit of continuous motion (Eq. 18).
  double limit_force_ratio;
  /// Phase with the fitted friction force.
  double phase_fitted_deg;
};

/// The curves at frequency ratios equidistant from `lowest` to `highest`, without the singular
/// ones.
/// \param points  2 or more
[[nodiscard]] std::vector<CurvePoint> phase_curves(double lowest, double highest, long points,
                                                   double friction_force_n, double fitted_force_n,
                                                   const friction::Physics& physics);

}  // namespace replication
