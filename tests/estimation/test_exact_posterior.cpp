// The exact posterior against other quadratures, closed forms and its own draws.

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "errors/invalid_value.hpp"
#include "estimation/exact_posterior.hpp"
#include "rows.hpp"
#include "tmcmc/marginal.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using estimation::ExactPosterior;
using estimation::Interval;
using estimation::ParameterBounds;
using friction::frequency_ratio_noise;
using friction::friction_force;
using friction::Likelihood;
using friction::natural_frequency;
using friction::Parameter;
using friction::phase_noise;

constexpr double two_quadratures = 1e-8;
const double log_two_pi = std::log(2.0 * std::numbers::pi);

using Kronrod = boost::math::quadrature::gauss_kronrod<double, 61>;

ExactPosterior published(const ParameterBounds& bounds = rows::table2()) {
  return {Likelihood(rows::table1(), rows::as_published()), bounds};
}

Parameter parameter(int p) {
  return static_cast<Parameter>(p);
}

/// cdf and quantile are inverse, the density is the derivative of the cdf and integrates to 1.
void check_consistency(const ExactPosterior& posterior, double density_tolerance = 1e-8) {
  for (int p = 0; p < 4; ++p) {
    CAPTURE(p);
    const auto& marginal = posterior.marginal(parameter(p));
    double integral = 0.0;
    double low = marginal.lower();
    for (const double q : {1e-9, 1e-3, 0.1, 0.5, 0.9, 0.999, 1.0}) {
      const double high = marginal.quantile(q);
      // A rounding of the quantile itself is that much probability.
      const double rounding = 2e-16 * high * marginal.density(high);
      CHECK_THAT(marginal.cdf(high), WithinAbs(q, 1e-12 + 2.0 * rounding));
      CHECK_THAT(marginal.exceedance(high), WithinAbs(1.0 - q, 1e-12 + 2.0 * rounding));
      if (high > low) {
        integral += Kronrod::integrate([&](double x) { return marginal.density(x); }, low, high, 12, 1e-10);
      }
      low = high;
    }
    CHECK_THAT(integral, WithinAbs(1.0, density_tolerance));
  }
}

/// Evidence of one factor by nested quadratures in the other order: outside over sigma by tanh-sinh
/// in log(sigma), inside over x by Gauss-Kronrod with 61 points on bands of its own.
template <class Misfit>
double log_factor(std::size_t count, Misfit misfit, const std::vector<double>& bands, const Interval& noise,
                  double offset) {
  const auto n = static_cast<double>(count);
  boost::math::quadrature::tanh_sinh<double> outer;
  const auto outside = [&](double y) {
    const double sigma = std::exp(y);
    double sum = 0.0;
    for (std::size_t i = 1; i < bands.size(); ++i) {
      sum += Kronrod::integrate(
          [&](double x) { return std::exp((1.0 - n) * y - 0.5 * misfit(x) / (sigma * sigma) - offset); },
          bands[i - 1], bands[i], 0);
    }
    return sum;
  };
  const double low = std::log(noise.lower);
  const double high = std::log(noise.upper);
  double sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    sum += outer.integrate(outside, low + i * (high - low) / 4, low + (i + 1) * (high - low) / 4, 1e-11);
  }
  return std::log(sum) + offset;
}

}  // namespace

TEST_CASE("Table 1 with the published physics and prior", "[estimation]") {
  const auto posterior = published();
  struct Expected {
    double mean;
    double deviation;
    double unit;  // of the last printed digit
  };
  const Expected expected[] = {
      {0.98189, 0.03048, 1e-5}, {3.08145, 0.01139, 1e-5}, {3.063, 0.890, 1e-3}, {0.01513, 0.00445, 1e-5}};
  for (int p = 0; p < 4; ++p) {
    CAPTURE(p);
    CHECK_THAT(posterior.marginal(parameter(p)).mean(), WithinAbs(expected[p].mean, 0.51 * expected[p].unit));
    CHECK_THAT(posterior.marginal(parameter(p)).standard_deviation(),
               WithinAbs(expected[p].deviation, 0.51 * expected[p].unit));
  }
  CHECK_THAT(posterior.marginal(friction_force).exceedance(1.0864), WithinAbs(0.001860, 5e-7));
  CHECK_THAT(posterior.log_evidence(), WithinAbs(-11.1132, 5e-5));
  CHECK(posterior.relative_error() < 1e-11);
  CHECK(posterior.mode_count(friction_force) == 1);
  CHECK(posterior.mode_count(natural_frequency) == 1);
  check_consistency(posterior);

  auto wider = rows::table2();
  wider[natural_frequency].lower = 0.001;
  CHECK_THAT(published(wider).log_evidence() - posterior.log_evidence(),
             WithinAbs(std::log(9.99 / 9.999), 1e-12));
}

