// The distributions of one parameter: densities, distribution functions, quantiles, and draws by
// their quantiles.
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "errors/invalid_value.hpp"
#include "portable_math/normal_quantile.hpp"
#include "tmcmc/distributions.hpp"
#include "tmcmc/random.hpp"
#include "tmcmc/statistics.hpp"

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using statistics::kolmogorov;
using statistics::kolmogorov_bound;
using tmcmc::Marginal;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A distribution beside the same one with one argument off by a tenth.
struct Pair {
  Marginal marginal;
  Marginal wrong;
};

std::vector<Pair> pairs() {
  return {{Marginal::uniform(-1.0, 3.0), Marginal::uniform(-1.0, 3.3)},
          {Marginal::log_uniform(0.01, 100.0), Marginal::log_uniform(0.01, 200.0)},
          {Marginal::normal(3.0, 0.5), Marginal::normal(3.0, 0.55)},
          {Marginal::truncated_normal(0.0, 1.0, 1.0, infinity),
           Marginal::truncated_normal(0.0, 1.1, 1.0, infinity)},
          {Marginal::truncated_normal(2.0, 0.5, -infinity, 0.0),
           Marginal::truncated_normal(2.0, 0.55, -infinity, 0.0)},
          {Marginal::truncated_normal(0.3, 1.0, -1.0, 2.0), Marginal::truncated_normal(0.4, 1.0, -1.0, 2.0)},
          {Marginal::half_normal(2.0), Marginal::half_normal(2.2)},
          {Marginal::log_normal(0.3, 0.8), Marginal::log_normal(0.3, 0.88)},
          {Marginal::exponential(4.0), Marginal::exponential(4.4)},
          {Marginal::gamma(2.5, 0.7), Marginal::gamma(2.75, 0.7)},
          {Marginal::gamma(0.3, 5.0), Marginal::gamma(0.33, 5.0)},
          {Marginal::inverse_gamma(3.0, 2.0), Marginal::inverse_gamma(3.3, 2.0)},
          {Marginal::beta(2.0, 5.0), Marginal::beta(2.2, 5.0)},
          {Marginal::beta(0.5, 0.7, -2.0, 8.0), Marginal::beta(0.55, 0.7, -2.0, 8.0)},
          {Marginal::weibull(1.7, 3.0), Marginal::weibull(1.7, 3.3)},
          {Marginal::gumbel(1.0, 2.0), Marginal::gumbel(1.0, 2.2)},
          {Marginal::student_t(5.0, 1.0, 0.3), Marginal::student_t(5.0, 1.0, 0.33)},
          {Marginal::triangular(-1.0, 0.5, 4.0), Marginal::triangular(-1.0, 0.9, 4.0)},
          {Marginal::triangular(2.0, 2.0, 3.0), Marginal::triangular(2.0, 2.2, 3.0)}};
}

std::vector<double> draws_of(const Marginal& marginal, std::uint64_t seed) {
  std::vector<double> draws;
  for (std::uint64_t row = 0; row < 5000; ++row) {
    for (const std::uint64_t word : tmcmc::random_words({.seed = seed}, {.row = row})) {
      draws.push_back(marginal.quantile(tmcmc::uniform_open(word)));
    }
  }
  return draws;
}

/// Distribution functions that are written here, for what is not Boost.Math's own.
double expected_cdf(const Marginal& m, double x) {
  const auto& a = m.arguments();
  const auto name = m.distribution();
  using statistics::normal_cdf;
  if (name == "uniform") {
    return (x - a[0]) / (a[1] - a[0]);
  }
  if (name == "log_uniform") {
    return std::log(x / a[0]) / std::log(a[1] / a[0]);
  }
  if (name == "normal") {
    return normal_cdf((x - a[0]) / a[1]);
  }
  if (name == "truncated_normal") {
    const auto at = [&](double y) { return normal_cdf((y - a[0]) / a[1]); };
    return (at(x) - at(a[2])) / (at(a[3]) - at(a[2]));
  }
  if (name == "half_normal") {
    return std::erf(x / a[0] / std::sqrt(2.0));
  }
  if (name == "log_normal") {
    return normal_cdf((std::log(x) - a[0]) / a[1]);
  }
  if (name == "exponential") {
    return -std::expm1(-a[0] * x);
  }
  if (name == "weibull") {
    return -std::expm1(-std::pow(x / a[1], a[0]));
  }
  if (name == "gumbel") {
    return std::exp(-std::exp(-(x - a[0]) / a[1]));
  }
  if (name == "triangular") {
    return x < a[1] ? std::pow(x - a[0], 2) / ((a[2] - a[0]) * (a[1] - a[0]))
                    : 1.0 - std::pow(a[2] - x, 2) / ((a[2] - a[0]) * (a[2] - a[1]));
  }
  return m.cdf(x);
}

