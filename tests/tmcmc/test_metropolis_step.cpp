// Metropolis steps: what they leave invariant, what the uncorrected redraw does instead, and
// errors.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "tmcmc/chains.hpp"
#include "tmcmc/statistics.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using chains::Chains;
using chains::column;
using chains::exponential_cdf;
using chains::exponential_draw;
using chains::unit_box;
using problems::by_rows;
using statistics::kolmogorov;
using statistics::kolmogorov_bound;
using statistics::standard_errors;
using tmcmc::BoxPrior;
using tmcmc::Index;
using tmcmc::LogLikelihood;
using tmcmc::Population;
using tmcmc::SamplingError;
using tmcmc::detail::Boundary;
using tmcmc::detail::MetropolisKernel;
using tmcmc::detail::MoveCounts;
using tmcmc::detail::Mover;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

MetropolisKernel kernel_of(const Eigen::MatrixXd& factor, double beta = 1.0,
                           Boundary boundary = Boundary::reject) {
  MetropolisKernel kernel;
  kernel.factor = factor;
  kernel.beta = beta;
  kernel.boundary = boundary;
  kernel.stage = 1;
  return kernel;
}

MetropolisKernel kernel_of(double scale, double beta = 1.0, Boundary boundary = Boundary::reject) {
  return kernel_of(Eigen::MatrixXd::Constant(1, 1, scale), beta, boundary);
}

/// Integral from 0 to x of Phi((1 - t)/s) - Phi(-t/s): the probability that a Normal proposal from
/// t with standard deviation s falls into [0, 1].
double stay_integral(double x, double s) {
  const auto g = [](double z) { return z * statistics::normal_cdf(z) + statistics::normal_density(z); };
  return s * (g(1.0 / s) - g((1.0 - x) / s) - g(0.0) + g(-x / s));
}

}  // namespace

TEST_CASE("steps with rejection leave an asymmetric tempered target in a box as it is", "[tmcmc][moves]") {
  // exp(-6 x + 4 y) at beta = 1/2 on the unit square: most of the mass lies in a corner.
  constexpr Index n = 20000;
  Population exact(n, 2);
  statistics::Uniforms uniform(11);
  for (Index i = 0; i < n; ++i) {
    exact(i, 0) = exponential_draw(uniform(), 3.0);
    exact(i, 1) = exponential_draw(uniform(), -2.0);
  }
  Eigen::MatrixXd factor(2, 2);
  factor << 0.5, 0.0, -0.4, 0.3;
  Chains chains{by_rows([](const auto& x) { return -6.0 * x[0] + 4.0 * x[1]; }), unit_box(2),
                kernel_of(factor, 0.5), exact};
  const MoveCounts counts = chains.move(8);
  CHECK(counts.accepted > 8 * n / 5);  // the chains do move
  CHECK(counts.accepted < counts.evaluations);
  CHECK(counts.evaluations < counts.proposals);
  CHECK(kolmogorov(column(chains.points, 0), [](double x) { return exponential_cdf(x, 3.0); }) <
        kolmogorov_bound);
  CHECK(kolmogorov(column(chains.points, 1), [](double y) { return exponential_cdf(y, -2.0); }) <
        kolmogorov_bound);
  CHECK(std::fabs(statistics::scaled_correlation(column(chains.points, 0), column(chains.points, 1))) <
        standard_errors);
  Eigen::VectorXd again(n);
  chains.log_likelihood(chains.points, again);
  CHECK((again == chains.values));
}

TEST_CASE("steps with rejection bring any start to the target", "[tmcmc][moves]") {
  constexpr Index n = 10000;
  Chains chains{by_rows([](const auto& x) { return -3.0 * x[0]; }), unit_box(1), kernel_of(0.6),
                Population::Constant(n, 1, 0.9)};
  chains.move(40);
  CHECK(kolmogorov(column(chains.points, 0), [](double x) { return exponential_cdf(x, 3.0); }) <
        kolmogorov_bound);
}

