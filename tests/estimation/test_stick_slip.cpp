// The posterior beyond the limit of continuous motion, against a sum over a fine grid.

#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/noise_conditional.hpp"
#include "estimation/stick_slip.hpp"
#include "friction/angle.hpp"
#include "friction/time_integration.hpp"
#include "rows.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using estimation::ExactPosterior;
using estimation::posterior_with_stick_slip;

struct Sums {
  double mass = 0.0, first = 0.0, second = 0.0;
};

/// Moments of F_mu from `low` to `high` relative to the evidence without stick-slip, by the
/// midpoint rule.
Sums midpoint_sums(const friction::Observations& o, const ExactPosterior& excluded,
                   const estimation::Interval& noise, double low, double high) {
  constexpr int steps = 1500;
  const auto& force = excluded.marginal(friction::friction_force);
  Sums sums;
  for (int k = 0; k < steps; ++k) {
    const double x = low + (high - low) * (k + 0.5) / steps;
    double misfit = 0.0;
    for (std::size_t i = 0; i < o.size(); ++i) {
      const double phase = friction::integrate_steady_response(o.measured_ratio[i], x / 2.5).phase_deg;
      misfit += std::pow(friction::angle_residual_deg(o.phase_deg[i], phase), 2);
    }
    const double weight =
        (high - low) / steps *
        std::exp(estimation::log_noise_integral(o.size(), noise, misfit) - force.log_integral());
    const double d = x - force.mean();
    sums.mass += weight;
    sums.first += weight * d;
    sums.second += weight * d * d;
  }
  return sums;
}

}  // namespace

TEST_CASE("stick-slip that is computed adds the posterior beyond the limit", "[estimation]") {
  auto o = rows::first(3, rows::table1());
  o.phase_deg = {55.0, 75.0, 100.0};  // between the phases that continuous motion can have and those of rest
  auto bounds = rows::table2();
  bounds[friction::phase_noise].upper = 30.0;
  const friction::Likelihood likelihood(o, {});
  const ExactPosterior excluded(likelihood, bounds);
  const auto computed = posterior_with_stick_slip(o, likelihood, excluded, bounds);
  const auto sums =
      midpoint_sums(o, excluded, bounds[friction::phase_noise], likelihood.limit_friction_force_n(), 2.5);
  REQUIRE(sums.mass > 0.05);
  const double total = 1.0 + sums.mass;
  CHECK_THAT(computed.probability, WithinRel(sums.mass / total, 1e-3));
  CHECK(std::fabs(computed.probability - sums.mass / total) <= computed.probability_error);
  CHECK_THAT(computed.mean_shift, WithinRel(sums.first / total, 1e-3));
  CHECK_THAT(computed.log_evidence_change, WithinRel(std::log(total), 1e-3));
  const double sd = excluded.marginal(friction::friction_force).standard_deviation();
  const double shift = sums.first / total;
  CHECK_THAT(computed.standard_deviation,
             WithinRel(std::sqrt((sd * sd + sums.second) / total - shift * shift), 1e-3));
}

TEST_CASE("a prior that ends below the limit leaves nothing beyond it", "[estimation]") {
  const auto o = rows::table1();
  auto bounds = rows::table2();
  const friction::Likelihood likelihood(o, {});
  bounds[friction::friction_force].upper = 0.99 * likelihood.limit_friction_force_n();
  const ExactPosterior excluded(likelihood, bounds);
  const auto computed = posterior_with_stick_slip(o, likelihood, excluded, bounds);
  CHECK(computed.probability == 0.0);
  CHECK(computed.mean_shift == 0.0);
  CHECK(computed.log_evidence_change == 0.0);
  CHECK_THAT(computed.standard_deviation,
             WithinAbs(excluded.marginal(friction::friction_force).standard_deviation(), 1e-15));
}