TEST_CASE("two quadratures in opposite orders agree", "[estimation]") {
  const Likelihood likelihood(rows::table1(), rows::as_published());
  const auto bounds = rows::table2();
  const std::vector<double> force_bands = {
      0.01,  0.4, 0.7,  0.8,  0.85, 0.9,  0.94, 0.96, 0.975,
      0.985, 1.0, 1.02, 1.06, 1.1,  1.15, 1.25, 1.4,  likelihood.limit_friction_force_n() - 1e-15};
  const std::vector<double> frequency_bands = {0.01, 0.5,  1.0,  2.0,    2.5,    2.8,    2.95, 3.0,
                                               3.04, 3.06, 3.07, 3.0785, 3.0815, 3.0845, 3.09, 3.1,
                                               3.12, 3.16, 3.25, 3.5,    4.0,    6.0,    10.0};
  const double phase = log_factor(
      10, [&](double x) { return likelihood.phase_misfit(x); }, force_bands, bounds[phase_noise], -16.0);
  const double frequency = log_factor(
      10, [&](double x) { return likelihood.frequency_misfit(x); }, frequency_bands,
      bounds[frequency_ratio_noise], 30.0);
  const double expected = phase + frequency - 10.0 * log_two_pi - std::log(9.99 * 9.99 * 9.999 * 0.999);
  CHECK_THAT(published().log_evidence(), WithinAbs(expected, two_quadratures));
}

TEST_CASE("a fine grid through the batch likelihood gives the same evidence and moments", "[estimation]") {
  const Likelihood likelihood(rows::table1(), rows::as_published());
  const auto posterior = published();
  // F_mu and log(sigma_phase) by the trapezoidal rule; the frequency part at one point is divided
  // out.
  constexpr int forces = 400;
  constexpr int noises = 600;
  const double omega = 3.08;
  const double sigma_ratio = 0.012;
  const double frequency_part = -10.0 * (0.5 * log_two_pi + std::log(sigma_ratio)) -
                                0.5 * likelihood.frequency_misfit(omega) / (sigma_ratio * sigma_ratio);
  double total = 0.0;
  double force_mean = 0.0;
  double noise_mean = 0.0;
  double tail = 0.0;
  Eigen::MatrixXd points(forces + 1, 4);
  Eigen::VectorXd value(forces + 1);
  for (int j = 0; j <= noises; ++j) {
    const double sigma = std::exp(std::log(0.3) + j * std::log(10.0 / 0.3) / noises);
    for (int i = 0; i <= forces; ++i) {
      points.row(i) << 0.6864 + i * 0.002, omega, sigma, sigma_ratio;
    }
    likelihood(points, value);
    for (int i = 0; i <= forces; ++i) {
      const double mass = sigma * std::exp(value[i] - frequency_part) * (j == noises ? 0.5 : 1.0);
      total += mass;
      force_mean += mass * points(i, 0);
      noise_mean += mass * sigma;
      tail += i > 200 ? mass : i == 200 ? 0.5 * mass : 0.0;
    }
  }
  const double cell = 0.002 * std::log(10.0 / 0.3) / noises;
  const double grid = 1e-5;  // the distribution is cut at 10 deg, where the trapezoidal rule errs by h^2
  CHECK_THAT(force_mean / total, WithinRel(posterior.marginal(friction_force).mean(), grid));
  CHECK_THAT(noise_mean / total, WithinRel(posterior.marginal(phase_noise).mean(), grid));
  CHECK_THAT(tail / total, WithinRel(posterior.marginal(friction_force).exceedance(1.0864), 2e-3));
  const double log_phase_integral = posterior.marginal(phase_noise).log_integral() - 5.0 * log_two_pi;
  CHECK_THAT(std::log(total * cell), WithinAbs(log_phase_integral, grid));
}

