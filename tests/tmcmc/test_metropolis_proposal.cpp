// Proposals in unbounded coordinates, in random subsets of them, and independent ones: what they
// leave invariant.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tmcmc/chains.hpp"
#include "tmcmc/detail/proposal_covariance.hpp"
#include "tmcmc/statistics.hpp"
#include "tmcmc/unbounded_coordinates.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using chains::Chains;
using chains::column;
using chains::exponential_cdf;
using chains::exponential_draw;
using problems::by_rows;
using statistics::kolmogorov;
using statistics::kolmogorov_bound;
using tmcmc::BoxPrior;
using tmcmc::Coordinates;
using tmcmc::Index;
using tmcmc::Population;
using tmcmc::detail::MetropolisKernel;
using tmcmc::detail::MoveCounts;

constexpr Index n = 20000;

/// Asymmetric, correlated, and with most of its mass at a corner of its box [0, 1] x [1, 3]: x of
/// density exp(-3 x), y - 1 given x of density exp(-rate (y - 1)).
double rate_of_y(double x) {
  return 1.0 + 8.0 * x;
}

double log_density(double x, double y) {
  const double rate = rate_of_y(x);
  return -3.0 * x - rate * (y - 1.0) + std::log(rate / -std::expm1(-2.0 * rate));
}

Population exact_draws() {
  Population points(n, 2);
  statistics::Uniforms uniform(21);
  for (Index i = 0; i < n; ++i) {
    points(i, 0) = exponential_draw(uniform(), 3.0);
    points(i, 1) = 1.0 + 2.0 * exponential_draw(uniform(), 2.0 * rate_of_y(points(i, 0)));
  }
  return points;
}

/// Both columns become independent and uniform on [0, 1] if the points have the density above.
Population rosenblatt(const Population& points) {
  Population uniforms(points.rows(), 2);
  for (Index i = 0; i < points.rows(); ++i) {
    uniforms(i, 0) = exponential_cdf(points(i, 0), 3.0);
    uniforms(i, 1) = exponential_cdf((points(i, 1) - 1.0) / 2.0, 2.0 * rate_of_y(points(i, 0)));
  }
  return uniforms;
}

BoxPrior corner_box() {
  return {Eigen::Vector2d(0.0, 1.0), Eigen::Vector2d(1.0, 3.0)};
}

/// The kernel that a stage would take for these points, its factor holding `scale`.
MetropolisKernel kernel_for(const Population& points, const BoxPrior& prior, Coordinates coordinates,
                            double scale) {
  MetropolisKernel kernel;
  const Population u = coordinates == Coordinates::natural ? points : tmcmc::to_unbounded(points, prior);
  const std::vector<double> weights(static_cast<std::size_t>(u.rows()), 1.0);
  const double sum = static_cast<double>(u.rows());
  kernel.factor = tmcmc::detail::cholesky_factor(
      tmcmc::detail::proposal_covariance(u, weights, sum, scale, tmcmc::Centre::weighted_mean));
  kernel.factor_unit = 1.0 / scale;
  kernel.centre = tmcmc::detail::weighted_mean(u, weights, sum);
  kernel.coordinates = coordinates;
  kernel.stage = 1;
  return kernel;
}

double distance(const Population& points) {
  const Population uniforms = rosenblatt(points);
  const auto flat = [](double u) { return u; };
  std::vector<double> sums;  // of the two modulo 1: uniform too if they are independent
  for (Index i = 0; i < points.rows(); ++i) {
    const double sum = uniforms(i, 0) + uniforms(i, 1);
    sums.push_back(sum < 1.0 ? sum : sum - 1.0);
  }
  return std::max(
      {kolmogorov(column(uniforms, 0), flat), kolmogorov(column(uniforms, 1), flat), kolmogorov(sums, flat)});
}

}  // namespace

