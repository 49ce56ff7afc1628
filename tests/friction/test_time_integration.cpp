// Time integration of Eq. 10 against closed forms: Den Hartog's continuous motion, single pieces of
// sliding and sticking, the play operator as the quasi-static limit of stick-slip, and the balance
// of energy.

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "errors/invalid_value.hpp"
#include "friction/response.hpp"
#include "friction/time_integration.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using friction::HalfPeriod;
using friction::SteadyResponse;
using friction::SteadyState;
using friction::TimeIntegrationOptions;

constexpr double pi = std::numbers::pi;
constexpr double phase_tolerance_deg = 1e-8;
constexpr double relative_tolerance = 1e-10;
constexpr double order_band = 0.5;
constexpr double piece_tolerance = 1e-12;  // one half-period, no search

const std::vector<double> ratios{0.4,   0.45,  0.5,   0.644, 0.793, 0.954, 1.065,
                                 1.216, 1.356, 1.481, 1.639, 1.768, 1.937, 2.5};

TimeIntegrationOptions with_steps(int steps_per_period) {
  TimeIntegrationOptions options;
  options.steps_per_period = steps_per_period;
  return options;
}

double distance(double r, const HalfPeriod& a, const HalfPeriod& b) {
  return std::hypot(a.x - b.x, r * (a.velocity - b.velocity));
}

struct Start {
  double r, phi, x, velocity;
};

/// Slope of log(error) against log(step) from 12 to 36 steps per period, error against a solution
/// with very small steps; the mean over starts, since the place of an event within its step
/// scatters the error.
double observed_order(const Start& s, int stops) {
  constexpr int starts = 15;
  double sum = 0.0;
  for (int i = 0; i < starts; ++i) {
    const auto at = [&](int steps) {
      return friction::integrate_half_period(s.r, s.phi, s.x + 0.01 * i, s.velocity, with_steps(steps));
    };
    const HalfPeriod exact = at(512);
    REQUIRE(exact.stops == stops);
    sum += std::log(distance(s.r, at(12), exact) / distance(s.r, at(36), exact)) / std::log(3.0);
  }
  return sum / starts;
}

/// Sliding with a fixed sign of velocity from (x, 0) at start, in closed form.
struct Slide {
  double r, friction, x, start;
  [[nodiscard]] double v() const { return 1.0 / (1.0 - r * r); }
  [[nodiscard]] double a() const { return x - v() * std::cos(start) + friction; }
  [[nodiscard]] double b() const { return r * v() * std::sin(start); }
  [[nodiscard]] double at(double tau) const {
    const double angle = (tau - start) / r;
    return v() * std::cos(tau) - friction + a() * std::cos(angle) + b() * std::sin(angle);
  }
  [[nodiscard]] double velocity(double tau) const {
    const double angle = (tau - start) / r;
    return -v() * std::sin(tau) + (b() * std::cos(angle) - a() * std::sin(angle)) / r;
  }
};

template <class Function>
double integral(Function f, double from, double to) {
  return boost::math::quadrature::gauss_kronrod<double, 31>::integrate(f, from, to, 5, 1e-14);
}

}  // namespace

TEST_CASE("continuous motion agrees with Den Hartog's solution", "[friction][time_integration]") {
  for (const double r : ratios) {
    const auto c = friction::response_constants(r, {});
    for (const double share : {0.01, 0.1, 0.3, 0.6, 0.8, 0.95}) {
      const double phi = share * c.limit_force_ratio;
      const SteadyResponse s = friction::integrate_steady_response(r, phi);
      INFO("r = " << r << ", phi = " << phi << ", periods = " << s.periods_integrated);
      REQUIRE(s.state == SteadyState::periodic);
      CHECK(s.continuous);
      CHECK(s.stops_per_period == 0);
      CHECK(s.sticking_fraction == 0.0);
      CHECK_THAT(s.phase_deg, WithinAbs(friction::phase_deg(c, phi), phase_tolerance_deg));

      const double x0 = friction::response(c, phi, 0.0);
      const double amplitude = std::hypot(c.v + c.a2 * phi * phi, c.b1 * phi * x0);
      CHECK_THAT(s.amplitude, WithinRel(amplitude, relative_tolerance));
      // Eq. 15 puts its maximum at 0 and the forcing at cos(tau + eta).
      const double tau = std::fmod(4.0 * pi - friction::base_phase(c, phi), 2.0 * pi);
      CHECK_THAT(s.x, WithinAbs(friction::response(c, phi, tau), relative_tolerance * x0));
      CHECK_THAT(s.dissipation, WithinRel(4.0 * phi * x0, relative_tolerance));
      CHECK_THAT(s.work, WithinAbs(s.dissipation, relative_tolerance * x0));
    }
  }
}

