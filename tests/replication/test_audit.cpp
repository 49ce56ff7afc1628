// The audit of a table of measurements, against numbers computed by hand.

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "errors/invalid_value.hpp"
#include "friction/likelihood.hpp"
#include "replication/audit.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using replication::audit;
using replication::Truth;

constexpr double solver = 1e-7;                       // of the least-squares estimate, relative
constexpr double critical_chi_1 = 3.841458820694124;  // 95 % of chi^2 with 1 degree of freedom
const friction::Physics exact{};

friction::Observations table1() {
  return {{0.643, 0.786, 0.929, 1.071, 1.214, 1.357, 1.500, 1.643, 1.786, 1.929},
          {0.644, 0.793, 0.954, 1.065, 1.216, 1.356, 1.481, 1.639, 1.768, 1.937},
          {1.987, 2.447, 2.945, 3.286, 3.753, 4.186, 4.569, 5.056, 5.455, 5.978},
          {27.466, 29.968, 27.739, 149.366, 148.301, 153.816, 151.774, 144.536, 149.090, 149.947}};
}

/// Angle of the first Fourier coefficient, as in response.hpp, in degrees.
double phase_by_hand(double r, double phi) {
  const double u = std::tan(0.5 * std::numbers::pi / r) / r;
  const double v = 1.0 / (1.0 - r * r);
  const double x0 = std::sqrt(v * v - u * u * phi * phi);
  const double four_over_pi = 4.0 / std::numbers::pi;
  return std::atan2(four_over_pi * phi * x0, v + four_over_pi * u * phi * phi) * 180.0 / std::numbers::pi;
}

/// With p = 1/omega_n the misfit of the ratios is (0.6 - p)^2 + (0.95 - 2 p)^2 = 0.0125 + 5 (p -
/// 0.5)^2.
friction::Observations two_rows() {
  return {{0.6, 0.95}, {0.7, 1.5}, {1.0, 2.0}, {phase_by_hand(0.7, 0.3), phase_by_hand(1.5, 0.3)}};
}

TEST_CASE("Tests and intervals of the natural frequency agree with a parabola solved by hand") {
  const Truth truth{.friction_force_n = 0.75,
                    .natural_frequency_hz = 2.5,
                    .phase_noise_deg = 2.0,
                    .frequency_ratio_noise = 0.05};
  const auto a = audit(two_rows(), truth, 1.0, exact).natural_frequency;
  CHECK_THAT(a.estimate, WithinRel(2.0, solver));
  CHECK(a.noise_stated == 0.05);
  CHECK_THAT(a.noise_unbiased, WithinRel(std::sqrt(0.0125), solver));
  CHECK_THAT(a.chi_squared, WithinRel(5.0, solver));
  CHECK_THAT(a.chi_squared_p, WithinRel(std::erfc(std::sqrt(2.5)), 1e-6));

  REQUIRE(a.tests.size() == 1);
  const auto& t = a.tests[0];
  CHECK(t.value == 2.5);
  CHECK_THAT(t.chi_squared, WithinRel(25.0, solver));
  CHECK_THAT(t.chi_squared_p, WithinRel(std::exp(-12.5), 1e-6));
  CHECK_THAT(t.likelihood_ratio, WithinRel(20.0, solver));
  CHECK_THAT(t.likelihood_ratio_p, WithinRel(std::erfc(std::sqrt(10.0)), 1e-6));
  CHECK_THAT(t.f_statistic, WithinRel(4.0, solver));
  CHECK_THAT(t.f_p, WithinRel(1.0 - 2.0 / std::numbers::pi * std::atan(2.0), 1e-6));

  const double half = 0.05 * std::sqrt(critical_chi_1 / 5.0);
  CHECK_THAT(a.noise_known_95.lower, WithinRel(1.0 / (0.5 + half), solver));
  CHECK_THAT(a.noise_known_95.upper, WithinRel(1.0 / (0.5 - half), solver));
  CHECK_FALSE(a.noise_known_95.lower_at_bound);
  CHECK_FALSE(a.noise_known_95.upper_at_bound);
  // Student's t with one degree of freedom is a tangent; the other end is beyond omega_n =
  // infinity, so the bound, twice the largest omega_b / r_nom, is reported.
  const double wide = std::tan(0.475 * std::numbers::pi) * std::sqrt(0.0125 / 5.0);
  CHECK_THAT(a.noise_unknown_95.lower, WithinRel(1.0 / (0.5 + wide), solver));
  CHECK_FALSE(a.noise_unknown_95.lower_at_bound);
  CHECK_THAT(a.noise_unknown_95.upper, WithinRel(2.0 * 2.0 / 0.95, 1e-12));
  CHECK(a.noise_unknown_95.upper_at_bound);
}

