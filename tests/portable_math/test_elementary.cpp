// Elementary functions against the long double functions of the C library.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

#include "portable_math/elementary.hpp"
#include "portable_math/normal_quantile.hpp"

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest_normal = std::numeric_limits<double>::min();
constexpr double smallest_subnormal = std::numeric_limits<double>::denorm_min();
constexpr long double pi = std::numbers::pi_v<long double>;

constexpr int points = 100000;  // of each range
// The header states 3. These are what the functions reach; the bits are the same on every machine,
// and so are the errors.
constexpr double exp_ulps = 1.0;
constexpr double log_ulps = 0.9;
constexpr double atan2_ulps = 1.8;
constexpr double sin_cos_ulps = 2.0;        // for |x| up to 1000
constexpr double large_sin_cos_ulps = 2.5;  // up to 1e5, where the reduced argument is rounded twice
constexpr double turn_ulps = 2.0;
constexpr double turn_tolerance = 1.5 * std::numeric_limits<double>::epsilon();

/// Error in units in the last place of the exact result.
double ulps(double value, long double exact) {
  int exponent = 0;
  std::frexp(exact, &exponent);
  const long double unit = std::ldexp(1.0L, std::max(exponent - 53, -1074));
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact) / unit);
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(generator_() >> 11U) * 0x1p-53);
  }
  /// Every exponent of a positive normal number is as likely.
  double any_exponent() {
    return std::ldexp(uniform(1.0, 2.0), static_cast<int>(generator_() % 2046U) - 1022);
  }

 private:
  std::mt19937_64 generator_;
};

template <class Draw, class Function, class Exact>
double largest_error(Draw draw, Function function, Exact exact) {
  double largest = 0.0;
  for (int i = 0; i < points; ++i) {
    const double x = draw();
    const double error = ulps(function(x), exact(static_cast<long double>(x)));
    largest = error <= largest ? largest : error;  // a NaN counts as the largest
  }
  return largest;
}

bool is_positive_zero(double x) {
  return x == 0.0 && !std::signbit(x);
}

}  // namespace

TEST_CASE("exp is within 1 ulp wherever its result is normal", "[portable_math]") {
  Random random(1);
  const auto function = [](double x) { return portable_math::exp(x); };
  const auto exact = [](long double x) { return std::exp(x); };
  for (const auto& [low, high] : {std::pair{-706.7, 709.78}, {-40.0, 0.0}, {-0.4, 0.4}, {-1e-6, 1e-6}}) {
    CAPTURE(low, high);
    CHECK(largest_error([&, a = low, b = high] { return random.uniform(a, b); }, function, exact) < exp_ulps);
  }
}

TEST_CASE("exp has its known values at the edges", "[portable_math]") {
  CHECK(portable_math::exp(0.0) == 1.0);
  CHECK(portable_math::exp(-0.0) == 1.0);
  CHECK(portable_math::exp(smallest_subnormal) == 1.0);
  CHECK(portable_math::exp(infinity) == infinity);
  CHECK(is_positive_zero(portable_math::exp(-infinity)));
  CHECK(is_positive_zero(portable_math::exp(-1e300)));
  CHECK(portable_math::exp(1e300) == infinity);
  CHECK(std::isnan(portable_math::exp(not_a_number)));

  const double overflow = 709.782712893384;  // log of the largest double
  CHECK(std::isfinite(portable_math::exp(overflow)));
  CHECK(portable_math::exp(overflow) > 1.797e308);
  CHECK(portable_math::exp(std::nextafter(overflow, 1e3)) == infinity);

  const double underflow = -706.8;
  CHECK(portable_math::exp(underflow) > 1e-307);
  CHECK(portable_math::exp(underflow) < 1.1e-307);
  CHECK(is_positive_zero(portable_math::exp(std::nextafter(underflow, -1e3))));
}