TEST_CASE("the trace of a half-period is the motion that the half-period integrates",
          "[friction][time_integration]") {
  for (const double share : {0.5, 1.2}) {  // of the limit of continuous motion: sliding, and with stops
    const double r = 0.6;
    const auto c = friction::response_constants(r, {});
    const double phi = share * c.limit_force_ratio;
    const SteadyResponse s = friction::integrate_steady_response(r, phi);
    REQUIRE(s.state == SteadyState::periodic);
    const auto half = friction::integrate_half_period(r, phi, s.x, s.velocity);
    const auto trace = friction::trace_half_period(r, phi, s.x, s.velocity);
    INFO("phi = " << phi);
    REQUIRE(trace.size() > 10);
    CHECK(trace.front().tau == 0.0);
    CHECK(trace.front().x == s.x);
    CHECK(trace.back().tau == pi);
    CHECK(trace.back().x == half.x);
    double sticking = 0.0;
    for (std::size_t i = 1; i < trace.size(); ++i) {
      CHECK(trace[i].tau >= trace[i - 1].tau);
      if (trace[i - 1].sticks) {
        sticking += trace[i].tau - trace[i - 1].tau;
        CHECK(trace[i].x == trace[i - 1].x);
      }
      if (s.continuous) {
        // Eq. 15 puts its maximum at 0 and the forcing at cos(tau + eta).
        const double tau = std::fmod(4.0 * pi + trace[i].tau - friction::base_phase(c, phi), 2.0 * pi);
        CHECK_THAT(trace[i].x, WithinAbs(friction::response(c, phi, tau), 1e-8));
      }
    }
    CHECK(s.continuous == (share < 1.0));
    CHECK_THAT(sticking, WithinAbs(half.sticking_time, 1e-12));
  }
}

TEST_CASE("without friction the response is that of the linear oscillator", "[friction][time_integration]") {
  for (const double r : {0.01, 0.3, 0.35, 0.644, 0.954, 0.999, 1.001, 1.065, 2.5, 100.0}) {
    for (const double phi : {0.0, 1e-9}) {
      const SteadyResponse s = friction::integrate_steady_response(r, phi);
      INFO("r = " << r << ", phi = " << phi);
      REQUIRE(s.state == SteadyState::periodic);
      CHECK(s.continuous);
      CHECK_THAT(s.phase_deg, WithinAbs(r < 1.0 ? 0.0 : 180.0, phase_tolerance_deg + 80.0 * phi));
      CHECK_THAT(s.amplitude, WithinRel(std::fabs(1.0 / (1.0 - r * r)), 1e-9));
    }
  }
}

TEST_CASE("friction that exceeds the driving force holds the mass", "[friction][time_integration]") {
  for (const double r : {0.2, 1.0 / 3.0, 1.0, 1.5}) {
    for (const double phi : {1.0, 1.0 + 1e-12, 1.3, 50.0}) {
      const SteadyResponse s = friction::integrate_steady_response(r, phi);
      CHECK(s.state == SteadyState::at_rest);
      CHECK(std::isnan(s.phase_deg));
      CHECK(s.amplitude == 0.0);
      CHECK_FALSE(s.continuous);
      CHECK(s.sticking_fraction == 1.0);
    }
  }
}

