// Least squares against closed forms and against roots of the exact gradient.

#include <unistd.h>

#include <boost/math/differentiation/autodiff.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "errors/invalid_value.hpp"
#include "estimation/least_squares.hpp"
#include "friction/likelihood.hpp"
#include "rows.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using estimation::fit_least_squares;
using estimation::LeastSquaresOptions;

constexpr double accuracy = 1e-9;

/// Phase, deg, and its derivative, deg/N.
std::pair<double, double> phase_and_slope(double r, const friction::Physics& physics, double force_n) {
  const auto force = boost::math::differentiation::make_fvar<double, 1>(force_n);
  using T = std::decay_t<decltype(force)>;
  const T phase =
      friction::phase_deg(friction::response_constants(r, physics), T(force / physics.driving_force_n));
  return {phase.derivative(0U), phase.derivative(1U)};
}

double gradient(const friction::Observations& o, const friction::Physics& physics, double force_n) {
  double sum = 0.0;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const auto [phase, slope] = phase_and_slope(o.measured_ratio[i], physics, force_n);
    sum += (phase - o.phase_deg[i]) * slope;
  }
  return sum;
}

double root_of_gradient(const friction::Observations& o, const friction::Physics& physics, double low,
                        double high) {
  std::uintmax_t iterations = 200;
  const auto bracket =
      boost::math::tools::toms748_solve([&](double x) { return gradient(o, physics, x); }, low, high,
                                        boost::math::tools::eps_tolerance<double>(50), iterations);
  return 0.5 * (bracket.first + bracket.second);
}

void check_noise_is_undefined(const estimation::BlockFit& fit) {
  CHECK(fit.fitted_noise == estimation::FittedNoise::perfect_fit);
  CHECK(std::isnan(fit.noise_ml));
  CHECK(std::isnan(fit.standard_error_ml));
  CHECK(std::isnan(fit.log_likelihood));
  CHECK(std::isfinite(fit.standard_error));
}

/// Standard output and error go to a file as long as it lives.
class CapturedStreams {
 public:
  CapturedStreams() {
    std::fflush(nullptr);
    dup2(fileno(file_), 1);
    dup2(fileno(file_), 2);
  }
  CapturedStreams(const CapturedStreams&) = delete;
  CapturedStreams& operator=(const CapturedStreams&) = delete;
  ~CapturedStreams() {
    std::fflush(nullptr);
    dup2(output_, 1);
    dup2(error_, 2);
    close(output_);
    close(error_);
    std::fclose(file_);
  }
  long written() {
    std::fflush(nullptr);
    std::fseek(file_, 0, SEEK_END);
    return std::ftell(file_);
  }

 private:
  std::FILE* file_ = std::tmpfile();
  int output_ = dup(1);
  int error_ = dup(2);
};

double best_frequency(const friction::Observations& o) {
  double squares = 0.0;
  double products = 0.0;
  for (std::size_t i = 0; i < o.size(); ++i) {
    squares += o.driving_frequency_hz[i] * o.driving_frequency_hz[i];
    products += o.driving_frequency_hz[i] * o.nominal_ratio[i];
  }
  return squares / products;
}

}  // namespace

TEST_CASE("Table 1 with the published physics", "[estimation]") {
  const auto o = rows::table1();
  const auto fit = fit_least_squares(o, rows::as_published());
  const auto& force = fit.friction_force;
  const auto& frequency = fit.natural_frequency;
  const double printed = 5e-6;
  CHECK_THAT(force.estimate, WithinAbs(0.98229, printed));
  CHECK_THAT(force.noise_ml, WithinAbs(2.47541, printed));
  CHECK_THAT(frequency.estimate, WithinAbs(3.08132, printed));
  CHECK_THAT(frequency.noise_ml, WithinAbs(0.0122182, printed));
  CHECK_THAT(force.estimate, WithinRel(root_of_gradient(o, rows::as_published(), 0.8, 1.2), accuracy));
  CHECK_THAT(frequency.estimate, WithinRel(best_frequency(o), accuracy));
  for (const auto* block : {&force, &frequency}) {
    CHECK(block->starts == 8);
    CHECK(block->agreed == 8);
    CHECK(block->failed == 0);
    CHECK(block->distinct_minima == 1);
    CHECK_FALSE(block->at_bound);
    CHECK(block->iterations > 0);
    CHECK_THAT(block->termination, Contains("olerance"));
  }
}