TEST_CASE("rejection keeps a uniform target; the uncorrected redraw samples pi(x) P(stay in the box | x)",
          "[tmcmc][moves]") {
  constexpr Index n = 40000;
  constexpr double s = 0.25;
  Population uniform_points(n, 1);
  statistics::Uniforms uniform(12);
  for (Index i = 0; i < n; ++i) {
    uniform_points(i, 0) = uniform();
  }
  Chains chains{by_rows([](const auto&) { return 0.0; }), unit_box(1), kernel_of(s), uniform_points};
  const double stay = stay_integral(1.0, s);
  const auto flat = [](double x) { return x; };
  const auto biased = [=](double x) { return stay_integral(x, s) / stay; };

  SECTION("reject") {
    const MoveCounts first = chains.move(1);
    // A proposal of a uniform chain stays in the box with probability `stay`, and then it is
    // accepted.
    CHECK_THAT(static_cast<double>(first.accepted),
               WithinAbs(n * stay, standard_errors * std::sqrt(n * stay * (1.0 - stay))));
    CHECK(first.evaluations == first.accepted);
    CHECK(first.redraws == 0);
    chains.move(40, {}, 1);
    CHECK(kolmogorov(column(chains.points, 0), flat) < kolmogorov_bound);
    CHECK(kolmogorov(column(chains.points, 0), biased) > 2.0 * kolmogorov_bound);
  }
  SECTION("redraw") {
    chains.kernel.boundary = Boundary::redraw;
    const MoveCounts counts = chains.move(40);
    CHECK(counts.accepted == 40 * n);
    CHECK(counts.evaluations == 40 * n);
    CHECK(counts.redraws > 0);
    CHECK(kolmogorov(column(chains.points, 0), biased) < kolmogorov_bound);
    CHECK(kolmogorov(column(chains.points, 0), flat) > 2.0 * kolmogorov_bound);
  }
}

TEST_CASE("a redraw is a draw from the proposal given that it is inside, as often as it takes",
          "[tmcmc][moves]") {
  constexpr Index n = 20000;
  constexpr double s = 2.0;
  Chains chains{by_rows([](const auto&) { return 0.0; }), unit_box(1), kernel_of(s, 1.0, Boundary::redraw),
                Population::Constant(n, 1, 0.25)};
  const MoveCounts counts = chains.move(1);
  const double below = statistics::normal_cdf(-0.25 / s);
  const double inside = statistics::normal_cdf(0.75 / s) - below;
  CHECK(kolmogorov(column(chains.points, 0), [=](double x) {
          return (statistics::normal_cdf((x - 0.25) / s) - below) / inside;
        }) < kolmogorov_bound);
  // Geometric numbers of redraws: mean (1 - p)/p, variance (1 - p)/p^2.
  CHECK_THAT(
      static_cast<double>(counts.redraws),
      WithinAbs(n * (1.0 - inside) / inside, standard_errors * std::sqrt(n * (1.0 - inside)) / inside));
}

TEST_CASE("proposals have the covariance L L^T", "[tmcmc][moves]") {
  constexpr Index n = 40000;
  Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(6, 6);  // more than the four normals of a block
  for (Index j = 0; j < 6; ++j) {
    for (Index k = 0; k <= j; ++k) {
      factor(j, k) = k == j ? 1.0 + 0.3 * static_cast<double>(j) : 0.2 * static_cast<double>(j - 2 * k);
    }
  }
  const BoxPrior wide(Eigen::VectorXd::Constant(6, -100.0), Eigen::VectorXd::Constant(6, 100.0));
  Chains chains{by_rows([](const auto&) { return 0.0; }), wide, kernel_of(factor), Population::Zero(n, 6)};
  CHECK(chains.move(1).accepted == n);
  const Eigen::MatrixXd expected = factor * factor.transpose();
  const Eigen::MatrixXd z =
      factor.triangularView<Eigen::Lower>().solve(chains.points.transpose()).transpose();
  for (Index j = 0; j < 6; ++j) {
    CAPTURE(j);
    CHECK(kolmogorov(column(z, j), statistics::normal_cdf) < kolmogorov_bound);
    for (Index k = 0; k <= j; ++k) {
      CAPTURE(k);
      const double covariance = chains.points.col(j).dot(chains.points.col(k)) / n;
      // of the products of two normals
      const double error = std::sqrt((expected(j, j) * expected(k, k) + expected(j, k) * expected(j, k)) / n);
      CHECK_THAT(covariance, WithinAbs(expected(j, k), standard_errors * error));
    }
  }
}

