// Den Hartog's continuous motion: the equation of motion, its limit and the phase angle, each
// against a computation that shares no formula with the library.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "data/columns.hpp"
#include "errors/invalid_value.hpp"
#include "friction/response.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using friction::base_phase;
using friction::is_singular_ratio;
using friction::LimitRule;
using friction::phase_deg;
using friction::PhaseRule;
using friction::Physics;
using friction::response;
using friction::response_constants;
using friction::response_function_s;
using friction::response_function_u;
using friction::ResponseConstants;

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double reference_tolerance = 1e-9;  // deg and force ratio; the tables have 12 decimals
constexpr double transform_tolerance = 1e-9;  // deg
constexpr double rounding = 1e-12;

const Physics exact{};
const Physics published{.limit = LimitRule::grid, .phase = PhaseRule::discrete_bin};

const std::vector<double>& measured_ratios() {
  static const std::vector<double> ratios = test_data::table1().measured_ratio;
  return ratios;
}

/// Ratios of Table 1 and others on either side of the resonances.
std::vector<double> many_ratios() {
  std::vector<double> ratios = measured_ratios();
  ratios.insert(ratios.end(), {0.22, 0.27, 0.38, 0.45, 0.5, 0.55, 0.9, 1.1, 2.5, 4.0, 10.0});
  return ratios;
}

/// Angle between two complex numbers, in [0, 180] deg.
double angle_deg(std::complex<double> y, std::complex<double> x) {
  return std::fabs(std::arg(y * std::conj(x))) * 180.0 / pi;
}

std::complex<double> transform_bin(const std::vector<double>& signal, std::size_t bin) {
  Eigen::FFT<double> fft;
  std::vector<std::complex<double>> spectrum;
  fft.fwd(spectrum, signal);
  return spectrum.at(bin);
}

/// The quotient whose supremum is S, in long double.
double s_quotient(double r, double tau) {
  const long double ratio = r;
  const long double t = tau;
  const long double angle = std::numbers::pi_v<long double> / ratio;
  const long double u = std::sin(angle) / (ratio * (1.0L + std::cos(angle)));
  const long double numerator =
      ratio * std::sin(t / ratio) + u * ratio * ratio * (std::cos(t) - std::cos(t / ratio));
  return static_cast<double>(numerator / std::sin(t));
}

double largest_quotient(double r, int points) {
  double largest = 1.0;  // the limit at tau -> 0
  for (int j = 1; j < points; ++j) {
    largest = std::max(largest, s_quotient(r, pi * j / points));
  }
  return largest;
}

}  // namespace

TEST_CASE("phase and limit of the published discretisation against reference values",
          "[friction][response]") {
  const auto reference =
      test_data::read_columns(test_data::source_directory() + "/tests/data/phase_discrete_bin.csv");
  const auto& force = reference.at("friction_force_n");
  REQUIRE(force.size() == 30);
  int beyond_the_limit = 0;
  for (std::size_t i = 0; i < force.size(); ++i) {
    const double r = reference.at("frequency_ratio")[i];
    CAPTURE(force[i], r);
    const ResponseConstants c = response_constants(r, published);
    CHECK_THAT(c.limit_force_ratio, WithinAbs(reference.at("limit_force_ratio")[i], reference_tolerance));
    const double phase = phase_deg(c, force[i] / published.driving_force_n);
    const double expected = reference.at("phase_deg")[i];
    if (std::isnan(expected)) {
      CHECK(std::isnan(phase));
      ++beyond_the_limit;
    } else {
      CHECK_THAT(phase, WithinAbs(expected, reference_tolerance));
    }
  }
  CHECK(beyond_the_limit == 8);
}

TEST_CASE("U is Eq. 16", "[friction][response]") {
  for (const double r : many_ratios()) {
    CAPTURE(r);
    const long double angle = std::numbers::pi_v<long double> / static_cast<long double>(r);
    const double expected =
        static_cast<double>(std::sin(angle) / (static_cast<long double>(r) * (1.0L + std::cos(angle))));
    CHECK_THAT(response_function_u(r), WithinRel(expected, rounding) || WithinAbs(0.0, 1e-15));
  }
}