TEST_CASE("misfits, residuals, chi squared, standard errors and log-likelihood follow their definitions",
          "[estimation]") {
  const auto o = rows::table1();
  const friction::Physics physics;
  const friction::Likelihood likelihood(o, physics);
  const auto fit = fit_least_squares(o, physics, {.phase_noise_deg = 3.0, .frequency_ratio_noise = 0.02});
  const auto& force = fit.friction_force;
  const auto& frequency = fit.natural_frequency;
  CHECK_THAT(force.sum_of_squares, WithinRel(likelihood.phase_misfit(force.estimate), accuracy));
  CHECK_THAT(frequency.sum_of_squares, WithinRel(likelihood.frequency_misfit(frequency.estimate), accuracy));
  double phase_information = 0.0;
  double ratio_information = 0.0;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const auto [phase, slope] = phase_and_slope(o.measured_ratio[i], physics, force.estimate);
    phase_information += slope * slope;
    const double ratio = o.driving_frequency_hz[i] / frequency.estimate;
    ratio_information += std::pow(ratio / frequency.estimate, 2);
    CHECK_THAT(force.residuals.at(i), WithinAbs(o.phase_deg[i] - phase, accuracy));
    CHECK_THAT(frequency.residuals.at(i), WithinAbs(o.nominal_ratio[i] - ratio, accuracy));
  }
  CHECK_THAT(force.standard_error, WithinRel(3.0 / std::sqrt(phase_information), accuracy));
  CHECK_THAT(frequency.standard_error, WithinRel(0.02 / std::sqrt(ratio_information), accuracy));
  for (const auto* block : {&force, &frequency}) {
    CHECK_THAT(block->noise_ml, WithinRel(std::sqrt(block->sum_of_squares / 10.0), accuracy));
    CHECK_THAT(block->standard_error_ml / block->standard_error,
               WithinRel(block->noise_ml / block->noise_given, accuracy));
    CHECK_THAT(block->chi_squared,
               WithinRel(block->sum_of_squares / std::pow(block->noise_given, 2), accuracy));
    CHECK_THAT(block->reduced_chi_squared, WithinRel(block->chi_squared / 9.0, accuracy));
    CHECK_THAT(block->standard_error_of_noise(2.0), WithinRel(2.0 / std::sqrt(20.0), accuracy));
  }
  Eigen::MatrixXd point(1, 4);
  point << force.estimate, frequency.estimate, force.noise_ml, frequency.noise_ml;
  Eigen::VectorXd value(1);
  likelihood(point, value);
  CHECK_THAT(fit.log_likelihood(), WithinAbs(value[0], accuracy));
  // The point estimates do not depend on the noise levels.
  const auto other = fit_least_squares(o, physics);
  CHECK_THAT(other.friction_force.estimate, WithinRel(force.estimate, accuracy));
  CHECK_THAT(other.natural_frequency.estimate, WithinRel(frequency.estimate, accuracy));
}