TEST_CASE("the marginal of the natural frequency is Student's where the noise prior does not cut",
          "[estimation]") {
  // In the period 1/omega the misfit is a parabola, so the marginal in omega has density (1 + c
  // z^2)^(-(n-1)/2).
  auto bounds = rows::table2();
  bounds[frequency_ratio_noise] = {1e-5, 1e3};
  const Likelihood likelihood(rows::table1(), rows::as_published());
  const auto posterior = published(bounds);
  const auto& marginal = posterior.marginal(natural_frequency);
  const auto expected = [&](double a, double b) {
    return std::pow(likelihood.frequency_misfit(a) / likelihood.frequency_misfit(b), -4.5);
  };
  for (const double omega : {2.9, 3.0, 3.05, 3.1, 3.2, 4.0}) {
    CHECK_THAT(marginal.density(omega) / marginal.density(3.08), WithinRel(expected(omega, 3.08), 1e-9));
  }
}

TEST_CASE("many rows with small noise", "[estimation]") {
  for (const double noise : {2.0, 1e-3}) {
    CAPTURE(noise);
    const double ratio_noise = std::min(noise, 0.01);
    const auto o = rows::synthetic(2000, noise, ratio_noise);
    auto bounds = rows::table2();
    bounds[phase_noise].lower = bounds[frequency_ratio_noise].lower = 1e-4;
    const Likelihood likelihood(o, {});
    const ExactPosterior posterior(likelihood, bounds);
    check_consistency(posterior, 1e-7);
    const double standard_errors = 4.0;
    const double truth[] = {rows::true_force_n, rows::true_frequency_hz, noise, ratio_noise};
    for (int p = 0; p < 4; ++p) {
      const auto& marginal = posterior.marginal(parameter(p));
      CHECK_THAT(marginal.mean(), WithinAbs(truth[p], standard_errors * marginal.standard_deviation()));
    }
    // sigma has standard deviation sigma / sqrt(2 n) up to 1/n.
    const auto& sigma = posterior.marginal(phase_noise);
    CHECK_THAT(sigma.standard_deviation() / sigma.mean(), WithinRel(1.0 / std::sqrt(4000.0), 2e-3));
  }
}

TEST_CASE("prior bounds that cut the bulk", "[estimation]") {
  const auto full = published();
  auto bounds = rows::table2();
  bounds[friction_force] = {0.97, 1.03};
  bounds[natural_frequency] = {3.085, 10.0};
  const auto cut = published(bounds);
  check_consistency(cut);
  // Cutting F_mu and omega_n renormalises their marginals.
  for (const auto p : {friction_force, natural_frequency}) {
    const auto& before = full.marginal(p);
    const auto& after = cut.marginal(p);
    const Interval range = bounds[static_cast<std::size_t>(p)];
    const double kept = before.cdf(range.upper) - before.cdf(range.lower);
    for (const double fraction : {0.1, 0.5, 0.9}) {
      const double x = after.quantile(fraction);
      CHECK_THAT((before.cdf(x) - before.cdf(range.lower)) / kept, WithinAbs(fraction, 1e-11));
    }
  }
  auto noise_bounds = rows::table2();
  noise_bounds[phase_noise] = {0.001, 2.0};
  noise_bounds[frequency_ratio_noise] = {0.02, 1.0};
  const auto noise_cut = published(noise_bounds);
  check_consistency(noise_cut);
  for (const auto p : {phase_noise, frequency_ratio_noise}) {
    const Interval range = noise_bounds[static_cast<std::size_t>(p)];
    const double kept = full.marginal(p).cdf(range.upper) - full.marginal(p).cdf(range.lower);
    const double x = noise_cut.marginal(p).quantile(0.3);
    CHECK_THAT((full.marginal(p).cdf(x) - full.marginal(p).cdf(range.lower)) / kept, WithinAbs(0.3, 1e-11));
  }
  // Far outside the bulk: sigma_phase is pressed against 0.05 deg.
  noise_bounds[phase_noise] = {0.001, 0.05};
  const auto pressed = published(noise_bounds);
  check_consistency(pressed, 1e-7);
  const double misfit =
      Likelihood(rows::table1(), rows::as_published()).phase_misfit(pressed.marginal(friction_force).mean());
  CHECK_THAT(0.05 - pressed.marginal(phase_noise).mean(), WithinRel(std::pow(0.05, 3) / misfit, 0.01));
}

