// The Laplace approximation against the exact posterior.

#include <catch2/catch.hpp>
#include <cmath>

#include "estimation/exact_posterior.hpp"
#include "estimation/laplace.hpp"
#include "rows.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using estimation::ExactPosterior;
using estimation::fit_least_squares;
using estimation::laplace_approximation;

}  // namespace

TEST_CASE("the Laplace approximation has the curvature of the likelihood", "[estimation]") {
  const auto o = rows::table1();
  const friction::Likelihood likelihood(o, rows::as_published());
  const auto laplace = laplace_approximation(o, rows::as_published(),
                                             fit_least_squares(o, rows::as_published()), rows::table2());
  REQUIRE(laplace.regular);
  for (int p = 0; p < 4; ++p) {
    CAPTURE(p);
    const double h = 0.01 * laplace.standard_deviation[static_cast<std::size_t>(p)];
    Eigen::MatrixXd points(3, 4);
    for (int row = 0; row < 3; ++row) {
      points.row(row) = Eigen::Map<const Eigen::RowVector4d>(laplace.mode.data());
      points(row, p) += (row - 1) * h;
    }
    Eigen::VectorXd value(3);
    likelihood(points, value);
    const double curvature = (2.0 * value[1] - value[0] - value[2]) / (h * h);
    CHECK_THAT(1.0 / std::sqrt(curvature),
               WithinRel(laplace.standard_deviation[static_cast<std::size_t>(p)], 1e-3));
  }
}

TEST_CASE("the Laplace evidence misses the exact one by a constant over n", "[estimation]") {
  struct Case {
    friction::Observations observations;
    friction::Physics physics;
  };
  for (const Case& c : {Case{rows::table1(), rows::as_published()}, Case{rows::synthetic(100, 2.0, 0.01), {}},
                        Case{rows::synthetic(2000, 2.0, 0.01), {}}}) {
    const auto n = static_cast<double>(c.observations.size());
    const auto laplace = laplace_approximation(c.observations, c.physics,
                                               fit_least_squares(c.observations, c.physics), rows::table2());
    const ExactPosterior exact(friction::Likelihood(c.observations, c.physics), rows::table2());
    CHECK_THAT(n * (exact.log_evidence() - laplace.log_evidence), WithinAbs(4.5, 0.5));
    for (int p = 0; p < 4; ++p) {
      const auto& marginal = exact.marginal(static_cast<friction::Parameter>(p));
      const double ratio =
          laplace.standard_deviation[static_cast<std::size_t>(p)] / marginal.standard_deviation();
      CHECK_THAT(ratio, WithinAbs(1.0, 4.0 / n));
    }
  }
}

TEST_CASE("a mode that is not inside is not approximated", "[estimation]") {
  const auto is_refused = [](const friction::Observations& o, const estimation::ParameterBounds& bounds) {
    const auto laplace =
        laplace_approximation(o, rows::as_published(), fit_least_squares(o, rows::as_published()), bounds);
    return !laplace.regular && std::isnan(laplace.log_evidence) && std::isnan(laplace.standard_deviation[0]);
  };
  CHECK(is_refused(rows::first(1, rows::table1()), rows::table2()));  // the noise level would be 0
  auto bounds = rows::table2();
  bounds[friction::friction_force].upper = 0.9;
  CHECK(is_refused(rows::table1(), bounds));
  auto limit = rows::table1();
  limit.phase_deg.assign(10, 110.0);
  bounds = rows::table2();
  bounds[friction::phase_noise].upper = 100.0;
  CHECK(is_refused(limit, bounds));
}

TEST_CASE("a perfect fit has no Laplace approximation, and a turn does not change one", "[estimation]") {
  const auto exact_rows = rows::synthetic(20, 0.0, 0.0);
  const auto none = laplace_approximation(exact_rows, {}, fit_least_squares(exact_rows, {}), rows::table2());
  CHECK_FALSE(none.regular);
  CHECK(std::isnan(none.log_evidence));
  CHECK(std::isnan(none.mode[friction::phase_noise]));

  const auto o = rows::table1();
  auto turned = o;
  turned.phase_deg[5] -= 360.0;
  const auto first = laplace_approximation(o, {}, fit_least_squares(o, {}), rows::table2());
  const auto second = laplace_approximation(turned, {}, fit_least_squares(turned, {}), rows::table2());
  REQUIRE(second.regular);
  CHECK_THAT(second.log_evidence, WithinAbs(first.log_evidence, 1e-7));
  CHECK_THAT(second.standard_deviation[0], WithinRel(first.standard_deviation[0], 1e-7));
}
