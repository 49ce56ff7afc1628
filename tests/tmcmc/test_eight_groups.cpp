// The hierarchical example (examples/eight_groups.hpp) against its closed form, and an unknown
// spread against quadrature.
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "../../examples/eight_groups.hpp"
#include "tmcmc/statistics.hpp"

using statistics::standard_errors;

TEST_CASE("the closed form of the eight groups is that of a multivariate normal", "[tmcmc][prior]") {
  // The measurements are N(0, C) with C = diag(s^2 + tau^2) + 400: by elimination.
  constexpr double tau = 8.0;
  std::array<std::array<double, 9>, 8> c{};
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) {
      c[i][j] = 400.0 + (i == j ? std::pow(eight_groups::errors[i], 2) + tau * tau : 0.0);
    }
    c[i][8] = eight_groups::measured[i];
  }
  double log_density = -4.0 * std::log(2.0 * 3.14159265358979323846);
  for (std::size_t k = 0; k < 8; ++k) {
    log_density -= 0.5 * (std::log(c[k][k]) + c[k][8] * c[k][8] / c[k][k]);
    for (std::size_t i = k + 1; i < 8; ++i) {
      const double factor = c[i][k] / c[k][k];
      for (std::size_t j = k; j < 9; ++j) {
        c[i][j] -= factor * c[k][j];
      }
    }
  }
  CHECK_THAT(eight_groups::exact(tau).log_evidence, Catch::Matchers::WithinRel(log_density, 1e-12));
}

TEST_CASE("eight groups with a known spread come out as in closed form", "[tmcmc][prior]") {
  constexpr double tau = 8.0;
  const tmcmc::Problem problem{eight_groups::log_likelihood, eight_groups::prior(tau)};
  const auto exact = eight_groups::exact(tau);
  std::vector<std::vector<double>> means(9);
  std::vector<std::vector<double>> variances(9);
  double evidence_z = 0.0;
  constexpr std::uint32_t runs = 12;
  for (std::uint32_t run = 0; run < runs; ++run) {
    const auto result = tmcmc::run(problem, tmcmc::recommended_moves(30000, 100), {.seed = 2, .run = run});
    REQUIRE(result.stop == tmcmc::StopReason::completed);
    for (std::size_t j = 0; j < 9; ++j) {
      const auto x = result.final.points.col(static_cast<Eigen::Index>(j)).array();
      const double truth = j == 0 ? exact.mu_mean : exact.theta_mean[j - 1];
      means[j].push_back(x.mean());
      variances[j].push_back((x - truth).square().mean());
    }
    const double z = (result.evidence.log_evidence - exact.log_evidence) / result.evidence.standard_error;
    evidence_z += z * z / runs;
  }
  for (std::size_t j = 0; j < 9; ++j) {
    CAPTURE(j);
    const double mean = j == 0 ? exact.mu_mean : exact.theta_mean[j - 1];
    const double sd = j == 0 ? exact.mu_sd : exact.theta_sd[j - 1];
    CHECK(statistics::estimate(means[j]).errors_from(mean) < standard_errors);
    CHECK(statistics::estimate(variances[j]).errors_from(sd * sd) < standard_errors);
    CHECK(statistics::estimate(means[j]).standard_error < 0.05 * sd);
  }
  CHECK(std::sqrt(evidence_z) <
        1.8);  // of 12 standard normal numbers: exceeded by chance with probability 1e-4
}

TEST_CASE("eight groups with an unknown spread agree with quadrature over the spread", "[tmcmc][prior]") {
  const tmcmc::Problem problem{eight_groups::log_likelihood, eight_groups::prior({})};
  const auto half_normal = tmcmc::Marginal::half_normal(eight_groups::spread_sd);
  const auto integral = [&](const auto& f) {
    return boost::math::quadrature::gauss_kronrod<double, 61>::integrate(
        [&](double tau) {
          const auto exact = eight_groups::exact(tau);
          return f(tau, exact) * std::exp(half_normal.log_density(tau) + exact.log_evidence + 30.0);
        },
        0.0, 120.0, 10, 1e-10);
  };
  const double evidence = integral([](double, const auto&) { return 1.0; });
  const double mean_tau = integral([](double tau, const auto&) { return tau; }) / evidence;
  const double mean_mu = integral([](double, const auto& exact) { return exact.mu_mean; }) / evidence;
  std::vector<double> taus;
  std::vector<double> mus;
  double evidence_z = 0.0;
  constexpr std::uint32_t runs = 12;
  for (std::uint32_t run = 0; run < runs; ++run) {
    const auto result = tmcmc::run(problem, tmcmc::recommended_moves(30000, 100), {.seed = 3, .run = run});
    REQUIRE(result.stop == tmcmc::StopReason::completed);
    taus.push_back(result.final.points.col(1).array().exp().mean());
    mus.push_back(result.final.points.col(0).mean());
    const double z =
        (result.evidence.log_evidence - std::log(evidence) + 30.0) / result.evidence.standard_error;
    evidence_z += z * z / runs;
  }
  CHECK(statistics::estimate(taus).errors_from(mean_tau) < standard_errors);
  CHECK(statistics::estimate(mus).errors_from(mean_mu) < standard_errors);
  CHECK(std::sqrt(evidence_z) < 1.8);
}