TEST_CASE("one row, exact rows and many rows", "[estimation]") {
  const auto one = fit_least_squares(rows::first(1, rows::table1()), rows::as_published());
  CHECK(std::isnan(one.friction_force.reduced_chi_squared));
  CHECK(std::isnan(one.natural_frequency.reduced_chi_squared));
  CHECK_THAT(one.natural_frequency.estimate, WithinRel(1.987 / 0.643, accuracy));
  for (const auto* block : {&one.friction_force, &one.natural_frequency}) {
    CHECK(block->fitted_noise == estimation::FittedNoise::one_observation);
    CHECK(block->sum_of_squares < 1e-18);
    CHECK(std::isnan(block->noise_ml));
    CHECK(std::isnan(block->standard_error_ml));
    CHECK(std::isfinite(block->standard_error));
  }
  CHECK(std::isnan(one.log_likelihood()));

  const auto exact = fit_least_squares(rows::synthetic(20, 0.0, 0.0), {});
  CHECK_THAT(exact.friction_force.estimate, WithinRel(rows::true_force_n, accuracy));
  CHECK_THAT(exact.natural_frequency.estimate, WithinRel(rows::true_frequency_hz, accuracy));
  check_noise_is_undefined(exact.friction_force);
  check_noise_is_undefined(exact.natural_frequency);
  CHECK(std::isnan(exact.log_likelihood()));

  const auto many_rows = rows::synthetic(2000, 2.0, 0.01);
  const auto many = fit_least_squares(many_rows, {});
  CHECK_THAT(many.friction_force.estimate, WithinRel(root_of_gradient(many_rows, {}, 0.9, 1.1), accuracy));
  CHECK_THAT(many.natural_frequency.estimate, WithinRel(best_frequency(many_rows), accuracy));
}

TEST_CASE("estimates stay within continuous motion, with finite derivatives on the bounds", "[estimation]") {
  auto o = rows::table1();
  const friction::Likelihood likelihood(o, rows::as_published());
  o.phase_deg.assign(10, 90.0);
  const auto high = fit_least_squares(o, rows::as_published()).friction_force;
  CHECK(high.at_bound);
  CHECK(high.estimate <= likelihood.limit_friction_force_n());
  CHECK_THAT(high.estimate, WithinRel(likelihood.limit_friction_force_n(), 1e-12));
  CHECK(std::isfinite(high.standard_error));
  for (std::size_t i = 0; i < 10; ++i) {
    o.phase_deg[i] = o.measured_ratio[i] < 1.0 ? -20.0 : 200.0;
  }
  const auto low = fit_least_squares(o, rows::as_published()).friction_force;
  CHECK(low.at_bound);
  CHECK(low.estimate == 0.0);
  CHECK(std::isfinite(low.standard_error));
  // The derivative at zero force is that just above it.
  for (const double r : {0.644, 1.356}) {
    const double step = 1e-6;
    const auto constants = friction::response_constants(r, rows::as_published());
    const double slope =
        (friction::phase_deg(constants, step / 2.5) - friction::phase_deg(constants, 0.0)) / step;
    auto single = rows::first(1, rows::table1());
    single.measured_ratio[0] = r;
    single.phase_deg[0] = r < 1.0 ? -20.0 : 200.0;
    const auto fit = fit_least_squares(single, rows::as_published()).friction_force;
    CHECK(fit.estimate == 0.0);
    CHECK_THAT(2.0 / fit.standard_error, WithinRel(std::fabs(slope), 1e-4));
  }
}

TEST_CASE("a second local minimum is counted and the lower one is taken", "[estimation]") {
  // At r = 1.2 the phase has its minimum at 0.991 of the limit: one row that fits at 0.9 of the
  // limit has another, higher, minimum of the misfit at the limit.
  const friction::Physics physics;
  const auto constants = friction::response_constants(1.2, physics);
  const double force = 0.9 * constants.limit_force_ratio * physics.driving_force_n;
  const double phase = friction::phase_deg(constants, force / physics.driving_force_n);
  const friction::Observations o{{1.2}, {1.2}, {3.7}, {phase}};
  const auto fit = fit_least_squares(o, physics, {.starts = 32}).friction_force;
  CHECK(fit.distinct_minima == 2);
  CHECK(fit.agreed + fit.failed < 32);
  CHECK(fit.agreed > 0);
  CHECK(fit.sum_of_squares < 1e-20);
}