TEST_CASE("the response solves the equation of motion", "[friction][response]") {
  // r^2 x'' + x - phi = cos(tau + eta) on the half-period of falling x, by central differences.
  constexpr double h = 1e-4;
  constexpr double difference_tolerance = 1e-6;
  for (const double r : many_ratios()) {
    const ResponseConstants c = response_constants(r, exact);
    for (const double fraction : {0.1, 0.6, 0.95}) {
      const double phi = fraction * c.limit_force_ratio;
      const double eta = base_phase(c, phi);
      const double size = (std::fabs(c.v) + 1.0) * std::max(1.0, r * r);
      for (const double tau : {0.1, 0.8, 1.6, 2.4, 3.0}) {
        CAPTURE(r, fraction, tau);
        const double x = response(c, phi, tau);
        const double second = (response(c, phi, tau + h) - 2.0 * x + response(c, phi, tau - h)) / (h * h);
        CHECK_THAT(r * r * second + x - phi, WithinAbs(std::cos(tau + eta), difference_tolerance * size));
        // On the other half-period everything has the other sign.
        const double y = response(c, phi, pi + tau);
        const double other =
            (response(c, phi, pi + tau + h) - 2.0 * y + response(c, phi, pi + tau - h)) / (h * h);
        CHECK_THAT(r * r * other + y + phi, WithinAbs(std::cos(pi + tau + eta), difference_tolerance * size));
      }
    }
  }
}

TEST_CASE("the response turns at 0 and pi and repeats with the other sign", "[friction][response]") {
  constexpr double h = 1e-6;
  for (const double r : many_ratios()) {
    const ResponseConstants c = response_constants(r, exact);
    const double phi = 0.7 * c.limit_force_ratio;
    const double size = std::fabs(c.v) + 1.0;
    CAPTURE(r);
    const double start = response(c, phi, 0.0);
    CHECK(start > 0.0);
    CHECK_THAT(start, WithinRel(std::sqrt(c.v * c.v - c.u * c.u * phi * phi), rounding));
    CHECK_THAT(response(c, phi, pi), WithinAbs(-start, rounding * size));
    CHECK_THAT(response(c, phi, std::nextafter(pi, 0.0)), WithinAbs(-start, rounding * size));
    CHECK_THAT((response(c, phi, h) - start) / h, WithinAbs(0.0, 10.0 * h * size / std::min(1.0, r * r)));
    CHECK_THAT((response(c, phi, pi - h) + start) / h,
               WithinAbs(0.0, 10.0 * h * size / std::min(1.0, r * r)));
    CHECK_THAT(response(c, phi, pi + 1.0), WithinAbs(-response(c, phi, 1.0), rounding * size));
  }
}

TEST_CASE("the mass never turns before pi up to the exact limit, and turns just beyond it",
          "[friction][response]") {
  // What the limit means: x' <= 0 on (0, pi). Beyond the limit -x' / sin tau is negative where S is
  // attained.
  constexpr int points = 4000;
  for (const double r : many_ratios()) {
    const ResponseConstants c = response_constants(r, exact);
    const auto rises = [&](double phi) {
      double previous = response(c, phi, 0.0);
      const double slack = rounding * (std::fabs(c.v) + 1.0);
      for (int j = 1; j <= points; ++j) {
        const double tau = pi * j / points;
        const double x = response(c, phi, std::min(tau, std::nextafter(pi, 0.0)));
        if (x > previous + slack) {
          return true;
        }
        previous = x;
      }
      return false;
    };
    CAPTURE(r);
    CHECK_FALSE(rises(c.limit_force_ratio));
    if (1.01 * c.limit_force_ratio * std::fabs(c.u) < std::fabs(c.v)) {
      CHECK(rises(1.01 * c.limit_force_ratio));
    }
  }
}

TEST_CASE("the phase is that of the first Fourier coefficient of the sampled motion",
          "[friction][response]") {
  // x'' jumps at 0 and pi, so that aliasing falls off as n^-3: 1e-13 here.
  constexpr std::size_t n = 1U << 14U;
  for (const double r : many_ratios()) {
    const ResponseConstants c = response_constants(r, exact);
    for (const double fraction : {0.05, 0.5, 0.9, 1.0}) {
      CAPTURE(r, fraction);
      const double phi = fraction * c.limit_force_ratio;
      const double eta = base_phase(c, phi);
      std::vector<double> x(n);
      std::vector<double> y(n);
      for (std::size_t j = 0; j < n; ++j) {
        const double tau = 2.0 * pi * static_cast<double>(j) / static_cast<double>(n);
        x[j] = response(c, phi, tau);
        y[j] = std::cos(tau + eta);
      }
      CHECK_THAT(phase_deg(c, phi),
                 WithinAbs(angle_deg(transform_bin(y, 1), transform_bin(x, 1)), transform_tolerance));
    }
  }
}