TEST_CASE("log is within 0.9 ulp for every positive number", "[portable_math]") {
  Random random(2);
  const auto function = [](double x) { return portable_math::log(x); };
  const auto exact = [](long double x) { return std::log(x); };
  CHECK(largest_error([&] { return random.any_exponent(); }, function, exact) < log_ulps);
  CHECK(largest_error([&] { return random.uniform(0.5, 2.0); }, function, exact) < log_ulps);
  CHECK(largest_error([&] { return random.uniform(1.0 - 1e-9, 1.0 + 1e-9); }, function, exact) < log_ulps);
  const auto subnormal = [&] {
    return std::max(
        random.uniform(0.0, smallest_normal) * std::ldexp(1.0, -static_cast<int>(random.uniform(0.0, 50.0))),
        smallest_subnormal);
  };
  CHECK(largest_error(subnormal, function, exact) < log_ulps);
}

TEST_CASE("log has its known values at the edges", "[portable_math]") {
  CHECK(is_positive_zero(portable_math::log(1.0)));
  CHECK(portable_math::log(0.0) == -infinity);
  CHECK(portable_math::log(-0.0) == -infinity);
  CHECK(portable_math::log(infinity) == infinity);
  CHECK(std::isnan(portable_math::log(not_a_number)));
  CHECK(std::isnan(portable_math::log(-smallest_subnormal)));
  CHECK(std::isnan(portable_math::log(-1.0)));
  CHECK(std::isnan(portable_math::log(-infinity)));
  for (const double x :
       {smallest_subnormal, smallest_normal, std::nextafter(smallest_normal, 0.0),
        std::numeric_limits<double>::max(), std::nextafter(1.0, 0.0), std::nextafter(1.0, 2.0)}) {
    CAPTURE(x);
    CHECK(ulps(portable_math::log(x), std::log(static_cast<long double>(x))) < log_ulps);
  }
}

TEST_CASE("log_positive is log where it is defined, bit for bit", "[portable_math]") {
  Random random(7);
  bool same = true;
  for (int i = 0; i < points; ++i) {
    const double x = i % 2 == 0 ? random.any_exponent() : random.uniform(0.0, 2.0);
    same = same && portable_math::log_positive(x) == portable_math::log(x);
  }
  CHECK(same);
  CHECK(portable_math::log_positive(smallest_normal) == portable_math::log(smallest_normal));
  CHECK(portable_math::log_positive(1.0) == 0.0);
}

TEST_CASE("exp and log undo each other", "[portable_math]") {
  Random random(3);
  double largest = 0.0;
  for (int i = 0; i < points; ++i) {
    const double x = random.uniform(-700.0, 700.0);
    // log(exp(x) (1 + 2 ulp)) = x + 2 ulp(1) and the error of log
    largest = std::max(largest, std::fabs(portable_math::log(portable_math::exp(x)) - x) /
                                    (std::numeric_limits<double>::epsilon() * std::max(1.0, std::fabs(x))));
  }
  CHECK(largest < 2.0 * exp_ulps);
}

TEST_CASE("atan2 is within 1.8 ulp in every octant and at every distance", "[portable_math]") {
  Random random(4);
  double largest = 0.0;
  const auto check = [&](double y, double x) {
    const double error = ulps(portable_math::atan2(y, x),
                              std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
    largest = error <= largest ? largest : error;
  };
  for (int i = 0; i < points; ++i) {
    check(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    // quotients that are not subnormal
    const double y = std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.uniform(-400.0, 400.0)));
    const double x = std::ldexp(random.uniform(-1.0, 1.0), static_cast<int>(random.uniform(-400.0, 400.0)));
    check(y, x);
  }
  for (const double boundary : {0.41421356237309503, 1.0, 2.4142135623730950}) {  // between the octants
    for (const double y : {std::nextafter(boundary, 0.0), boundary, std::nextafter(boundary, 3.0)}) {
      for (const double sign_y : {-1.0, 1.0}) {
        check(sign_y * y, 1.0);
        check(sign_y * y, -1.0);
      }
    }
  }
  CHECK(largest < atan2_ulps);
}