TEST_CASE("every kind of proposal leaves an asymmetric, correlated target at a bound as it is",
          "[tmcmc][proposals]") {
  const Population exact = exact_draws();
  REQUIRE(distance(exact) < kolmogorov_bound);
  for (const Coordinates coordinates : {Coordinates::natural, Coordinates::unbounded}) {
    for (const bool subsets : {false, true}) {
      for (const double independent : {0.0, 0.5, 1.0}) {
        for (const double scale : {1.0, 0.6}) {  // and a factor in other units
          const double beta = scale;
          CAPTURE(static_cast<int>(coordinates), subsets, independent, scale);
          MetropolisKernel kernel = kernel_for(exact, corner_box(), coordinates, scale);
          kernel.random_subsets = subsets;
          kernel.independent_fraction = independent;
          kernel.divide_by_sqrt_size = scale == 1.0;
          kernel.beta = beta;
          Chains chains{by_rows([=](const auto& x) { return log_density(x[0], x[1]) / beta; }), corner_box(),
                        kernel, exact};
          const MoveCounts counts = chains.move(6);
          CHECK(distance(chains.points) < kolmogorov_bound);
          CHECK(counts.accepted > 6 * n / 5);
          CHECK((coordinates == Coordinates::natural || counts.evaluations == counts.proposals));
          CHECK_THAT(static_cast<double>(counts.walks),
                     WithinAbs((1.0 - independent) * 6.0 * n,
                               statistics::standard_errors *
                                   std::sqrt(6.0 * n * independent * (1.0 - independent))));
          CHECK(counts.accepted_walks <= counts.walks);
          CHECK((independent > 0.0 || counts.accepted_walks == counts.accepted));
        }
      }
    }
  }
}

TEST_CASE("and brings any start to it", "[tmcmc][proposals]") {
  for (const Coordinates coordinates : {Coordinates::natural, Coordinates::unbounded}) {
    CAPTURE(static_cast<int>(coordinates));
    MetropolisKernel kernel = kernel_for(exact_draws(), corner_box(), coordinates, 1.0);
    kernel.random_subsets = true;
    kernel.independent_fraction = 0.5;
    Population start(n, 2);
    start.col(0).setConstant(0.9);
    start.col(1).setConstant(2.8);
    Chains chains{by_rows([](const auto& x) { return log_density(x[0], x[1]); }), corner_box(), kernel,
                  start};
    chains.move(60);
    CHECK(distance(chains.points) < kolmogorov_bound);
  }
}

TEST_CASE("an independent proposal is always accepted where the target is the fitted normal distribution",
          "[tmcmc][proposals]") {
  // Any error in the ratio of the proposal densities, in the units of the factor or in the Jacobian
  // rejects some.
  Eigen::MatrixXd sigma_factor(3, 3);
  sigma_factor << 0.8, 0.0, 0.0, -0.5, 0.6, 0.0, 0.3, 0.4, 0.2;
  const Eigen::Vector3d centre(0.3, -0.2, 0.1);
  const auto log_normal = [=](const Eigen::Vector3d& u) {
    return -0.5 * sigma_factor.triangularView<Eigen::Lower>().solve(u - centre).squaredNorm();
  };
  for (const Coordinates coordinates : {Coordinates::natural, Coordinates::unbounded}) {
    const bool natural = coordinates == Coordinates::natural;
    const BoxPrior prior(Eigen::Vector3d::Constant(natural ? -50.0 : 2.0),
                         Eigen::Vector3d::Constant(natural ? 50.0 : 7.0));
    const auto target = [=](const auto& x) {
      Eigen::Vector3d u = x.transpose();
      double log_jacobian = 0.0;
      for (Index j = 0; j < 3 && !natural; ++j) {
        u[j] = std::log((x[j] - 2.0) / (7.0 - x[j]));
        log_jacobian += std::log((x[j] - 2.0) * (7.0 - x[j]));
      }
      return log_normal(u) - log_jacobian;
    };
    for (const bool subsets : {false, true}) {
      for (const double unit : {1.0, 5.0}) {
        CAPTURE(static_cast<int>(coordinates), subsets, unit);
        MetropolisKernel kernel;
        kernel.factor = sigma_factor / unit;
        kernel.factor_unit = unit;
        kernel.centre = centre;
        kernel.independent_fraction = 1.0;
        kernel.random_subsets = subsets;
        kernel.coordinates = coordinates;
        Chains chains{by_rows(target), prior, kernel, Population::Constant(500, 3, natural ? 0.5 : 5.0)};
        CHECK(chains.move(20).accepted == 20 * 500);
      }
    }
  }
}