TEST_CASE("least squares writes nothing", "[estimation]") {
  long written = 0;
  {
    CapturedStreams streams;
    auto o = rows::table1();
    o.phase_deg.assign(10, 90.0);
    static_cast<void>(fit_least_squares(o, {}));
    for (double r = 0.41; r < 2.5; r += 0.07) {
      static_cast<void>(fit_least_squares({{r}, {r}, {3.0}, {90.0}}, {}));
      static_cast<void>(fit_least_squares({{r}, {r}, {3.0}, {r < 1.0 ? -90.0 : 270.0}}, {}));
    }
    written = streams.written();
  }
  CHECK(written == 0);
}

TEST_CASE("invalid options are named", "[estimation]") {
  const auto o = rows::table1();
  CHECK_THROWS_WITH(fit_least_squares(o, {}, {.phase_noise_deg = 0.0}), Contains("phase_noise_deg = 0"));
  CHECK_THROWS_WITH(fit_least_squares(o, {}, {.frequency_ratio_noise = -1.0}),
                    Contains("frequency_ratio_noise = -1"));
  CHECK_THROWS_WITH(fit_least_squares(o, {}, {.starts = 0}), Contains("starts = 0"));
  CHECK_THROWS_WITH(fit_least_squares(o, {}, {.agreement_tolerance = 1.0}),
                    Contains("agreement_tolerance = 1"));
  CHECK_THROWS_WITH(fit_least_squares(o, {}, {.max_iterations = 0}), Contains("max_iterations = 0"));
  CHECK_THROWS_AS(fit_least_squares({}, {}), errors::InvalidValue);
  CHECK_THROWS_AS(fit_least_squares(rows::synthetic(20, 2.0, 0.01), {}, {.max_iterations = 1}),
                  std::runtime_error);
}

TEST_CASE("rows that agree with each other determine no noise", "[estimation]") {
  // The same row three times fits exactly in both parameters.
  const friction::Observations repeated{
      {1.4, 1.4, 1.4}, {1.41, 1.41, 1.41}, {4.3, 4.3, 4.3}, {150.5, 150.5, 150.5}};
  const auto same = fit_least_squares(repeated, {});
  check_noise_is_undefined(same.friction_force);
  check_noise_is_undefined(same.natural_frequency);
  CHECK_THAT(same.natural_frequency.estimate, WithinRel(4.3 / 1.4, accuracy));

  // A controller that holds the commanded frequency exactly: noise in the phases alone.
  auto commanded = rows::synthetic(12, 2.0, 0.0);
  const auto fit = fit_least_squares(commanded, {});
  CHECK(fit.friction_force.fitted_noise == estimation::FittedNoise::determined);
  CHECK(std::isfinite(fit.friction_force.log_likelihood));
  check_noise_is_undefined(fit.natural_frequency);

  // Equal ratios with different phases: no perfect fit of the force.
  auto scattered = repeated;
  scattered.phase_deg = {149.0, 150.5, 152.0};
  CHECK(fit_least_squares(scattered, {}).friction_force.fitted_noise == estimation::FittedNoise::determined);

  // Noise in the twelfth digit of a phase is below the error of the estimate, noise of 1e-4 deg is
  // not.
  for (const auto& [noise, expected] : {std::pair{1e-10, estimation::FittedNoise::perfect_fit},
                                        {1e-4, estimation::FittedNoise::determined}}) {
    CHECK(fit_least_squares(rows::synthetic(12, noise, 0.01), {}).friction_force.fitted_noise == expected);
  }
}

TEST_CASE("a phase written with a turn more or less gives the same fit", "[estimation]") {
  const auto o = rows::table1();
  const auto fit = fit_least_squares(o, {}).friction_force;
  for (std::size_t i = 0; i < o.size(); ++i) {
    CAPTURE(i);
    auto turned = o;
    turned.phase_deg[i] -= 360.0;
    const auto again = fit_least_squares(turned, {}).friction_force;
    CHECK_THAT(again.estimate, WithinRel(fit.estimate, accuracy));
    CHECK_THAT(again.noise_ml, WithinRel(fit.noise_ml, accuracy));
    CHECK_THAT(again.standard_error, WithinRel(fit.standard_error, 1e-7));
    CHECK_THAT(again.residuals[i], WithinAbs(fit.residuals[i], 1e-6));
  }
}