TEST_CASE("Residuals and chi^2 of the friction force agree with the closed form") {
  friction::Observations o = two_rows();
  o.phase_deg = {40.0, 130.0};
  const Truth truth{.friction_force_n = 1.0,
                    .natural_frequency_hz = 2.0,
                    .phase_noise_deg = 4.0,
                    .frequency_ratio_noise = 0.1};
  const auto a = audit(o, truth, 0.5, exact);
  const auto z = [&](std::size_t i, double force) {
    return (o.phase_deg[i] - phase_by_hand(o.measured_ratio[i], force / 2.5)) / 4.0;
  };
  for (const std::size_t i : {0U, 1U}) {
    CHECK_THAT(a.phase_residual_truth[i], WithinAbs(z(i, 1.0), 1e-10));
    CHECK_THAT(a.phase_residual_alternative[i], WithinAbs(z(i, 0.5), 1e-10));
  }
  CHECK_THAT(a.frequency_difference_hz[0], WithinAbs(-0.4, 1e-15));
  CHECK_THAT(a.frequency_difference_hz[1], WithinAbs(-1.0, 1e-15));
  CHECK_THAT(a.ratio_residual[0], WithinAbs(1.0, 1e-13));
  CHECK_THAT(a.ratio_residual[1], WithinAbs(5.5, 1e-13));
  CHECK_THAT(a.ratio_chi_squared, WithinRel(31.25, 1e-12));
  CHECK_THAT(a.ratio_chi_squared_p, WithinRel(std::exp(-0.5 * 31.25), 1e-9));
  REQUIRE(a.friction_force.tests.size() == 2);
  for (const auto& t : a.friction_force.tests) {
    const double chi = z(0, t.value) * z(0, t.value) + z(1, t.value) * z(1, t.value);
    CHECK_THAT(t.chi_squared, WithinRel(chi, 1e-10));
    CHECK_THAT(t.chi_squared_p, WithinRel(std::exp(-0.5 * chi), 1e-9));
    CHECK_THAT(t.likelihood_ratio, WithinRel(chi - a.friction_force.chi_squared, 1e-9));
    CHECK_THAT(t.f_statistic, WithinRel(t.likelihood_ratio / a.friction_force.chi_squared, 1e-9));
  }
}

TEST_CASE("At the ends of an interval the misfit has risen by the critical value") {
  const friction::Likelihood likelihood(table1(), exact);
  const auto a = audit(table1(), {}, 1.0, exact).friction_force;
  const double least = likelihood.phase_misfit(a.estimate);
  for (const double end : {a.noise_known_95.lower, a.noise_known_95.upper}) {
    CHECK_THAT((likelihood.phase_misfit(end) - least) / 4.0, WithinRel(critical_chi_1, 1e-6));
  }
  constexpr double critical_f_1_9 = 5.117355029199;
  for (const double end : {a.noise_unknown_95.lower, a.noise_unknown_95.upper}) {
    CHECK_THAT((likelihood.phase_misfit(end) - least) / (least / 9.0), WithinRel(critical_f_1_9, 1e-6));
  }
  CHECK(a.noise_known_95.lower < a.estimate);
  CHECK(a.noise_known_95.upper > a.estimate);
}

TEST_CASE("Table 1 rejects 1.086 N and agrees with 1.0 N") {
  const auto a = audit(table1(), {}, 1.0, exact).friction_force;
  CHECK_THAT(a.tests[0].chi_squared, WithinAbs(46.2, 0.1));
  CHECK(a.tests[0].chi_squared_p < 2e-6);
  CHECK(a.tests[0].f_p < 0.01);
  CHECK_THAT(a.tests[1].chi_squared, WithinAbs(16.2, 0.1));
  CHECK_THAT(a.tests[1].chi_squared_p, WithinAbs(0.09, 0.005));
  CHECK(a.tests[1].f_p > 0.4);
}

TEST_CASE("Intervals end at the bounds of continuous motion where the data say nothing") {
  const friction::Likelihood likelihood(table1(), exact);
  const auto a = audit(table1(), {.phase_noise_deg = 200.0}, 1.0, exact).friction_force;
  CHECK(a.noise_known_95.lower == 0.0);
  CHECK(a.noise_known_95.lower_at_bound);
  CHECK_THAT(a.noise_known_95.upper, WithinRel(likelihood.limit_friction_force_n(), 1e-12));
  CHECK(a.noise_known_95.upper_at_bound);
}

TEST_CASE("A truth without continuous motion has NaN for statistics") {
  const auto a = audit(table1(), {.friction_force_n = 3.0}, 1.0, exact).friction_force;
  CHECK(std::isnan(a.tests[0].chi_squared));
  CHECK(std::isnan(a.tests[0].chi_squared_p));
  CHECK(std::isnan(a.tests[0].likelihood_ratio));
  CHECK(std::isnan(a.tests[0].f_p));
  CHECK(std::isfinite(a.tests[1].chi_squared));
}