TEST_CASE("a random walk in unbounded coordinates is always accepted where the target is flat in them",
          "[tmcmc][proposals]") {
  const BoxPrior prior(Eigen::Vector2d(-3.0, 10.0), Eigen::Vector2d(-1.0, 11.0));
  const auto target = by_rows([](const auto& x) {
    return -std::log((x[0] + 3.0) * (-1.0 - x[0])) - std::log((x[1] - 10.0) * (11.0 - x[1]));
  });
  MetropolisKernel kernel;
  kernel.factor = 0.5 * Eigen::MatrixXd::Identity(2, 2);
  kernel.coordinates = Coordinates::unbounded;
  Population start(1000, 2);
  start.col(0).setConstant(-2.9);
  start.col(1).setConstant(10.5);
  Chains chains{target, prior, kernel, start};
  CHECK(chains.move(10).accepted == 10 * 1000);
  const Population u = tmcmc::to_unbounded(chains.points, prior);  // the sum of ten steps
  CHECK(kolmogorov(column(u, 0), [](double x) {
          return statistics::normal_cdf((x - std::log(0.1 / 1.9)) / std::sqrt(10.0 * 0.25));
        }) < kolmogorov_bound);
}

TEST_CASE("what rounds to a bound in unbounded coordinates is rejected without an evaluation",
          "[tmcmc][proposals]") {
  MetropolisKernel kernel;
  kernel.factor = Eigen::MatrixXd::Constant(1, 1, 1e4);
  kernel.coordinates = Coordinates::unbounded;
  Chains chains{by_rows([](const auto&) { return 0.0; }),
                BoxPrior(Eigen::VectorXd::Ones(1), 2.0 * Eigen::VectorXd::Ones(1)), kernel,
                Population::Constant(1000, 1, 1.5)};
  const MoveCounts counts = chains.move(5);
  CHECK(counts.evaluations < counts.proposals / 10);
  CHECK((chains.points.array() > 1.0 && chains.points.array() < 2.0).all());
}

TEST_CASE("random subsets hold one coordinate at least, each as often, in the sizes that are documented",
          "[tmcmc][proposals]") {
  constexpr Index d = 9;  // more than the eight uniforms of a block
  const BoxPrior wide(Eigen::VectorXd::Constant(d, -100.0), Eigen::VectorXd::Constant(d, 100.0));
  MetropolisKernel kernel;
  kernel.factor = Eigen::MatrixXd::Identity(d, d);
  kernel.random_subsets = true;
  kernel.divide_by_sqrt_size = true;
  Chains chains{by_rows([](const auto&) { return 0.0; }), wide, kernel, Population::Zero(n, d)};
  CHECK(chains.move(1).accepted == n);
  std::vector<double> sizes;
  std::vector<double> steps;
  std::vector<double> all;
  for (Index i = 0; i < n; ++i) {
    const auto size = static_cast<double>((chains.points.row(i).array() != 0.0).count());
    sizes.push_back(size);
    all.push_back(size == 9.0 ? 1.0 : 0.0);
    for (Index j = 0; j < d; ++j) {
      if (chains.points(i, j) != 0.0) {
        steps.push_back(chains.points(i, j) * std::sqrt(size));
      }
    }
  }
  // Levels 1, 1/2, 1/4, 1/8 with probability 1/4 each.
  CHECK(*std::min_element(sizes.begin(), sizes.end()) == 1.0);
  CHECK(statistics::estimate(sizes).errors_from(1.0 + 8.0 * 1.875 / 4.0) < statistics::standard_errors);
  CHECK(statistics::estimate(all).errors_from(0.25 * (1.0 + std::pow(2.0, -8.0) + std::pow(4.0, -8.0))) <
        statistics::standard_errors);
  const double share = (1.0 + 8.0 * 1.875 / 4.0) / 9.0;
  for (Index j = 0; j < d; ++j) {
    CAPTURE(j);
    const auto moved = static_cast<double>((chains.points.col(j).array() != 0.0).count());
    CHECK_THAT(moved,
               WithinAbs(n * share, statistics::standard_errors * std::sqrt(n * share * (1.0 - share))));
  }
  CHECK(kolmogorov(steps, statistics::normal_cdf) < kolmogorov_bound);
}