TEST_CASE("just below a force ratio of 1 the mass hops", "[friction][time_integration]") {
  // r^2 x'' = gap - tau^2/2 about the maximum of the forcing: a hop from -a to 2a, a = sqrt(2 gap),
  // over 4.5 gap^2 / r^2, with its centre at 0.8 a; between hops the mass sticks.
  const double gap = 1e-8;
  for (const double r : {0.5, 1.0, 2.0}) {
    const SteadyResponse s = friction::integrate_steady_response(r, 1.0 - gap);
    INFO("r = " << r);
    REQUIRE(s.state == SteadyState::periodic);
    CHECK(s.stops_per_period == 2);
    CHECK_THAT(s.amplitude, WithinRel(4.0 / pi * 2.25 * gap * gap / (r * r), 1e-6));
    CHECK_THAT(s.phase_deg, WithinAbs(90.0 + 0.8 * std::sqrt(2.0 * gap) * 180.0 / pi, 1e-6));
    CHECK_THAT(s.sticking_fraction, WithinAbs(1.0 - 3.0 * std::sqrt(2.0 * gap) / pi, 1e-7));
  }
}

TEST_CASE("a slide from rest, a stop and a release follow their closed forms",
          "[friction][time_integration]") {
  const double r = 2.0;
  const double phi = 0.3;
  SECTION("sliding for the whole half-period") {
    const Slide slide{r, phi, -1.5, 0.0};
    const HalfPeriod h = friction::integrate_half_period(r, phi, -1.5, 0.0);
    CHECK_THAT(h.x, WithinAbs(slide.at(pi), piece_tolerance));
    CHECK_THAT(h.velocity, WithinAbs(slide.velocity(pi), piece_tolerance));
    CHECK_THAT(h.path, WithinAbs(slide.at(pi) + 1.5, piece_tolerance));
    CHECK(h.stops == 0);
  }
  SECTION("sticking, then sliding back") {
    const double x = 0.8;
    const double release = std::acos(x - phi);
    const Slide slide{r, -phi, x, release};
    const HalfPeriod h = friction::integrate_half_period(r, phi, x, 0.0);
    CHECK_THAT(h.sticking_time, WithinAbs(release, piece_tolerance));
    CHECK_THAT(h.x, WithinAbs(slide.at(pi), piece_tolerance));
    CHECK_THAT(h.velocity, WithinAbs(slide.velocity(pi), piece_tolerance));
    const auto moment = [&](auto weight) {
      return integral([&](double tau) { return x * weight(tau); }, 0.0, release) +
             integral([&](double tau) { return slide.at(tau) * weight(tau); }, release, pi);
    };
    CHECK_THAT(h.cosine_integral, WithinAbs(moment([](double t) { return std::cos(t); }), piece_tolerance));
    CHECK_THAT(h.sine_integral, WithinAbs(moment([](double t) { return std::sin(t); }), piece_tolerance));
  }
  SECTION("sliding, stopping, sliding back") {
    const auto agrees = [](const Slide& there, double moving, double stop) {
      REQUIRE(there.velocity(moving) > 0.0);
      REQUIRE(there.velocity(stop) < 0.0);
      for (int halving = 0; halving < 60; ++halving) {
        const double middle = 0.5 * (moving + stop);
        (there.velocity(middle) > 0.0 ? moving : stop) = middle;
      }
      const double release = std::acos(there.at(stop) - there.friction);
      const Slide back{there.r, -there.friction, there.at(stop), release};
      const HalfPeriod h = friction::integrate_half_period(there.r, there.friction, there.x, 0.0);
      CHECK(h.stops == 1);
      CHECK_THAT(h.sticking_time, WithinAbs(release - stop, piece_tolerance));
      CHECK_THAT(h.x, WithinAbs(back.at(pi), piece_tolerance));
      CHECK_THAT(h.velocity, WithinAbs(back.velocity(pi), piece_tolerance));
      CHECK_THAT(h.path, WithinAbs(2.0 * there.at(stop) - there.x - back.at(pi), piece_tolerance));
    };
    agrees({0.5, 0.9, 0.0, 0.0}, 0.1, 1.5);
    agrees({0.5, 0.3, 0.7 - 1e-4, 0.0}, 0.01, 0.04);  // the first slide is shorter than a step
  }
}