TEST_CASE("atan2 is correctly rounded beside three of the half-axes", "[portable_math]") {
  Random random(9);
  double largest = 0.0;
  for (int i = 0; i < points / 10; ++i) {
    const double small = random.uniform(-1e-13, 1e-13);
    for (const auto& [y, x] : {std::pair{small, -1.0}, {1.0, std::fabs(small)}, {-1.0, std::fabs(small)}}) {
      const double error = ulps(portable_math::atan2(y, x),
                                std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
      largest = error <= largest ? largest : error;
    }
  }
  CHECK(largest < 0.501);
}

TEST_CASE("polar_angle is atan2 on the upper half-plane", "[portable_math]") {
  Random random(8);
  double largest = 0.0;
  for (int i = 0; i < points; ++i) {
    const double scale = std::ldexp(1.0, i % 600 - 300);
    const double y = scale * random.uniform(0.0, 1.0);
    const double x = random.uniform(-1.0, 1.0);
    const double error = ulps(portable_math::polar_angle(y, x),
                              std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
    largest = error <= largest ? largest : error;
  }
  CHECK(largest < atan2_ulps);
  CHECK(portable_math::polar_angle(0.0, 1.0) == 0.0);
  CHECK(portable_math::polar_angle(0.0, -1.0) == std::numbers::pi);
  CHECK(portable_math::polar_angle(2.0, 0.0) == 0.5 * std::numbers::pi);
}

TEST_CASE("atan2 has its known values on the axes and at the origin", "[portable_math]") {
  constexpr double half_pi = 0.5 * std::numbers::pi;
  CHECK(portable_math::atan2(0.0, 0.0) == 0.0);
  CHECK(portable_math::atan2(0.0, 2.0) == 0.0);
  CHECK(portable_math::atan2(0.0, -2.0) == std::numbers::pi);
  CHECK(portable_math::atan2(3.0, 0.0) == half_pi);
  CHECK(portable_math::atan2(-3.0, 0.0) == -half_pi);
  CHECK(portable_math::atan2(1.0, 1.0) == 0.5 * half_pi);
  CHECK(portable_math::atan2(-1.0, -1.0) == -1.5 * half_pi);
  CHECK(portable_math::atan2(1e306, 1e306) == 0.5 * half_pi);
  CHECK(portable_math::atan2(smallest_normal, smallest_normal) == 0.5 * half_pi);
  CHECK(portable_math::atan2(-smallest_subnormal, -1.0) == -std::numbers::pi);
  // A signed zero is a zero: the angle stays in (-pi, pi].
  CHECK(portable_math::atan2(-0.0, 1.0) == 0.0);
  CHECK(portable_math::atan2(-0.0, -1.0) == std::numbers::pi);
  CHECK(portable_math::atan2(0.0, -0.0) == 0.0);
  CHECK(std::isnan(portable_math::atan2(not_a_number, 1.0)));
  CHECK(std::isnan(portable_math::atan2(1.0, not_a_number)));
}

TEST_CASE("sine and cosine are within 2 ulp up to 1e3 and 2.5 up to 1e5, also beside their zeros",
          "[portable_math]") {
  Random random(5);
  const auto sine = [](double x) { return portable_math::sin_cos(x).sin; };
  const auto cosine = [](double x) { return portable_math::sin_cos(x).cos; };
  const auto exact_sine = [](long double x) { return std::sin(x); };
  const auto exact_cosine = [](long double x) { return std::cos(x); };
  for (const double range : {1e-3, 1.0, 10.0, 1e3, 1e5}) {
    CAPTURE(range);
    const double tolerance = range > 1e3 ? large_sin_cos_ulps : sin_cos_ulps;
    const auto anywhere = [&] { return random.uniform(-range, range); };
    const auto near_zero_of_either = [&] {
      const double zero = std::floor(random.uniform(0.0, range)) * (0.5 * std::numbers::pi);
      return std::min(zero * (1.0 + random.uniform(-1e-13, 1e-13)), 1e5);
    };
    CHECK(largest_error(anywhere, sine, exact_sine) < tolerance);
    CHECK(largest_error(anywhere, cosine, exact_cosine) < tolerance);
    CHECK(largest_error(near_zero_of_either, sine, exact_sine) < tolerance);
    CHECK(largest_error(near_zero_of_either, cosine, exact_cosine) < tolerance);
  }
}

TEST_CASE("sine and cosine have their known values and signs", "[portable_math]") {
  CHECK(portable_math::sin(0.0) == 0.0);
  CHECK(portable_math::cos(0.0) == 1.0);
  CHECK(portable_math::sin(smallest_normal) == smallest_normal);
  CHECK(portable_math::sin(0.5 * std::numbers::pi) == 1.0);
  CHECK(portable_math::cos(std::numbers::pi) == -1.0);
  CHECK(portable_math::sin(1.5 * std::numbers::pi) == -1.0);
  CHECK(ulps(portable_math::sin(std::numbers::pi), 1.2246467991473531772e-16L) < sin_cos_ulps);
  CHECK(ulps(portable_math::cos(0.5 * std::numbers::pi), 6.1232339957367658e-17L) < sin_cos_ulps);
  CHECK(std::isnan(portable_math::sin(not_a_number)));
  CHECK(std::isnan(portable_math::cos(infinity)));
  for (const double x : {0.3, 2.0, 4.0, 5.5, 7.0, 12345.678}) {
    CAPTURE(x);
    CHECK(portable_math::sin(-x) == -portable_math::sin(x));
    CHECK(portable_math::cos(-x) == portable_math::cos(x));
  }
}

TEST_CASE("sine and cosine of turns are exact at the quarters and right between them", "[portable_math]") {
  const auto at = [](double u) { return portable_math::sin_cos_turns(u); };
  CHECK((at(0.0).sin == 0.0 && at(0.0).cos == 1.0));
  CHECK((at(0.25).sin == 1.0 && at(0.25).cos == 0.0));
  CHECK((at(0.5).sin == 0.0 && at(0.5).cos == -1.0));
  CHECK((at(0.75).sin == -1.0 && at(0.75).cos == 0.0));
  CHECK((at(1.0).sin == 0.0 && at(1.0).cos == 1.0));

  Random random(6);
  double largest = 0.0;
  double largest_absolute = 0.0;
  for (int i = 0; i < points; ++i) {
    // Distances from a multiple of a quarter turn, so that the long double argument has no
    // cancellation.
    const int quarter = i % 5;
    const double low = quarter == 0 ? 0.0 : -0.125;
    const double high = quarter == 4 ? 0.0 : 0.125;
    const double scale = std::ldexp(1.0, -(i % 40));
    const double u = 0.25 * quarter + random.uniform(low, high) * scale;
    const long double angle = 2.0L * pi * (static_cast<long double>(u) - 0.25L * quarter);
    const long double s = std::sin(angle);
    const long double c = std::cos(angle);
    const long double exact_sine = quarter % 4 == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
    const long double exact_cosine = quarter % 4 == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
    const auto value = at(u);
    for (const double error : {ulps(value.sin, exact_sine), ulps(value.cos, exact_cosine)}) {
      largest = error <= largest ? largest : error;
    }
    const long double turned = 2.0L * pi * static_cast<long double>(u);
    const double absolute = static_cast<double>(
        std::max(std::fabs(value.sin - std::sin(turned)), std::fabs(value.cos - std::cos(turned))));
    largest_absolute = absolute <= largest_absolute ? largest_absolute : absolute;
  }
  CHECK(largest < turn_ulps);
  CHECK(largest_absolute < turn_tolerance);
}

TEST_CASE("the normal quantile agrees with the error function to its last digits", "[portable_math]") {
  for (double p = 1e-300; p < 0.5; p *= 1.7) {
    CAPTURE(p);
    const double z = portable_math::normal_quantile(p);
    const double slope = -z - 1.0 / std::min(z, -1.0);  // about -d log p / dz
    CHECK_THAT(0.5 * std::erfc(-z * std::sqrt(0.5)),
               Catch::Matchers::WithinRel(p, 1e-14 * (1.0 + slope * -z)));
  }
  for (double p = 0.25; p > 0x1p-53; p *= 0.5) {  // 1 - p is exact
    CHECK(portable_math::normal_quantile(1.0 - p) == -portable_math::normal_quantile(p));
  }
  CHECK(portable_math::normal_quantile(0.5) == 0.0);
  CHECK(portable_math::normal_quantile(0.0) == -std::numeric_limits<double>::infinity());
  CHECK(portable_math::normal_quantile(1.0) == std::numeric_limits<double>::infinity());
  CHECK(std::isnan(portable_math::normal_quantile(-0.1)));
  CHECK(std::isnan(portable_math::normal_quantile(1.1)));
  CHECK_THAT(portable_math::normal_quantile(0.975), Catch::Matchers::WithinRel(1.959963984540054, 1e-15));
}