TEST_CASE("a direction of zero variance does not move", "[tmcmc][moves]") {
  Eigen::MatrixXd factor(2, 2);
  factor << 0.1, 0.0, 0.0, 0.0;
  Chains chains{by_rows([](const auto&) { return 0.0; }), unit_box(2), kernel_of(factor),
                Population::Constant(100, 2, 0.5)};
  CHECK(chains.move(3).accepted > 0);
  CHECK((chains.points.col(1) == Eigen::VectorXd::Constant(100, 0.5)));
}

TEST_CASE("points with a log-likelihood of minus infinity are left and never entered", "[tmcmc][moves]") {
  constexpr Index n = 5000;
  const auto half = by_rows([](const auto& x) { return x[0] < 0.5 ? -infinity : 0.0; });
  for (const Boundary boundary : {Boundary::reject, Boundary::redraw}) {
    Chains inside{half, unit_box(1), kernel_of(0.3, 0.7, boundary), Population::Constant(n, 1, 0.6)};
    CHECK(inside.move(10).accepted > 0);
    CHECK(inside.points.minCoeff() >= 0.5);
    Chains outside{half, unit_box(1), kernel_of(0.3, 0.7, boundary), Population::Constant(n, 1, 0.4)};
    outside.move(30);
    CHECK((outside.points.array() >= 0.5).count() > n * 9 / 10);
    // Not even between excluded points: the ratio of their likelihoods has no value.
    CHECK(((outside.points.array() >= 0.5) || (outside.points.array() == 0.4)).all());
  }
}

TEST_CASE("at beta = 0 every finite proposal is accepted", "[tmcmc][moves]") {
  const BoxPrior wide(Eigen::VectorXd::Constant(1, -1e3), Eigen::VectorXd::Constant(1, 1e3));
  Chains chains{by_rows([](const auto& x) { return -1e6 * x[0] * x[0]; }), wide, kernel_of(1.0, 0.0),
                Population::Zero(500, 1)};
  CHECK(chains.move(1).accepted == 500);
}

TEST_CASE("a log-likelihood of NaN or plus infinity ends the step with an error that names the point",
          "[tmcmc][moves]") {
  for (const double bad : {not_a_number, infinity}) {
    const auto fails = by_rows([=](const auto& x) { return x[0] == 0.25 && x[1] == 0.5 ? 0.0 : bad; });
    Population start(300, 2);
    start.col(0).setConstant(0.25);
    start.col(1).setConstant(0.5);
    for (const int threads : {1, 2}) {
      Chains chains{fails, unit_box(2), kernel_of(Eigen::MatrixXd(0.01 * Eigen::MatrixXd::Identity(2, 2))),
                    start};
      chains.threads = threads;
      CHECK_THROWS_AS(chains.move(1), SamplingError);
    }
    Chains chains{fails, unit_box(2), kernel_of(Eigen::MatrixXd(0.01 * Eigen::MatrixXd::Identity(2, 2))),
                  start};
    CHECK_THROWS_WITH(chains.move(1), Contains(std::isnan(bad) ? "nan at (0.2" : "inf at (0.2"));
  }
  Population points(3, 2);
  points << 1.0, 2.0, 0.1, -4.0, 5.0, 6.0;
  Eigen::VectorXd values(3);
  values << -infinity, not_a_number, infinity;
  CHECK_THROWS_WITH(tmcmc::detail::require_valid(points, values),
                    Contains("nan at (0.10000000000000001, -4)") && Contains("minus infinity"));
  values << -infinity, -1e300, 1e300;
  CHECK_NOTHROW(tmcmc::detail::require_valid(points, values));
}

TEST_CASE("too many redraws end the step with an error", "[tmcmc][moves]") {
  Chains chains{by_rows([](const auto&) { return 0.0; }), unit_box(1), kernel_of(1e6, 1.0, Boundary::redraw),
                Population::Constant(10, 1, 0.5)};
  chains.kernel.max_redraws = 20;
  CHECK_THROWS_AS(chains.move(1), SamplingError);
  CHECK_THROWS_WITH(chains.move(1), Contains("20 times") && Contains("max_redraws"));
}

TEST_CASE("max_redraws is the number of redraws that a proposal may need", "[tmcmc][moves]") {
  Chains chains{by_rows([](const auto&) { return 0.0; }), unit_box(1), kernel_of(50.0, 1.0, Boundary::redraw),
                Population::Constant(1, 1, 0.5)};
  const Index needed = chains.move(1).redraws;
  REQUIRE(needed > 3);
  chains.points.setConstant(0.5);
  chains.kernel.max_redraws = needed;
  CHECK(chains.move(1).redraws == needed);
  chains.points.setConstant(0.5);
  chains.kernel.max_redraws = needed - 1;
  CHECK_THROWS_AS(chains.move(1), SamplingError);
}