TEST_CASE("stick-slip tends to the play operator as r tends to 0", "[friction][time_integration]") {
  // First harmonic of backlash of half-width phi under cos(tau), unit slope; the rest is of order
  // r.
  const double r = 0.005;
  for (const double phi : {0.1, 0.3, 0.5, 0.8}) {
    const double in_phase =
        0.5 + (std::asin(1.0 - 2.0 * phi) + 2.0 * (1.0 - 2.0 * phi) * std::sqrt(phi * (1.0 - phi))) / pi;
    const double lagging = 4.0 * phi * (1.0 - phi) / pi;
    const SteadyResponse s = friction::integrate_steady_response(r, phi);
    INFO("phi = " << phi);
    REQUIRE(s.state == SteadyState::periodic);
    CHECK(s.stops_per_period > 20);
    CHECK_THAT(s.phase_deg, WithinAbs(std::atan2(lagging, in_phase) * 180.0 / pi, 0.02));
    CHECK_THAT(s.amplitude, WithinRel(std::hypot(in_phase, lagging), 1e-3));
  }
}

TEST_CASE("observed order of convergence is that of the method", "[friction][time_integration]") {
  CHECK_THAT(observed_order({0.6, 0.2, 1.0, 0.9}, 0), WithinAbs(8.0, order_band));
  CHECK_THAT(observed_order({0.4, 0.6, 0.1, 0.5}, 1), WithinAbs(8.0, order_band));

  // The whole answer of a stick-slip case, from so few steps that their error is above the
  // tolerances.
  const double fine = friction::integrate_steady_response(0.3, 0.5, with_steps(256)).phase_deg;
  const double coarse = friction::integrate_steady_response(0.3, 0.5, with_steps(8)).phase_deg - fine;
  const double halved = friction::integrate_steady_response(0.3, 0.5, with_steps(16)).phase_deg - fine;
  CHECK(std::fabs(coarse) < 1e-2);
  CHECK(std::fabs(halved) < std::fabs(coarse) / 50.0);
}

TEST_CASE("work of the forcing is what friction dissipates", "[friction][time_integration]") {
  for (const double r : {0.12, 0.25, 0.3, 0.6, 0.9, 1.1, 2.0}) {
    for (const double phi : {0.05, 0.3, 0.6, 0.9, 0.99}) {
      const SteadyResponse s = friction::integrate_steady_response(r, phi);
      INFO("r = " << r << ", phi = " << phi);
      REQUIRE(s.state == SteadyState::periodic);
      CHECK(s.dissipation > 0.0);
      CHECK_THAT(s.work, WithinRel(s.dissipation, 1e-8));
      CHECK(s.continuous == (s.stops_per_period == 0));
      CHECK(s.continuous == (s.sticking_fraction == 0.0));
    }
  }
}

TEST_CASE("the response is continuous across the limit of continuous motion",
          "[friction][time_integration]") {
  for (const double r : ratios) {
    const double limit = friction::response_constants(r, {}).limit_force_ratio;
    const SteadyResponse below = friction::integrate_steady_response(r, limit * (1.0 - 1e-5));
    const SteadyResponse above = friction::integrate_steady_response(r, limit * (1.0 + 1e-5));
    INFO("r = " << r);
    REQUIRE(below.state == SteadyState::periodic);
    REQUIRE(above.state == SteadyState::periodic);
    CHECK(below.stops_per_period == 0);
    CHECK(above.stops_per_period == 2);  // short ones: velocity dips below zero within one step
    CHECK(above.sticking_fraction > 0.0);
    CHECK(above.sticking_fraction < 3e-3);
    CHECK_THAT(above.phase_deg, WithinAbs(below.phase_deg, 0.1));
    CHECK_THAT(above.amplitude, WithinRel(below.amplitude, 5e-3));
  }
}