TEST_CASE("the limit of continuous motion cuts the posterior", "[estimation]") {
  auto o = rows::table1();
  o.phase_deg.assign(10, 110.0);
  const Likelihood likelihood(o, rows::as_published());
  auto bounds = rows::table2();
  bounds[phase_noise].upper = 100.0;
  const ExactPosterior posterior(likelihood, bounds);
  check_consistency(posterior);
  const auto& force = posterior.marginal(friction_force);
  const double limit = likelihood.limit_friction_force_n();
  CHECK_THAT(force.upper(), WithinRel(limit, 1e-14));
  CHECK(force.cdf(limit) == 1.0);
  CHECK(force.density(1.001 * limit) == 0.0);
  CHECK(force.density(0.999 * limit) > force.density(0.9 * limit));

  bounds[friction_force] = {limit, 10.0};
  CHECK_THROWS_WITH(ExactPosterior(likelihood, bounds),
                    Contains("friction_force.lower") && Contains("limit of continuous motion"));
}

TEST_CASE("one row, and rows that fit exactly", "[estimation]") {
  const auto bounds = rows::table2();
  const auto one = rows::first(1, rows::table1());
  const Likelihood likelihood(one, rows::as_published());
  const ExactPosterior posterior(likelihood, bounds);
  check_consistency(posterior);
  // P(sigma < s) from the density 1/sigma times the integral over omega_n, by another quadrature.
  const auto weight = [&](double sigma) {
    double sum = 0.0;
    const double width = 5.0 * sigma;
    const std::vector<double> edges = {
        0.01,   3.0902 - std::min(2.9, 3 * width), 3.0902 - std::min(2.0, width),
        3.0902, 3.0902 + std::min(3.0, width),     3.0902 + std::min(6.0, 3 * width),
        10.0};
    for (std::size_t i = 1; i < edges.size(); ++i) {
      sum += Kronrod::integrate(
          [&](double omega) {
            return std::exp(-0.5 * likelihood.frequency_misfit(omega) / (sigma * sigma)) / sigma;
          },
          edges[i - 1], edges[i], 10, 1e-11);
    }
    return sum;
  };
  const double below = Kronrod::integrate(weight, 0.001, 0.1, 10, 1e-10);
  const double above = Kronrod::integrate(weight, 0.1, 1.0, 10, 1e-10);
  CHECK_THAT(posterior.marginal(frequency_ratio_noise).cdf(0.1),
             WithinAbs(below / (below + above), two_quadratures));
  CHECK_THAT(posterior.marginal(natural_frequency).log_integral(),
             WithinAbs(std::log(below + above), two_quadratures));

  const ExactPosterior exact(Likelihood(rows::synthetic(20, 0.0, 0.0), {}), bounds);
  check_consistency(exact, 1e-7);
  // With S = c z^2 the noise level has density sigma^(1-n): P(sigma > 2 a) = 2^(2-n).
  CHECK_THAT(exact.marginal(frequency_ratio_noise).exceedance(0.002), WithinRel(std::pow(2.0, -18), 1e-3));
}

TEST_CASE("several local modes of the friction force", "[estimation]") {
  // At r = 1.2 the phase has its minimum at 0.991 of the limit: one row fits exactly on either side
  // of it.
  const friction::Physics physics;
  const auto constants = friction::response_constants(1.2, physics);
  const double first_force = 0.998 * constants.limit_force_ratio * physics.driving_force_n;
  const friction::Observations o{{1.2}, {1.2}, {3.7}, {friction::phase_deg(constants, first_force / 2.5)}};
  auto bounds = rows::table2();
  bounds[phase_noise] = {1e-4, 0.01};
  const Likelihood likelihood(o, physics);
  const ExactPosterior posterior(likelihood, bounds);
  CHECK(posterior.mode_count(friction_force) == 2);
  check_consistency(posterior, 1e-7);
  const auto& force = posterior.marginal(friction_force);
  CHECK(force.density(first_force) > 100.0);
  const double gap = 0.991 * likelihood.limit_friction_force_n();
  CHECK(force.density(gap) < 1e-3 * force.density(first_force));
  CHECK(force.cdf(gap) > 0.1);
  CHECK(force.cdf(gap) < 0.9);
}