std::string field_of(const std::function<Marginal()>& make) {
  try {
    static_cast<void>(make());
  } catch (const errors::InvalidValue& error) {
    return error.field();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("draws of every distribution pass Kolmogorov's test, and fail it with an argument off by a tenth",
          "[tmcmc][marginal]") {
  for (const auto& [marginal, wrong] : pairs()) {
    CAPTURE(marginal.text());
    const auto draws = draws_of(marginal, 11);
    CHECK(kolmogorov(draws, [m = marginal](double x) { return expected_cdf(m, x); }) < kolmogorov_bound);
    CHECK(kolmogorov(draws, [m = wrong](double x) { return m.cdf(x); }) > kolmogorov_bound);
  }
}

TEST_CASE("densities integrate to the distribution function", "[tmcmc][marginal]") {
  for (const auto& pair : pairs()) {
    const Marginal& m = pair.marginal;
    CAPTURE(m.text());
    for (const double p : {0.001, 0.1, 0.5, 0.9}) {
      // Two hundredths in probability further on, away from singular ends.
      const double from = m.quantile(p);
      const double to = m.quantile(p + 0.02);
      const double integral = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
          [&](double x) { return std::exp(m.log_density(x)); }, from, to, 15, 1e-12);
      CHECK_THAT(integral, WithinRel(0.02, 1e-9));
      CHECK_THAT(m.cdf(to) - m.cdf(from), WithinRel(0.02, 1e-11));
    }
  }
}

TEST_CASE("quantiles invert distribution functions, in both tails", "[tmcmc][marginal]") {
  for (const auto& pair : pairs()) {
    const Marginal& m = pair.marginal;
    CAPTURE(m.text());
    for (const double p : {1e-12, 1e-5, 0.01, 0.3, 0.5, 0.77, 0.999}) {
      CAPTURE(p);
      const double x = m.quantile(p);
      // As near as the doubles around x allow.
      const double before = std::nextafter(x, -infinity);
      const double after = std::nextafter(x, infinity);
      CHECK(m.cdf(before) <= p * (1.0 + 1e-9));
      CHECK(m.cdf(after) >= p * (1.0 - 1e-9));
      CHECK_THAT(m.cdf(x) + m.complement(x), WithinRel(1.0, 1e-13));
      CHECK(m.normal_score(before) <= portable_math::normal_quantile(p) + 1e-9);
      CHECK(m.normal_score(after) >= portable_math::normal_quantile(p) - 1e-9);
    }
    for (const double z : {-5.0, -1.0, 0.0, 0.4, 2.0, 5.0}) {
      CAPTURE(z);
      const double x = m.from_normal(z);
      CHECK(m.normal_score(std::nextafter(x, -infinity)) <= z + 1e-9);
      CHECK(m.normal_score(std::nextafter(x, infinity)) >= z - 1e-9);
    }
    CHECK(m.quantile(0.0) == m.support().lower);
    CHECK(m.quantile(1.0) == m.support().upper);
    CHECK(m.cdf(m.support().lower) == 0.0);
    CHECK(m.complement(m.support().upper) == 0.0);
    CHECK(std::isnan(m.quantile(1.5)));
    if (m.support().lower > -infinity) {
      CHECK(m.log_density(std::nextafter(m.support().lower, -infinity)) == -infinity);
    }
    if (m.support().upper < infinity) {
      CHECK(m.log_density(std::nextafter(m.support().upper, infinity)) == -infinity);
    }
  }
}

TEST_CASE("a normal distribution cut far from its mean keeps its digits", "[tmcmc][marginal]") {
  const Marginal far = Marginal::truncated_normal(0.0, 1.0, 20.0, infinity);
  CHECK_THAT(std::erfc(far.quantile(0.5) * std::sqrt(0.5)),
             WithinRel(0.5 * std::erfc(20.0 * std::sqrt(0.5)), 1e-11));
  CHECK_THAT(far.cdf(far.quantile(0.01)), WithinRel(0.01, 1e-9));
  CHECK(field_of([] { return Marginal::truncated_normal(0.0, 1.0, 60.0, 61.0); }) == "lower");
}

TEST_CASE("the other ways to state a log-normal distribution agree with their meaning", "[tmcmc][marginal]") {
  const Marginal by_mean = Marginal::log_normal_of_mean(3.0, 1.5);
  const double mu = by_mean.arguments()[0];
  const double sigma = by_mean.arguments()[1];
  CHECK_THAT(std::exp(mu + 0.5 * sigma * sigma), WithinRel(3.0, 1e-14));
  CHECK_THAT(3.0 * std::sqrt(std::expm1(sigma * sigma)), WithinRel(1.5, 1e-13));
  const Marginal by_median = Marginal::log_normal_of_median(3.0, 0.5);
  CHECK_THAT(by_median.quantile(0.5), WithinRel(3.0, 1e-14));
  CHECK_THAT(by_median.arguments()[1], WithinRel(sigma, 1e-14));
}

TEST_CASE("an argument out of its range is named", "[tmcmc][marginal]") {
  CHECK(field_of([] { return Marginal::normal(0.0, 0.0); }) == "sd");
  CHECK(field_of([] { return Marginal::normal(NAN, 1.0); }) == "mean");
  CHECK(field_of([] { return Marginal::uniform(2.0, 1.0); }) == "upper");
  CHECK(field_of([] { return Marginal::uniform(-infinity, 1.0); }) == "lower");
  CHECK(field_of([] { return Marginal::log_uniform(0.0, 1.0); }) == "lower");
  CHECK(field_of([] { return Marginal::truncated_normal(0.0, 1.0, 2.0, 1.0); }) == "upper");
  CHECK(field_of([] { return Marginal::half_normal(-1.0); }) == "sd");
  CHECK(field_of([] { return Marginal::log_normal(0.0, -1.0); }) == "sigma");
  CHECK(field_of([] { return Marginal::log_normal_of_mean(-1.0, 1.0); }) == "mean");
  CHECK(field_of([] { return Marginal::log_normal_of_median(1.0, 0.0); }) == "cov");
  CHECK(field_of([] { return Marginal::exponential(infinity); }) == "rate");
  CHECK(field_of([] { return Marginal::gamma(0.0, 1.0); }) == "shape");
  CHECK(field_of([] { return Marginal::inverse_gamma(1.0, 0.0); }) == "scale");
  CHECK(field_of([] { return Marginal::beta(1.0, -1.0); }) == "beta");
  CHECK(field_of([] { return Marginal::weibull(1.0, -2.0); }) == "scale");
  CHECK(field_of([] { return Marginal::gumbel(0.0, 0.0); }) == "scale");
  CHECK(field_of([] { return Marginal::student_t(0.0, 0.0, 1.0); }) == "degrees_of_freedom");
  CHECK(field_of([] { return Marginal::triangular(0.0, 2.0, 1.0); }) == "mode");
}

TEST_CASE("improper priors are refused with the reason", "[tmcmc][marginal]") {
  const auto reason = Catch::Matchers::Contains("without a normalised prior there is no evidence");
  CHECK_THROWS_WITH(Marginal::uniform(0.0, infinity), reason);
  CHECK_THROWS_WITH(Marginal::uniform(-infinity, 0.0), reason);
  CHECK_THROWS_WITH(Marginal::log_uniform(0.0, 1.0), Catch::Matchers::Contains("there is no evidence"));
}

TEST_CASE("distributions are found by name and by the names of their arguments", "[tmcmc][marginal]") {
  for (const auto& row : tmcmc::distributions()) {
    std::map<std::string, double, std::less<>> arguments;
    double value = 0.5;
    for (const auto name : row.arguments) {
      arguments[std::string(name)] = value += 0.25;  // ascending, as bounds have to be
    }
    if (row.name == "triangular") {
      arguments = {{"lower", 1.0}, {"mode", 2.0}, {"upper", 3.0}};
    }
    CHECK(tmcmc::make_marginal(row.name, arguments).distribution() == row.name);
  }
  CHECK(tmcmc::make_marginal("normal", {{"sd", 2.0}, {"mean", 1.0}}).text() == "normal(1, 2)");
  CHECK(tmcmc::make_marginal("log_normal", {{"median", 1.0}, {"cov", 0.1}}).quantile(0.5) == 1.0);
  CHECK_THROWS_WITH(tmcmc::make_marginal("gaussian", {}),
                    "distribution = gaussian: expected " + tmcmc::distribution_names());
  CHECK_THAT(tmcmc::distribution_names(), Catch::Matchers::StartsWith("uniform, log_uniform, normal, ") &&
                                              Catch::Matchers::EndsWith("student_t or triangular"));
  CHECK_THROWS_WITH(
      tmcmc::make_marginal("log_normal", {{"mean", 1.0}}),
      "distribution = log_normal: expected the arguments mu, sigma; or mean, sd; or median, cov, not "
      "mean");
}

TEST_CASE("distributions whose quantiles need Boost.Math are not called portable", "[tmcmc][marginal]") {
  for (const auto& pair : pairs()) {
    const auto name = pair.marginal.distribution();
    const bool by_boost = name == "truncated_normal" || name == "gamma" || name == "inverse_gamma" ||
                          name == "beta" || name == "student_t";
    CHECK(pair.marginal.portable() == !by_boost);
  }
}