TEST_CASE("a direction without variance stays as it is, under independent proposals too",
          "[tmcmc][proposals]") {
  Population exact = exact_draws();
  Population points(n, 3);
  points.col(0) = exact.col(0);
  points.col(1).setConstant(0.25);
  points.col(2) = exact.col(1);
  const BoxPrior prior(Eigen::Vector3d(0.0, 0.0, 1.0), Eigen::Vector3d(1.0, 1.0, 3.0));
  MetropolisKernel kernel = kernel_for(points, prior, Coordinates::natural, 0.5);
  kernel.independent_fraction = 0.5;
  kernel.random_subsets = true;
  Chains chains{by_rows([](const auto& x) { return log_density(x[0], x[2]); }), prior, kernel, points};
  CHECK(chains.move(5).accepted > n);
  CHECK((chains.points.col(1).array() == 0.25).all());
  exact.col(0) = chains.points.col(0);
  exact.col(1) = chains.points.col(2);
  CHECK(distance(exact) < kolmogorov_bound);
}

TEST_CASE("a random walk in all natural coordinates is theta + factor z, bit for bit", "[tmcmc][proposals]") {
  constexpr Index d = 6;
  constexpr Index rows = 70;
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(d, d);
  for (Index j = 0; j < d; ++j) {
    for (Index k = 0; k <= j; ++k) {
      factor(j, k) = 0.1 + 0.03 * static_cast<double>(j) - 0.07 * static_cast<double>(k);
    }
  }
  const BoxPrior wide(Eigen::VectorXd::Constant(d, -100.0), Eigen::VectorXd::Constant(d, 100.0));
  MetropolisKernel kernel;
  kernel.factor = factor;
  kernel.stage = 3;
  CHECK(kernel.plain());
  Chains chains{by_rows([](const auto&) { return 0.0; }), wide, kernel, Population::Constant(rows, d, 0.7)};
  chains.seed = 77;
  chains.move(1, {}, 5);
  for (Index i = 0; i < rows; ++i) {
    std::vector<double> z;
    for (std::uint32_t block = 0; block < 2; ++block) {
      const auto words = tmcmc::random_words({.seed = 77}, {.purpose = tmcmc::Purpose::move,
                                                            .stage = 3,
                                                            .row = static_cast<std::uint64_t>(i),
                                                            .draw = 5,
                                                            .block = block});
      const auto a = tmcmc::normal_pair(words[1], words[3] >> 32U);
      const auto b = tmcmc::normal_pair(words[2], words[3]);
      z.insert(z.end(), {a.first, a.second, b.first, b.second});
    }
    for (Index j = 0; j < d; ++j) {
      double expected = 0.7;
      for (Index k = 0; k <= j; ++k) {
        expected += factor(j, k) * z[static_cast<std::size_t>(k)];
      }
      CHECK(chains.points(i, j) == expected);
    }
  }
}

TEST_CASE("unbounded coordinates are the logit of the box", "[tmcmc][proposals]") {
  Population points(2, 2);
  points << 0.25, -4.0, 0.9, -4.9999;
  const Population u =
      tmcmc::to_unbounded(points, BoxPrior(Eigen::Vector2d(0.0, -5.0), Eigen::Vector2d(1.0, -3.0)));
  CHECK_THAT(u(0, 0), WithinRel(std::log(0.25 / 0.75), 1e-14));
  CHECK_THAT(u(0, 1), WithinAbs(0.0, 1e-14));
  CHECK_THAT(u(1, 0), WithinRel(std::log(9.0), 1e-14));
  CHECK_THAT(u(1, 1), WithinRel(std::log(1e-4 / 1.9999), 1e-10));
}