TEST_CASE("a low ratio or much friction gives stops", "[friction][time_integration]") {
  CHECK(friction::integrate_steady_response(0.3, 0.1).stops_per_period == 4);
  CHECK(friction::integrate_steady_response(0.2, 0.3).stops_per_period == 4);
  CHECK(friction::integrate_steady_response(0.2, 0.9).stops_per_period == 2);
  CHECK(friction::integrate_steady_response(1.5, 0.8).stops_per_period == 2);
}

TEST_CASE("at resonance a response is reported only where one exists", "[friction][time_integration]") {
  // r = 1: a bounded response needs phi > pi/4; beside it, rounding decides. phi = 0, r = 1/3: any
  // free vibration may be added.
  const double quarter = 0.25 * pi;
  const std::vector<std::pair<double, double>> none{
      {1.0, 0.0},        {1.0, 1e-6},       {1.0, 0.3},       {1.0, 0.99 * quarter},
      {1.0 - 1e-7, 0.0}, {1.0 + 1e-7, 0.0}, {1.0 / 3.0, 0.0}, {0.2, 0.0}};
  for (const auto& [r, phi] : none) {
    const SteadyResponse s = friction::integrate_steady_response(r, phi);
    INFO("r = " << r << ", phi = " << phi);
    CHECK(s.state == SteadyState::not_periodic);
    CHECK(std::isnan(s.phase_deg));
    CHECK(std::isnan(s.amplitude));
    CHECK(std::isnan(s.work));
    CHECK_FALSE(s.continuous);
    CHECK(s.periods_integrated == TimeIntegrationOptions{}.maximum_periods);
  }
  const std::vector<std::pair<double, double>> one{
      {1.0, 1.01 * quarter}, {1.0, 0.9}, {1.0 / 3.0, 0.01}, {1.0 / 3.0, 0.3}, {0.2, 0.1}};
  for (const auto& [r, phi] : one) {
    const SteadyResponse s = friction::integrate_steady_response(r, phi);
    const double either_side = 0.5 * (friction::integrate_steady_response(r * (1.0 - 1e-4), phi).phase_deg +
                                      friction::integrate_steady_response(r * (1.0 + 1e-4), phi).phase_deg);
    INFO("r = " << r << ", phi = " << phi);
    CHECK(s.state == SteadyState::periodic);
    CHECK_THAT(s.phase_deg, WithinAbs(either_side, 1e-3));
    CHECK_THAT(s.work, WithinRel(s.dissipation, 1e-8));
  }
}

TEST_CASE("a long transient near resonance takes few periods to cut short", "[friction][time_integration]") {
  for (const auto& [r, phi] : std::vector<std::pair<double, double>>{{0.954, 0.802884},
                                                                     {0.998683, 0.767976},
                                                                     {0.995472, 0.784185},
                                                                     {0.999694, 0.703166},
                                                                     {1.000211, 0.763094},
                                                                     {1.001148, 0.773684},
                                                                     {0.999, 0.5}}) {
    const SteadyResponse s = friction::integrate_steady_response(r, phi);
    const auto c = friction::response_constants(r, {});
    INFO("r = " << r << ", phi = " << phi);
    REQUIRE(s.state == SteadyState::periodic);
    CHECK(s.periods_integrated <= 15.0);
    CHECK_THAT(s.phase_deg, WithinAbs(friction::phase_deg(c, phi), 1e-6));
  }
}

TEST_CASE("a cap on the periods ends the search with a status", "[friction][time_integration]") {
  TimeIntegrationOptions options;
  options.maximum_periods = 1;
  const SteadyResponse s = friction::integrate_steady_response(0.793, 0.7, options);
  CHECK(s.state == SteadyState::not_periodic);
  CHECK(s.periods_integrated == 1.0);
  CHECK(std::isnan(s.phase_deg));
}