TEST_CASE("the published phase is that of bin 30 of the 901-point transform", "[friction][response]") {
  for (const double r : many_ratios()) {
    const ResponseConstants c = response_constants(r, published);
    for (const double fraction : {0.05, 0.5, 0.9, 1.0}) {
      CAPTURE(r, fraction);
      const double phi = fraction * c.limit_force_ratio;
      const double eta = base_phase(c, phi);
      std::vector<double> x;
      std::vector<double> y;
      for (int j = 0; j <= 900; ++j) {  // 30 periods in steps of pi/15, the end point repeated
        x.push_back(response(c, phi, pi * (j % 30) / 15.0));
        y.push_back(std::cos(pi * j / 15.0 + eta));
      }
      CHECK_THAT(phase_deg(c, phi),
                 WithinAbs(angle_deg(transform_bin(y, 30), transform_bin(x, 30)), transform_tolerance));
    }
  }
}

TEST_CASE("the two phase rules differ by hundredths of a degree", "[friction][response]") {
  const double phi = 1.086 / 2.5;
  const auto difference = [&](double r) {
    return phase_deg(response_constants(r, published), phi) - phase_deg(response_constants(r, exact), phi);
  };
  CHECK_THAT(difference(0.644), WithinAbs(-0.036, 0.001));
  CHECK_THAT(difference(1.937), WithinAbs(0.023, 0.001));
}

TEST_CASE("without friction the motion is harmonic, in phase below resonance and opposite above",
          "[friction][response]") {
  for (const double r : many_ratios()) {
    CAPTURE(r);
    const ResponseConstants c = response_constants(r, exact);
    CHECK(phase_deg(c, 0.0) == (r < 1.0 ? 0.0 : 180.0));
    CHECK_THAT(base_phase(c, 0.0), WithinAbs(r < 1.0 ? 0.0 : pi, 1e-15));
    for (const double tau : {0.0, 1.0, 3.0, 4.0}) {
      CHECK_THAT(response(c, 0.0, tau), WithinAbs(std::fabs(1.0 / (1.0 - r * r)) * std::cos(tau), 1e-11));
    }
    // To first order in phi: (4/pi) phi |V| / |V|, since x0 -> |V|
    const double small = 1e-7 * std::min(1.0, c.limit_force_ratio);
    const double slope = 4.0 / pi * small * 180.0 / pi;
    CHECK_THAT(r < 1.0 ? phase_deg(c, small) : 180.0 - phase_deg(c, small), WithinRel(slope, 1e-5));
    CHECK_THAT(phase_deg(response_constants(r, published), 0.0), WithinAbs(r < 1.0 ? 0.0 : 180.0, 1e-9));
  }
}

TEST_CASE("friction moves the phase angle away from 0 and 180 deg", "[friction][response]") {
  for (const double r : measured_ratios()) {
    const ResponseConstants c = response_constants(r, exact);
    double previous = phase_deg(c, 0.0);
    for (int j = 1; j <= 20; ++j) {
      CAPTURE(r, j);
      const double phase = phase_deg(c, std::min(c.limit_force_ratio, c.limit_force_ratio * j / 20.0));
      CHECK((r < 1.0 ? phase > previous : phase < previous));
      previous = phase;
    }
    CHECK(previous > 0.0);
    CHECK(previous < 180.0);
  }
}

TEST_CASE("the phase is not a number beyond the limit, and below zero", "[friction][response]") {
  for (const double r : measured_ratios()) {
    for (const Physics& physics : {exact, published}) {
      const ResponseConstants c = response_constants(r, physics);
      CHECK(std::isfinite(phase_deg(c, c.limit_force_ratio)));
      CHECK(std::isnan(phase_deg(c, std::nextafter(c.limit_force_ratio, 1e9))));
      CHECK(std::isnan(phase_deg(c, infinity)));
      CHECK(std::isnan(phase_deg(c, not_a_number)));
      CHECK(std::isnan(phase_deg(c, -1e-300)));
      CHECK(std::isfinite(phase_deg(c, -0.0)));
    }
  }
}

TEST_CASE("S is the supremum: 1 for every ratio of Table 1", "[friction][response]") {
  for (const double r : measured_ratios()) {
    CAPTURE(r);
    CHECK(response_function_s(r, LimitRule::supremum) == 1.0);
    CHECK(largest_quotient(r, 20000) == 1.0);
  }
}

TEST_CASE("S is the supremum: a fine grid finds no larger and nearly as large a value",
          "[friction][response]") {
  int above_one = 0;
  for (const double r :
       {0.073, 0.0911, 0.12, 0.13, 0.15, 0.161, 0.175, 0.18, 0.21, 0.22,  0.235, 0.26, 0.27,
        0.29,  0.31,   0.36, 0.4,  0.45, 0.49,  0.5,   0.51, 0.6,  0.999, 1.001, 3.0,  50.0}) {
    CAPTURE(r);
    const double s = response_function_s(r, LimitRule::supremum);
    const double on_grid = largest_quotient(r, 40000);
    // The grid misses a maximum of width r by at most (step / r)^2 / 8 of the range of the
    // quotient.
    CHECK(s >= on_grid * (1.0 - 1e-9));
    CHECK_THAT(s, WithinRel(on_grid, 1e-5));
    above_one += s > 1.001 ? 1 : 0;
  }
  CHECK(above_one >= 5);
}