TEST_CASE("draws are the inverse of the exact distribution", "[estimation]") {
  const Likelihood likelihood(rows::table1(), rows::as_published());
  const auto posterior = published();
  rows::Random random(20230912);
  constexpr int draws = 20000;
  std::vector<std::vector<double>> samples(4);
  double worst_marginal = 0.0;
  double worst_conditional = 0.0;
  for (int i = 0; i < draws; ++i) {
    const std::array<double, 4> u = {random.uniform(), random.uniform(), random.uniform(), random.uniform()};
    const auto point = posterior.draw(u);
    for (std::size_t p = 0; p < 4; ++p) {
      samples[p].push_back(point[p]);
    }
    if (i < 2000) {
      const auto location_error = [&](Parameter p) {
        return std::fabs(posterior.marginal(p).cdf(point[static_cast<std::size_t>(p)]) -
                         u[static_cast<std::size_t>(p)]);
      };
      worst_marginal =
          std::max({worst_marginal, location_error(friction_force), location_error(natural_frequency)});
      const auto noise_error = [&](double misfit, Parameter p) {
        const Interval noise = rows::table2()[static_cast<std::size_t>(p)];
        const auto q = [&](double sigma) {
          return boost::math::gamma_q(4.5, misfit / (2.0 * sigma * sigma));
        };
        const double sigma = point[static_cast<std::size_t>(p)];
        const double cdf = (q(sigma) - q(noise.lower)) / (q(noise.upper) - q(noise.lower));
        return std::fabs(cdf - u[static_cast<std::size_t>(p)]);
      };
      worst_conditional =
          std::max({worst_conditional, noise_error(likelihood.phase_misfit(point[0]), phase_noise),
                    noise_error(likelihood.frequency_misfit(point[1]), frequency_ratio_noise)});
    }
  }
  CHECK(worst_marginal < 1e-12);
  CHECK(worst_conditional < 1e-11);

  const double kolmogorov_smirnov = 1.95 / std::sqrt(draws);  // exceeded with probability 0.1 %
  for (int p = 0; p < 4; ++p) {
    CAPTURE(p);
    auto& sample = samples[static_cast<std::size_t>(p)];
    std::sort(sample.begin(), sample.end());
    double distance = 0.0;
    for (std::size_t i = 0; i < sample.size(); ++i) {
      const double cdf = posterior.marginal(parameter(p)).cdf(sample[i]);
      distance = std::max(
          {distance, cdf - static_cast<double>(i) / draws, (static_cast<double>(i) + 1.0) / draws - cdf});
    }
    CHECK(distance < kolmogorov_smirnov);
  }
}

TEST_CASE("draws where a bound or many exact rows decide", "[estimation]") {
  auto pressed = rows::table2();
  pressed[phase_noise] = {0.001, 0.05};
  pressed[frequency_ratio_noise] = {0.5, 1.0};
  struct Case {
    friction::Observations observations;
    ParameterBounds bounds;
  };
  for (const Case& c : {Case{rows::table1(), pressed}, Case{rows::first(1, rows::table1()), rows::table2()},
                        Case{rows::synthetic(300, 0.0, 0.0), rows::table2()}}) {
    const ExactPosterior posterior(Likelihood(c.observations, {}), c.bounds);
    rows::Random random(3);
    constexpr int draws = 2000;
    std::array<double, 4> mean{};
    for (int i = 0; i < draws; ++i) {
      const auto point =
          posterior.draw({random.uniform(), random.uniform(), random.uniform(), random.uniform()});
      for (std::size_t p = 0; p < 4; ++p) {
        REQUIRE((point[p] >= c.bounds[p].lower && point[p] <= c.bounds[p].upper));
        mean[p] += point[p] / draws;
      }
    }
    for (int p = 0; p < 4; ++p) {
      CAPTURE(c.observations.size(), p);
      const auto& marginal = posterior.marginal(parameter(p));
      const double standard_error = marginal.standard_deviation() / std::sqrt(draws);
      CHECK_THAT(mean[static_cast<std::size_t>(p)], WithinAbs(marginal.mean(), 4.0 * standard_error));
    }
  }
}

