#include "estimation/stick_slip.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <map>
#include <vector>

#include "estimation/noise_conditional.hpp"
#include "friction/angle.hpp"
#include "friction/time_integration.hpp"
#include "portable_math/elementary.hpp"

namespace estimation {

namespace {

/// Posterior masses below this are not refined.
constexpr double negligible_mass = 1e-20;

/// Sum of squared phase residuals, where the phase comes from integration in time if an
/// observation's motion is not continuous; NaN from phi = 1 on, where the mass stays at rest and
/// has no phase.
double misfit_with_stick_slip(const friction::Observations& observations,
                              const std::vector<friction::ResponseConstants>& constants, double phi) {
  double sum = 0.0;
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const double phase =
        phi <= constants[i].limit_force_ratio
            ? friction::phase_deg(constants[i], phi)
            : friction::integrate_steady_response(constants[i].frequency_ratio, phi).phase_deg;
    const double residual = friction::angle_residual_deg(observations.phase_deg[i], phase);
    sum += residual * residual;
  }
  return sum;
}

/// Posterior mass of the friction forces beyond the limit, with their first two moments about a
/// centre, as multiples of the mass below it.
struct Beyond {
  double mass = 0.0, first = 0.0, second = 0.0;
  /// Of the mass.
  double error = 0.0;
};

Beyond integrate_beyond(const friction::Observations& observations, double driving_force_n,
                        const Interval& force, const Interval& noise, double log_mass_below, double centre) {
  std::vector<friction::ResponseConstants> constants;
  constants.reserve(observations.size());
  for (const double r : observations.measured_ratio) {
    constants.push_back(friction::response_constants(r, {.driving_force_n = driving_force_n}));
  }
  // The misfit has a kink at each force at which the motion of one more observation ceases to be
  // continuous.
  const double top = std::min(force.upper, driving_force_n);
  std::vector<double> limits;
  for (const auto& c : constants) {
    limits.push_back(std::clamp(c.limit_force_ratio * driving_force_n, force.lower, top));
  }
  std::sort(limits.begin(), limits.end());
  std::vector<double> ends = {limits.front()};
  for (const double limit : limits) {
    if (limit - ends.back() > (top - limits.front()) / 64.0) {
      ends.push_back(limit);
    }
  }
  ends.push_back(top);
  std::map<double, double> known;
  const auto density = [&](double x) {
    const auto [place, is_new] = known.try_emplace(x, 0.0);
    if (is_new) {
      const double misfit = misfit_with_stick_slip(observations, constants, x / driving_force_n);
      place->second =
          std::isnan(misfit)
              ? 0.0
              : portable_math::exp(log_noise_integral(observations.size(), noise, misfit) - log_mass_below);
    }
    return place->second;
  };
  Beyond beyond;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (!(ends[i] < ends[i + 1])) {
      continue;
    }
    const auto integral = [&](int power, unsigned depth, double* error) {
      return boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
          [&](double x) {
            const double d = x - centre;
            return density(x) * (power == 0 ? 1.0 : power == 1 ? d : d * d);
          },
          ends[i], ends[i + 1], depth, 1e-7, error);
    };
    double error = 0.0;
    const unsigned depth = integral(0, 0, nullptr) > negligible_mass ? 6 : 0;
    beyond.mass += integral(0, depth, &error);
    beyond.first += integral(1, depth, nullptr);
    beyond.second += integral(2, depth, nullptr);
    beyond.error += error;
  }
  return beyond;
}

}  // namespace

StickSlipPosterior posterior_with_stick_slip(const friction::Observations& observations,
                                             const friction::Likelihood& likelihood,
                                             const ExactPosterior& excluded, const ParameterBounds& bounds) {
  const auto& force = excluded.marginal(friction::friction_force);
  const double sd = force.standard_deviation();
  const Beyond beyond =
      integrate_beyond(observations, likelihood.driving_force_n(), bounds[friction::friction_force],
                       bounds[friction::phase_noise], force.log_integral(), force.mean());
  const double total = 1.0 + beyond.mass;
  StickSlipPosterior result;
  result.probability = beyond.mass / total;
  result.probability_error = beyond.error / total;
  result.mean_shift = beyond.first / total;
  result.standard_deviation =
      std::sqrt((sd * sd + beyond.second) / total - result.mean_shift * result.mean_shift);
  result.log_evidence_change = portable_math::log(total);
  return result;
}

}  // namespace estimation