TEST_CASE("the transient from any start ends in the steady response", "[friction][time_integration]") {
  for (const auto& [r, phi] : std::vector<std::pair<double, double>>{{0.3, 0.5}, {0.793, 0.6}, {1.5, 0.7}}) {
    const SteadyResponse steady = friction::integrate_steady_response(r, phi);
    for (const auto& [x, velocity] : std::vector<std::pair<double, double>>{{0.0, 0.0}, {-2.0, 3.0}}) {
      HalfPeriod h = friction::integrate_half_period(r, phi, x, velocity);
      for (int half = 0; half < 300; ++half) h = friction::integrate_half_period(r, phi, -h.x, -h.velocity);
      CHECK_THAT(-h.x, WithinAbs(steady.x, 1e-9));
      CHECK_THAT(-h.velocity, WithinAbs(steady.velocity, 1e-9));
      CHECK_THAT(std::atan2(h.sine_integral, h.cosine_integral) * 180.0 / pi,
                 WithinAbs(steady.phase_deg, phase_tolerance_deg));
    }
  }
}

TEST_CASE("the derivative of a half-period agrees with differences and never expands",
          "[friction][time_integration]") {
  for (const Start& s : {Start{0.6, 0.2, 1.0, 0.9}, Start{0.3, 0.5, 0.2, 0.1}, Start{0.3, 0.1, 0.5, -2.0},
                         Start{1.7, 0.0, 0.3, 0.2}, Start{0.2, 0.05, 1.0, 1.0}}) {
    const auto at = [&](double dx, double dw) {
      return friction::integrate_half_period(s.r, s.phi, s.x + dx, s.velocity + dw / s.r);
    };
    const auto derivative = at(0.0, 0.0).derivative;
    constexpr double h = 1e-6;
    INFO("r = " << s.r << ", phi = " << s.phi);
    for (const int column : {0, 1}) {
      const HalfPeriod plus = column == 0 ? at(h, 0.0) : at(0.0, h);
      const HalfPeriod minus = column == 0 ? at(-h, 0.0) : at(0.0, -h);
      const auto j = static_cast<std::size_t>(column);
      CHECK_THAT(derivative[j], WithinAbs((plus.x - minus.x) / (2.0 * h), 1e-6));
      CHECK_THAT(derivative[2 + j], WithinAbs(s.r * (plus.velocity - minus.velocity) / (2.0 * h), 1e-6));
    }
    for (const double size : {0.1, 1.0}) {
      CHECK(distance(s.r, at(size, 0.0), at(0.0, size)) <= std::sqrt(2.0) * size * (1.0 + 1e-12));
    }
  }
}

TEST_CASE("arguments and options out of range are named", "[friction][time_integration]") {
  const auto rejects = [](const char* field, double r, double phi,
                          const TimeIntegrationOptions& options = {}) {
    CHECK_THROWS_WITH(friction::integrate_steady_response(r, phi, options), Contains(field));
    CHECK_THROWS_AS(friction::integrate_half_period(r, phi, 0.0, 0.0, options), errors::InvalidValue);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double r : {0.0, -1.0, nan, infinity, 1e-4}) rejects("frequency_ratio = ", r, 0.1);
  for (const double phi : {-1e-300, nan, infinity}) rejects("force_ratio = ", 0.5, phi);
  TimeIntegrationOptions options;
  options.steps_per_period = 7;
  rejects("steps_per_period = 7: expected 8 or more", 0.5, 0.1, options);
  options = {};
  options.event_tolerance = 0.0;
  rejects("event_tolerance", 0.5, 0.1, options);
  options = {};
  options.periodicity_tolerance = nan;
  rejects("periodicity_tolerance", 0.5, 0.1, options);
  options = {};
  options.maximum_periods = 0;
  rejects("maximum_periods", 0.5, 0.1, options);
  CHECK_THROWS_WITH(friction::integrate_half_period(0.5, 0.1, nan, 0.0), Contains("x = "));
  CHECK_THROWS_WITH(friction::integrate_half_period(0.5, 0.1, 0.0, infinity), Contains("velocity = "));
}