TEST_CASE("threads and batches change no bit, and no batch is larger than asked for", "[tmcmc][moves]") {
  constexpr Index n = 203;
  constexpr Index d = 5;
  Population start(n, d);
  statistics::Uniforms uniform(13);
  for (double& x : start.reshaped()) {
    x = uniform();
  }
  std::mutex mutex;
  Index largest_batch = 0;
  const LogLikelihood counting = [&](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                     Eigen::Ref<Eigen::VectorXd> log_likelihood) {
    for (Index i = 0; i < points.rows(); ++i) {
      double sum = 0.0;
      for (Index j = 0; j < d; ++j) {
        sum -= points(i, j) * points(i, j);
      }
      log_likelihood[i] = sum;
    }
    const std::scoped_lock lock(mutex);
    largest_batch = std::max(largest_batch, points.rows());
  };
  for (const Boundary boundary : {Boundary::reject, Boundary::redraw}) {
    const MetropolisKernel kernel =
        kernel_of(Eigen::MatrixXd(0.4 * Eigen::MatrixXd::Identity(d, d)), 0.8, boundary);
    Chains reference{counting, unit_box(d), kernel, start};
    const MoveCounts counts = reference.move(4);
    for (const int threads : {1, 2, 3, 300}) {
      for (const Index batch_rows : {0, 1, 7, 64, 65, 1000}) {
        CAPTURE(threads, batch_rows);
        Chains chains{counting, unit_box(d), kernel, start};
        chains.threads = threads;
        chains.batch_rows = batch_rows;
        chains.values.resize(n);
        counting(start, chains.values);
        Mover mover(counting, chains.prior, {.seed = 1}, threads, batch_rows);
        largest_batch = 0;
        MoveCounts same;
        for (std::uint32_t k = 0; k < 4; ++k) {
          same += mover.step(kernel, {}, k, chains.points, chains.values);
        }
        CHECK((chains.points == reference.points));
        CHECK((chains.values == reference.values));
        CHECK(same.proposals == counts.proposals);
        CHECK(same.accepted == counts.accepted);
        CHECK(same.evaluations == counts.evaluations);
        CHECK(same.redraws == counts.redraws);
        CHECK(largest_batch <= (batch_rows > 0 ? batch_rows : (n + threads - 1) / threads));
      }
    }
  }
}

TEST_CASE("a step on some rows moves those as a step on all would, and no other", "[tmcmc][moves]") {
  constexpr Index n = 150;
  Population start(n, 2);
  statistics::Uniforms uniform(14);
  for (double& x : start.reshaped()) {
    x = uniform();
  }
  const auto target = by_rows([](const auto& x) { return -x[0] + x[1]; });
  const MetropolisKernel kernel = kernel_of(Eigen::MatrixXd(0.2 * Eigen::MatrixXd::Identity(2, 2)));
  Chains all{target, unit_box(2), kernel, start};
  all.move(1);
  const std::vector<Index> rows{149, 3, 70, 0, 64};
  Chains some{target, unit_box(2), kernel, start};
  CHECK(some.move(1, rows).proposals == 5);
  for (Index i = 0; i < n; ++i) {
    CAPTURE(i);
    const bool moved = std::find(rows.begin(), rows.end(), i) != rows.end();
    CHECK((some.points.row(i) == (moved ? all.points.row(i) : start.row(i))));
  }
}

TEST_CASE("the draws of a step depend on seed, stage and draw", "[tmcmc][moves]") {
  const auto moved = [](std::uint64_t seed, std::uint32_t stage, std::uint32_t draw) {
    Chains chains{by_rows([](const auto&) { return 0.0; }), unit_box(1), kernel_of(0.1),
                  Population::Constant(100, 1, 0.5)};
    chains.seed = seed;
    chains.kernel.stage = stage;
    chains.move(1, {}, draw);
    return chains.points;
  };
  const Population reference = moved(1, 1, 0);
  CHECK(moved(1, 1, 0) == reference);
  CHECK((moved(2, 1, 0).array() != reference.array()).all());
  CHECK((moved(1, 2, 0).array() != reference.array()).all());
  CHECK((moved(1, 1, 1).array() != reference.array()).all());
}
