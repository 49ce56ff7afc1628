/// \file
/// Den Hartog's solution and the published discretisation compared with integration of Eq. 10 in time.
#pragma once

#include <vector>

#include "friction/response.hpp"

namespace replication {

/// The same motion in the exact model and in the published discretisation (phase from a 901-point transform,
/// limit of Eq. 18 on a grid of 14 points).
struct BothModels {
  friction::ResponseConstants exact;      ///< friction::Physics with its defaults
  friction::ResponseConstants published;  ///< LimitRule::grid and PhaseRule::discrete_bin
  /// \throws errors::InvalidValue for a ratio without a response.
  BothModels(double frequency_ratio, double driving_force_n);
};

/// One motion: phases in deg, NaN where a model has none.
struct PhasePoint {
  double force_ratio = 0.0;     ///< friction force over driving force
  double exact_deg = 0.0;       ///< closed form
  double published_deg = 0.0;   ///< bin of the published transform
  double integrated_deg = 0.0;  ///< integration in time
  int stops_per_period = 0;     ///< stops per period of the integrated motion
};

/// Motions at one frequency ratio, and the comparison of the models with the integration in time.
struct PhaseCheck {
  double frequency_ratio = 0.0;         ///< driving over natural frequency
  double limit_force_ratio = 0.0;       ///< phi_lim, exact
  double limit_force_ratio_grid = 0.0;  ///< phi_lim as published
  std::vector<PhasePoint> points;       ///< force ratios equidistant from 0 to 1
  double largest_difference_deg = 0.0;  ///< exact against integrated, below the limit
  long compared = 0;                    ///< points behind largest_difference_deg
  long stopping_below = 0;              ///< motions among the compared ones that stop
  double published_error_deg =
      0.0;                     ///< largest error of the published phase between exact and published limit
  double lowest_deg = 360.0;   ///< smallest phase beyond the limit
  double highest_deg = 0.0;    ///< largest phase beyond the limit
  int fewest_stops = 1000000;  ///< fewest stops per period beyond the limit
  int most_stops = 0;          ///< most stops per period beyond the limit
  long continuous_beyond = 0;  ///< motions beyond the limit that do not stop
};

/// Analytic and integrated phases over force ratios. Points within 1e-3 of the limit, where the integrator
/// can mistake a near stop for a stop, and motions that are not periodic are not compared.
/// \param points  2 or more
[[nodiscard]] PhaseCheck check_phase(double frequency_ratio, double driving_force_n, long points);

/// The error of the published discretisation at one frequency ratio.
struct DiscretisationError {
  double frequency_ratio = 0.0;  ///< driving over natural frequency
  double phase_deg = 0.0;        ///< published phase minus the exact one
  double limit_relative = 0.0;   ///< published limit over the exact one, minus 1
};

/// Errors of the published discretisation at frequency ratios equidistant from `lowest` to `highest`,
/// without the singular ones.
/// \param points  2 or more
[[nodiscard]] std::vector<DiscretisationError> discretisation_errors(double lowest, double highest,
                                                                     long points, double friction_force_n,
                                                                     double driving_force_n);

/// A point of the curves of Figure 2. Phases are in deg, NaN where the motion is not continuous.
struct CurvePoint {
  double frequency_ratio;     ///< driving over natural frequency
  double phase_deg;           ///< with the friction force
  double boundary_phase_deg;  ///< on Den Hartog's boundary, where the force ratio is at its limit
  double limit_force_ratio;   ///< limit of continuous motion (Eq. 18)
  double phase_fitted_deg;    ///< with the fitted friction force
};

/// The curves at frequency ratios equidistant from `lowest` to `highest`, without the singular ones.
/// \param points  2 or more
[[nodiscard]] std::vector<CurvePoint> phase_curves(double lowest, double highest, long points,
                                                   double friction_force_n, double fitted_force_n,
                                                   const friction::Physics& physics);

}  // namespace replication