TEST_CASE("a posterior that cannot be integrated is refused", "[estimation]") {
  auto bounds = rows::table2();
  bounds[phase_noise] = {1e-12, 1e-11};  // rounding in the misfit is many nats
  const Likelihood likelihood(rows::table1(), {});
  CHECK_THROWS_WITH(ExactPosterior(likelihood, bounds, {.max_panels = 200}),
                    Contains("friction_force") && Contains("max_panels = 200"));
  const Likelihood rounding(rows::synthetic(500, 1e-3, 1e-3), {});
  CHECK_THROWS_WITH(ExactPosterior(rounding, rows::table2(), {.relative_tolerance = 1e-14}),
                    Contains("friction_force") && Contains("exceeds relative_tolerance"));
  CHECK_THROWS_AS(ExactPosterior(likelihood, bounds, {.max_panels = 200}), estimation::IntegrationError);
}

TEST_CASE("invalid bounds and options are named", "[estimation]") {
  const Likelihood likelihood(rows::table1(), {});
  const auto refused = [&](Parameter p, const Interval& interval, const std::string& message) {
    auto bounds = rows::table2();
    bounds[static_cast<std::size_t>(p)] = interval;
    CHECK_THROWS_WITH(ExactPosterior(likelihood, bounds), Contains(message));
  };
  refused(friction_force, {-1.0, 2.0}, "friction_force.lower = -1");
  refused(natural_frequency, {0.0, 2.0}, "natural_frequency.lower = 0");
  refused(phase_noise, {0.0, 2.0}, "phase_noise.lower = 0");
  refused(frequency_ratio_noise, {2.0, 2.0}, "frequency_ratio_noise.upper = 2");
  refused(phase_noise, {1.0, std::nan("")}, "phase_noise.upper = nan");
  CHECK_THROWS_WITH(ExactPosterior(likelihood, rows::table2(), {.relative_tolerance = 0.0}),
                    Contains("relative_tolerance = 0"));
  CHECK_THROWS_WITH(ExactPosterior(likelihood, rows::table2(), {.scan_intervals = 3}),
                    Contains("scan_intervals = 3"));
  CHECK_THROWS_WITH(ExactPosterior(likelihood, rows::table2(), {.max_panels = 3}),
                    Contains("max_panels = 3"));
  CHECK_THROWS_AS(published().marginal(friction::parameter_count), errors::InvalidValue);
  CHECK_THROWS_AS(published().mode_count(phase_noise), errors::InvalidValue);
}

TEST_CASE("a phase written with a turn more or less gives the same posterior", "[estimation]") {
  const ExactPosterior& expected = published();
  auto turned = rows::table1();
  turned.phase_deg[2] -= 360.0;
  turned.phase_deg[7] -= 360.0;
  const ExactPosterior posterior(Likelihood(turned, rows::as_published()), rows::table2());
  CHECK_THAT(posterior.log_evidence(), WithinAbs(expected.log_evidence(), 1e-9));
  for (const auto parameter : {friction_force, phase_noise}) {
    CHECK_THAT(posterior.marginal(parameter).mean(), WithinRel(expected.marginal(parameter).mean(), 1e-9));
    CHECK_THAT(posterior.marginal(parameter).standard_deviation(),
               WithinRel(expected.marginal(parameter).standard_deviation(), 1e-8));
  }
}

TEST_CASE("noise as wide as the circle, where residuals cross the half turn", "[estimation]") {
  auto o = rows::table1();
  o.phase_deg[0] = -170.0;  // crosses the half turn as the modelled phase passes 10 deg
  o.phase_deg[1] = -160.0;
  auto bounds = rows::table2();
  bounds[phase_noise].upper = 300.0;
  check_consistency(ExactPosterior(Likelihood(o, rows::as_published()), bounds), 1e-6);
}