TEST_CASE("S of the published scripts is the maximum over 14 points", "[friction][response]") {
  std::vector<double> ratios = many_ratios();
  ratios.insert(ratios.end(),
                {0.0752, 0.0893, 0.1102, 0.135});  // the last of the points decides for some of these
  for (const double r : ratios) {
    CAPTURE(r);
    double largest = -infinity;
    for (int j = 1; j <= 14; ++j) {
      largest = std::max(largest, s_quotient(r, pi * j / 15.0));
    }
    CHECK_THAT(response_function_s(r, LimitRule::grid), WithinRel(largest, 1e-11));
    CHECK(response_function_s(r, LimitRule::grid) <=
          response_function_s(r, LimitRule::supremum) * (1.0 + rounding));
  }
}

TEST_CASE("the limit of continuous motion is Eq. 18, with the known smallest friction forces of Table 1",
          "[friction][response]") {
  for (const double r : many_ratios()) {
    CAPTURE(r);
    for (const Physics& physics : {exact, published}) {
      const ResponseConstants c = response_constants(r, physics);
      const double u = response_function_u(r);
      const double s = response_function_s(r, physics.limit);
      const double expected =
          std::sqrt(1.0 / ((u * u + s * s / std::pow(r, 4)) * (1.0 - r * r) * (1.0 - r * r)));
      CHECK_THAT(c.limit_force_ratio, WithinRel(expected, 1e-11));
    }
  }
  const auto smallest = [](const Physics& physics) {
    double force = infinity;
    for (const double r : measured_ratios()) {
      force = std::min(force, response_constants(r, physics).limit_force_ratio * physics.driving_force_n);
    }
    return force;
  };
  CHECK_THAT(smallest(exact), WithinAbs(1.501094, 5e-7));
  CHECK_THAT(smallest(published), WithinAbs(1.543632, 5e-7));
}

TEST_CASE("singular ratios are recognised, their neighbours are not", "[friction][response]") {
  for (const int k : {1, 3, 5, 7, 9, 101, 1001}) {
    CAPTURE(k);
    const double r = 1.0 / k;
    CHECK(is_singular_ratio(r));
    CHECK(is_singular_ratio(std::nextafter(r, 0.0)));
    CHECK(is_singular_ratio(std::nextafter(r, 2.0)));
    CHECK_FALSE(is_singular_ratio(r * (1.0 + 1e-7)));
    CHECK_FALSE(is_singular_ratio(r * (1.0 - 1e-7)));
    CHECK_THROWS_AS(response_constants(r, exact), errors::InvalidValue);
    CHECK_THROWS_WITH(response_constants(r, exact), Contains("frequency_ratio = ") && Contains("unbounded"));
    CHECK_NOTHROW(response_constants(r * (1.0 + 1e-7), exact));
  }
  for (const double r : {0.5, 0.25, 0.1, 2.0, 3.0, 1e5, 0.644, 0.4}) {
    CAPTURE(r);
    CHECK_FALSE(is_singular_ratio(r));
  }
}

TEST_CASE("beside a resonance the motion is large but known", "[friction][response]") {
  for (const double r : {1.0 - 1e-6, 1.0 + 1e-6}) {
    const ResponseConstants c = response_constants(r, exact);
    CHECK_THAT(c.v, WithinRel(1.0 / ((1.0 - r) * (1.0 + r)), rounding));
    const double phi = 0.5 * c.limit_force_ratio;
    CHECK(phase_deg(c, phi) > 0.0);
    CHECK(phase_deg(c, phi) < 180.0);
  }
  // At resonance the limit is pi/4: friction takes out what the base puts in.
  CHECK_THAT(response_constants(1.0 + 1e-6, exact).limit_force_ratio, WithinRel(pi / 4.0, 1e-5));
}

TEST_CASE("a ratio without a response is refused by value", "[friction][response]") {
  for (const double r : {0.0, -0.5, infinity, -infinity, not_a_number}) {
    CAPTURE(r);
    CHECK_THROWS_AS(response_constants(r, exact), errors::InvalidValue);
    CHECK_THROWS_WITH(response_constants(r, exact), Contains("frequency_ratio"));
  }
}
