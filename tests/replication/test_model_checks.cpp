// Checks of the phase model: what they count, and where they must find nothing.

#include <catch2/catch.hpp>
#include <cmath>

#include "replication/model_checks.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using replication::check_phase;
using replication::discretisation_errors;

}  // namespace

TEST_CASE("below the limit integration in time finds the closed form, beyond it the mass stops",
          "[model_checks]") {
  for (const double r : {0.7, 1.5}) {
    CAPTURE(r);
    const auto check = check_phase(r, 2.5, 41);
    REQUIRE(check.points.size() == 41);
    CHECK(check.points.front().force_ratio == 0.0);
    CHECK(check.points.back().force_ratio == 1.0);
    CHECK(check.compared > 10);
    CHECK(check.largest_difference_deg < 1e-6);
    CHECK(check.stopping_below == 0);
    CHECK(check.continuous_beyond == 0);
    CHECK(check.fewest_stops > 0);
    CHECK(check.lowest_deg < check.highest_deg);
    long below = 0;
    for (const auto& point : check.points) {
      CHECK(std::isnan(point.exact_deg) == (point.force_ratio > check.limit_force_ratio));
      CHECK(std::isnan(point.published_deg) == (point.force_ratio > check.limit_force_ratio_grid));
      below += point.force_ratio < check.limit_force_ratio ? 1 : 0;
    }
    CHECK(check.compared == below);  // no point of the grid lies within a thousandth of these limits
  }
}

TEST_CASE("curves of the phase angle are those of the model, without the singular ratio", "[model_checks]") {
  const friction::Physics physics;
  const auto curve = replication::phase_curves(0.5, 1.5, 3, 1.0, 1.25, physics);
  REQUIRE(curve.size() == 2);  // r = 1 has no response
  const auto c = friction::response_constants(1.5, physics);
  CHECK(curve[1].frequency_ratio == 1.5);
  CHECK(curve[1].limit_force_ratio == c.limit_force_ratio);
  CHECK(curve[1].phase_deg == friction::phase_deg(c, 0.4));
  CHECK(curve[1].phase_fitted_deg == friction::phase_deg(c, 0.5));
  CHECK(curve[1].boundary_phase_deg == friction::phase_deg(c, c.limit_force_ratio));
}

TEST_CASE("errors of the published discretisation are those of the two models", "[model_checks]") {
  const auto errors = discretisation_errors(0.5, 1.5, 3, 1.0, 2.5);
  REQUIRE(errors.size() == 2);  // r = 1 has no response
  CHECK(errors[0].frequency_ratio == 0.5);
  CHECK(errors[1].frequency_ratio == 1.5);
  for (const auto& error : discretisation_errors(1.1, 1.9, 9, 1.0, 2.5)) {
    const replication::BothModels models(error.frequency_ratio, 2.5);
    CHECK(error.phase_deg ==
          friction::phase_deg(models.published, 0.4) - friction::phase_deg(models.exact, 0.4));
    CHECK(error.limit_relative >= 0.0);  // a maximum over a grid is not above the supremum
    CHECK_THAT(error.limit_relative,
               WithinAbs(models.published.limit_force_ratio / models.exact.limit_force_ratio - 1.0, 1e-15));
  }
}
