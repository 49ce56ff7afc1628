// Tabulated densities against distributions with closed forms.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "errors/invalid_value.hpp"
#include "estimation/graded_mesh.hpp"
#include "estimation/tabulated_density.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using estimation::graded_mesh;
using estimation::IntegrationError;
using estimation::TabulatedDensity;

constexpr double tight = 1e-12;

/// Unnormalised normal density on [lower, upper].
TabulatedDensity normal(double mean, double deviation, double lower, double upper) {
  const auto log_density = [=](double x) {
    const double z = (x - mean) / deviation;
    return -0.5 * z * z;
  };
  const double mode = std::min(std::max(mean, lower), upper);
  return {"normal", log_density, graded_mesh(lower, upper, {mode}, {}, [&](double a, double b) {
            return log_density(a) - log_density(b);
          })};
}

double normal_below(double z) {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

}  // namespace

TEST_CASE("a normal density has its integral, moments, distribution function and quantiles", "[estimation]") {
  const auto table = normal(3.0, 0.25, -100.0, 50.0);
  CHECK_THAT(table.log_integral(), WithinAbs(std::log(0.25 * std::sqrt(2.0 * std::numbers::pi)), tight));
  CHECK_THAT(table.mean(), WithinAbs(3.0, tight));
  CHECK_THAT(table.standard_deviation(), WithinRel(0.25, tight));
  CHECK(table.relative_error() < tight);
  for (const double z : {-12.0, -5.0, -1.0, -0.01, 0.0, 0.7, 2.0, 6.0, 12.0}) {
    CAPTURE(z);
    const double x = 3.0 + 0.25 * z;
    CHECK_THAT(table.density(x),
               WithinRel(std::exp(-0.5 * z * z) / (0.25 * std::sqrt(2.0 * std::numbers::pi)), 1e-11));
    CHECK_THAT(table.cdf(x), WithinRel(normal_below(z), 1e-11));
    CHECK_THAT(table.exceedance(x), WithinRel(normal_below(-z), 1e-11));
    CHECK_THAT(table.log_cdf(x), WithinAbs(std::log(normal_below(z)), 1e-11));
  }
  for (const double p : {1e-30, 1e-9, 0.1, 0.5, 0.77, 1.0 - 1e-9}) {
    CAPTURE(p);
    CHECK_THAT(table.cdf(table.quantile(p)), WithinRel(p, tight));
  }
  for (const double p : {1e-30, 1e-9, 0.1, 0.5, 0.77}) {
    CHECK_THAT(table.quantile_of_log_exceedance(std::log(p)), WithinAbs(6.0 - table.quantile(p), tight));
  }
  CHECK(table.quantile(0.0) == table.lower());
  CHECK(table.quantile(1.0) == table.upper());
  CHECK(table.cdf(-200.0) == 0.0);
  CHECK(table.cdf(200.0) == 1.0);
  CHECK(table.density(200.0) == 0.0);
  CHECK(table.exceedance(200.0) == 0.0);
}

TEST_CASE("a density 1e-9 of the interval wide, or against its end, is found", "[estimation]") {
  const auto narrow = normal(0.3, 1e-9, 0.0, 1.0);
  CHECK_THAT(narrow.standard_deviation(), WithinRel(1e-9, 1e-6));  // 0.3 is only known to 6e-17
  CHECK_THAT(narrow.log_integral(), WithinAbs(std::log(1e-9 * std::sqrt(2.0 * std::numbers::pi)), 1e-6));
  const auto cut = normal(-30.0, 1.0, 0.0, 100.0);
  CHECK_THAT(cut.log_integral() - 0.5 * std::log(2.0 * std::numbers::pi),
             WithinAbs(std::log(normal_below(-30.0)), 1e-10));
  CHECK_THAT(cut.quantile(0.5), WithinRel(std::log(2.0) / 30.0, 0.01));
}

TEST_CASE("two modes with a gap between them, and a kink", "[estimation]") {
  const auto two = [](double x) {
    const double a = (x - 1.0) / 0.001;
    const double b = (x - 9.0) / 0.002;
    return std::max(-0.5 * a * a, -0.5 * b * b);
  };
  const TabulatedDensity table("two", two, graded_mesh(0.0, 10.0, {1.0, 9.0}, {5.0}, [&](double a, double b) {
                                 return two(a) - two(b);
                               }));
  CHECK_THAT(table.cdf(5.0), WithinAbs(1.0 / 3.0, tight));
  CHECK_THAT(table.exceedance(4.0), WithinAbs(2.0 / 3.0, tight));
  CHECK_THAT(table.quantile(1.0 / 6.0), WithinAbs(1.0, 1e-12));
  CHECK_THAT(table.mean(), WithinRel(19.0 / 3.0, tight));
  CHECK(table.density(5.0) == 0.0);

  const TabulatedDensity kink("kink", [](double x) { return -std::fabs(x - std::numbers::inv_pi); },
                              {-40.0, 50.0});
  CHECK_THAT(kink.log_integral(), WithinAbs(std::log(2.0), 1e-11));
  CHECK_THAT(kink.cdf(0.0), WithinAbs(0.5 * std::exp(-std::numbers::inv_pi), 1e-11));
}

TEST_CASE("log-probabilities far below the smallest double are kept", "[estimation]") {
  estimation::TabulationOptions options;
  options.cutoff_nats = std::numeric_limits<double>::infinity();
  const TabulatedDensity table(
      "exponential", [](double x) { return -x; }, {0.0, 5000.0}, options);
  CHECK_THAT(table.log_exceedance(4000.0), WithinAbs(-4000.0, 1e-9));
  CHECK_THAT(table.quantile_of_log_exceedance(-3000.0), WithinAbs(3000.0, 1e-9));
}

TEST_CASE("what cannot be integrated is refused", "[estimation]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto zero = [](double) { return -infinity; };
  const auto broken = [](double x) { return x < 0.5 ? 0.0 : std::nan(""); };
  const auto pole = [](double x) { return -2.0 * std::log(std::fabs(x - 0.3)); };
  CHECK_THROWS_WITH(TabulatedDensity("zero", zero, {0.0, 1.0}), Contains("zero") && Contains("not positive"));
  CHECK_THROWS_WITH(TabulatedDensity("broken", broken, {0.0, 1.0}), Contains("not a number"));
  CHECK_THROWS_AS(TabulatedDensity("pole", pole, {0.0, 1.0}), IntegrationError);
  // Noise of several nats between neighbouring doubles.
  const auto noise = [](double x) { return 40.0 * std::sin(1e19 * x); };
  CHECK_THROWS_WITH(TabulatedDensity("noise", noise, {0.0, 1.0}, {1e-12, 100.0, 300}),
                    Contains("max_panels = 300"));
  const auto table = normal(0.0, 1.0, -10.0, 10.0);
  for (const double p : {-0.1, 1.1, std::nan("")}) {
    CHECK_THROWS_AS(table.quantile(p), errors::InvalidValue);
  }
}