TEST_CASE("With one row there is no test with the noise unknown") {
  friction::Observations o = table1();
  for (auto* column : {&o.nominal_ratio, &o.measured_ratio, &o.driving_frequency_hz, &o.phase_deg}) {
    column->resize(1);
  }
  const auto a = audit(o, {}, 1.0, exact);
  for (const auto* parameter : {&a.friction_force, &a.natural_frequency}) {
    CHECK(std::isnan(parameter->noise_unbiased));
    CHECK(std::isnan(parameter->chi_squared_p));
    CHECK(std::isnan(parameter->noise_unknown_95.lower));
    CHECK(std::isnan(parameter->noise_unknown_95.upper));
    CHECK(parameter->noise_known_95.lower < parameter->estimate);
    for (const auto& t : parameter->tests) {
      CHECK(std::isfinite(t.chi_squared_p));
      CHECK(std::isfinite(t.likelihood_ratio_p));
      CHECK(std::isnan(t.f_statistic));
      CHECK(std::isnan(t.f_p));
    }
  }
}

TEST_CASE("Rows that fit perfectly leave the unknown noise undefined") {
  const auto a = audit(replication::generate_observations(
                           {.phase_noise_deg = 0.0, .frequency_ratio_noise = 0.0}, {0.7, 1.3, 1.6}, exact, 1),
                       {}, 1.0, exact);
  for (const auto* parameter : {&a.friction_force, &a.natural_frequency}) {
    CHECK(std::isnan(parameter->noise_unbiased));
    CHECK(std::isnan(parameter->noise_unknown_95.lower));
    CHECK(std::isnan(parameter->noise_unknown_95.upper));
    CHECK(parameter->noise_known_95.lower < parameter->noise_known_95.upper);
    for (const auto& t : parameter->tests) {
      CHECK(std::isnan(t.f_statistic));
      CHECK(std::isnan(t.f_p));
      CHECK(std::isfinite(t.likelihood_ratio_p));
    }
  }
}

TEST_CASE("A phase written with a turn more or less gives the same audit") {
  auto turned = table1();
  turned.phase_deg[3] -= 360.0;
  const auto a = audit(table1(), {}, 1.0, exact);
  const auto b = audit(turned, {}, 1.0, exact);
  CHECK_THAT(b.phase_residual_truth[3], WithinAbs(a.phase_residual_truth[3], 1e-12));
  CHECK_THAT(b.phase_residual_alternative[3], WithinAbs(a.phase_residual_alternative[3], 1e-12));
  CHECK_THAT(b.friction_force.estimate, WithinRel(a.friction_force.estimate, solver));
  CHECK_THAT(b.friction_force.tests[0].chi_squared, WithinRel(a.friction_force.tests[0].chi_squared, solver));
}

TEST_CASE("The truth of generated data is inside 95 % of the intervals") {
  constexpr int sets = 400;
  int known_force = 0, unknown_force = 0, known_frequency = 0, unknown_frequency = 0;
  const Truth truth;
  const auto holds = [](const replication::ConfidenceInterval& i, double x) {
    return i.lower <= x && x <= i.upper ? 1 : 0;
  };
  for (int seed = 0; seed < sets; ++seed) {
    const auto o = replication::generate_observations(truth, replication::nominal_ratios(), exact,
                                                      static_cast<std::uint64_t>(seed));
    const auto a = audit(o, truth, 1.0, exact);
    known_force += holds(a.friction_force.noise_known_95, truth.friction_force_n);
    unknown_force += holds(a.friction_force.noise_unknown_95, truth.friction_force_n);
    known_frequency += holds(a.natural_frequency.noise_known_95, truth.natural_frequency_hz);
    unknown_frequency += holds(a.natural_frequency.noise_unknown_95, truth.natural_frequency_hz);
  }
  const double four_errors = 4.0 * std::sqrt(sets * 0.95 * 0.05);
  for (const int inside : {known_force, unknown_force, known_frequency, unknown_frequency}) {
    CHECK_THAT(inside, WithinAbs(0.95 * sets, four_errors));
  }
}

TEST_CASE("Noise levels that are not positive are refused") {
  CHECK_THROWS_AS(audit(table1(), {.phase_noise_deg = 0.0}, 1.0, exact), errors::InvalidValue);
  CHECK_THROWS_AS(audit(table1(), {.frequency_ratio_noise = -0.01}, 1.0, exact), errors::InvalidValue);
}

TEST_CASE("The lines of an audit: least squares with its intervals, then the values tested") {
  const auto a = audit(table1(), {}, 1.0, exact);
  const auto lines = replication::audit_lines(a);
  REQUIRE(lines.size() == 5);
  CHECK(lines[0].parameter == "friction_force_n");
  CHECK(lines[0].hypothesis == "least squares");
  CHECK(lines[0].test.value == a.friction_force.estimate);
  CHECK(lines[0].test.chi_squared_p == a.friction_force.chi_squared_p);
  CHECK(std::isnan(lines[0].test.f_p));
  CHECK(lines[0].noise_known_95.upper == a.friction_force.noise_known_95.upper);
  CHECK(lines[1].hypothesis == "stated truth");
  CHECK(lines[1].test.f_p == a.friction_force.tests[0].f_p);
  CHECK(std::isnan(lines[1].noise_known_95.lower));
  CHECK(lines[2].hypothesis == "alternative");
  CHECK(lines[2].test.value == 1.0);
  CHECK(lines[4].parameter == "natural_frequency_hz");
  CHECK(lines[4].noise_stated == 0.01);
}

}  // namespace
