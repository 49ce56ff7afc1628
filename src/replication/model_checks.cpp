#include "replication/model_checks.hpp"

#include <algorithm>
#include <cmath>

#include "friction/time_integration.hpp"
#include "statistics/summary.hpp"

namespace replication {

namespace {

/// At a smaller relative distance from the limit the integrator can mistake a near stop for a stop.
constexpr double near_limit = 1e-3;

}  // namespace

BothModels::BothModels(double frequency_ratio, double driving_force_n)
    : exact(friction::response_constants(frequency_ratio, {.driving_force_n = driving_force_n})),
      published(friction::response_constants(frequency_ratio, {.driving_force_n = driving_force_n,
                                                               .limit = friction::LimitRule::grid,
                                                               .phase = friction::PhaseRule::discrete_bin})) {
}

PhaseCheck check_phase(double frequency_ratio, double driving_force_n, long points) {
  const BothModels models(frequency_ratio, driving_force_n);
  PhaseCheck check;
  check.frequency_ratio = frequency_ratio;
  check.limit_force_ratio = models.exact.limit_force_ratio;
  check.limit_force_ratio_grid = models.published.limit_force_ratio;
  for (const double phi : statistics::evenly_spaced(0.0, 1.0, points)) {
    const auto integrated = friction::integrate_steady_response(frequency_ratio, phi);
    const double exact = friction::phase_deg(models.exact, phi);
    const double published = friction::phase_deg(models.published, phi);
    check.points.push_back({phi, exact, published, integrated.phase_deg, integrated.stops_per_period});
    const double beyond = phi / models.exact.limit_force_ratio - 1.0;
    if (integrated.state != friction::SteadyState::periodic || std::fabs(beyond) < near_limit) {
      continue;
    }
    if (beyond < 0.0) {
      check.largest_difference_deg =
          std::max(check.largest_difference_deg, std::fabs(integrated.phase_deg - exact));
      check.stopping_below += integrated.continuous ? 0 : 1;
      ++check.compared;
    } else {
      const double error = std::isnan(published) ? 0.0 : std::fabs(published - integrated.phase_deg);
      check.published_error_deg = std::max(check.published_error_deg, error);
      check.lowest_deg = std::min(check.lowest_deg, integrated.phase_deg);
      check.highest_deg = std::max(check.highest_deg, integrated.phase_deg);
      check.fewest_stops = std::min(check.fewest_stops, integrated.stops_per_period);
      check.most_stops = std::max(check.most_stops, integrated.stops_per_period);
      check.continuous_beyond += integrated.continuous ? 1 : 0;
    }
  }
  return check;
}

std::vector<DiscretisationError> discretisation_errors(double lowest, double highest, long points,
                                                       double friction_force_n, double driving_force_n) {
  std::vector<DiscretisationError> errors;
  for (const double r : statistics::evenly_spaced(lowest, highest, points)) {
    if (friction::is_singular_ratio(r)) {
      continue;
    }
    const BothModels models(r, driving_force_n);
    const double phi = friction_force_n / driving_force_n;
    errors.push_back({r, friction::phase_deg(models.published, phi) - friction::phase_deg(models.exact, phi),
                      models.published.limit_force_ratio / models.exact.limit_force_ratio - 1.0});
  }
  return errors;
}

std::vector<CurvePoint> phase_curves(double lowest, double highest, long points, double friction_force_n,
                                     double fitted_force_n, const friction::Physics& physics) {
  std::vector<CurvePoint> curve;
  for (const double r : statistics::evenly_spaced(lowest, highest, points)) {
    if (!friction::is_singular_ratio(r)) {
      const auto c = friction::response_constants(r, physics);
      curve.push_back({r, friction::phase_deg(c, friction_force_n / physics.driving_force_n),
                       friction::phase_deg(c, c.limit_force_ratio), c.limit_force_ratio,
                       friction::phase_deg(c, fitted_force_n / physics.driving_force_n)});
    }
  }
  return curve;
}

}  // namespace replication