namespace {

estimation::ParameterPrior prior_of(const tmcmc::Marginal& marginal) {
  estimation::ParameterPrior prior{[marginal](double x) { return marginal.log_density(x); }, {}};
  for (const double p :
       {1e-20, 1e-12, 1e-8, 1e-5, 1e-3, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 0.98, 0.999, 0.99999}) {
    prior.breaks.push_back(marginal.quantile(p));
  }
  prior.breaks.push_back(marginal.from_normal(8.0));
  return prior;
}

/// Table 2 with other noise levels.
estimation::ParameterPriors with_noise(const tmcmc::Marginal& phase, const tmcmc::Marginal& ratio) {
  const auto bounds = rows::table2();
  estimation::ParameterPriors priors;
  for (std::size_t p = 0; p < priors.size(); ++p) {
    priors[p] = prior_of(tmcmc::Marginal::uniform(bounds[p].lower, bounds[p].upper));
    priors[p].breaks.back() = bounds[p].upper;
  }
  priors[phase_noise] = prior_of(phase);
  priors[frequency_ratio_noise] = prior_of(ratio);
  return priors;
}

}  // namespace

TEST_CASE("uniform priors as densities give what they give as bounds", "[estimation]") {
  const auto bounds = rows::table2();
  auto priors = with_noise(tmcmc::Marginal::uniform(bounds[2].lower, bounds[2].upper),
                           tmcmc::Marginal::uniform(bounds[3].lower, bounds[3].upper));
  priors[2].breaks.back() = bounds[2].upper;
  priors[3].breaks.back() = bounds[3].upper;
  const Likelihood likelihood(rows::table1(), rows::as_published());
  const ExactPosterior by_density(likelihood, priors);
  const ExactPosterior by_bounds(likelihood, bounds);
  CHECK_THAT(by_density.log_evidence(), WithinAbs(by_bounds.log_evidence(), two_quadratures));
  for (int p = 0; p < 4; ++p) {
    CHECK_THAT(by_density.marginal(parameter(p)).mean(),
               WithinRel(by_bounds.marginal(parameter(p)).mean(), two_quadratures));
  }
  const std::array<double, 4> uniforms = {0.3, 0.8, 0.05, 0.6};
  for (std::size_t p = 0; p < 4; ++p) {
    CHECK_THAT(by_density.draw(uniforms)[p], WithinRel(by_bounds.draw(uniforms)[p], 1e-7));
  }
}

TEST_CASE("other priors of the noise levels reweight the posterior under uniform ones", "[estimation]") {
  const Likelihood likelihood(rows::table1(), rows::as_published());
  const auto bounds = rows::table2();
  const ExactPosterior uniform(likelihood, bounds);
  const std::vector<std::array<tmcmc::Marginal, 2>> pairs = {
      {tmcmc::Marginal::log_uniform(bounds[2].lower, bounds[2].upper),
       tmcmc::Marginal::log_uniform(bounds[3].lower, bounds[3].upper)},
      // Next to nothing above the upper bounds of 10 deg and 1.
      {tmcmc::Marginal::half_normal(1.2), tmcmc::Marginal::half_normal(0.1)},
      {tmcmc::Marginal::log_normal_of_median(2.0, 0.2), tmcmc::Marginal::gamma(4.0, 300.0)}};
  for (const auto& noise : pairs) {
    CAPTURE(noise[0].text(), noise[1].text());
    const ExactPosterior other(likelihood, with_noise(noise[0], noise[1]));
    double log_evidence = uniform.log_evidence();
    for (std::size_t k = 0; k < 2; ++k) {
      // The evidence of each pair changes by the mean of the ratio of the densities of its noise
      // level.
      const auto noise_level = static_cast<Parameter>(phase_noise + static_cast<int>(k));
      const auto& marginal = uniform.marginal(noise_level);
      double mean_ratio = 0.0;
      double mean = 0.0;
      const double width = bounds[static_cast<std::size_t>(noise_level)].width();
      double low = marginal.lower();
      for (const double q : {1e-12, 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.999, 1.0}) {
        const double high = marginal.quantile(q);
        const auto ratio = [&](double x) {
          return width * std::exp(noise[k].log_density(x)) * marginal.density(x);
        };
        mean_ratio += Kronrod::integrate(ratio, low, high, 12, 1e-11);
        mean += Kronrod::integrate([&](double x) { return x * ratio(x); }, low, high, 12, 1e-11);
        low = high;
      }
      log_evidence += std::log(mean_ratio);
      CHECK_THAT(other.marginal(noise_level).mean(), WithinRel(mean / mean_ratio, 1e-6));
    }
    CHECK_THAT(other.log_evidence(), WithinAbs(log_evidence, 1e-6));
    check_consistency(other);
  }
}
