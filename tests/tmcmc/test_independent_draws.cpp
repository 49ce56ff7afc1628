// A posterior measured by independent draws from a fitted density.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "errors/invalid_value.hpp"
#include "problems.hpp"
#include "tmcmc/independent_draws.hpp"

using namespace tmcmc;

namespace {

const double log_two_pi = std::log(2.0 * std::acos(-1.0));

/// Correlated normal density in two dimensions on [-10, 10]^2: log-evidence -2 log 20.
Problem normal() {
  return {problems::by_rows([](const auto& x) {
            constexpr double rho = 0.7;
            const double q = (x[0] * x[0] - 2.0 * rho * x[0] * x[1] + x[1] * x[1]) / (1.0 - rho * rho);
            return -0.5 * q - 0.5 * std::log(1.0 - rho * rho) - log_two_pi;
          }),
          BoxPrior(Eigen::Vector2d(-10.0, -10.0), Eigen::Vector2d(10.0, 10.0))};
}
const double log_evidence_of_normal = -2.0 * std::log(20.0);

/// A wide normal with a tenth of the mass, and a spike with the rest.
Problem slab_and_spike(double spike_width) {
  return {problems::by_rows([=](const auto& x) {
            const double q = x[0] * x[0] + x[1] * x[1];
            const double p = (x[0] - 3.0) * (x[0] - 3.0) + (x[1] - 3.0) * (x[1] - 3.0);
            return std::log(0.1 / (2.0 * std::acos(-1.0)) * std::exp(-0.5 * q) +
                            0.9 / (2.0 * std::acos(-1.0) * spike_width * spike_width) *
                                std::exp(-0.5 * p / (spike_width * spike_width)));
          }),
          BoxPrior(Eigen::Vector2d(-10.0, -10.0), Eigen::Vector2d(10.0, 10.0))};
}

bool warns(const MeasuredPosterior& measured, MeasurementWarningKind kind) {
  for (const auto& warning : measured.warnings) {
    if (warning.kind == kind) {
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("The log-evidence of a normal posterior is right within an honest error") {
  constexpr int runs = 40;
  double squares = 0.0;
  double error = 0.0;
  int warned = 0;
  for (std::uint32_t run = 0; run < runs; ++run) {
    const auto measured =
        run_with_independent_draws(normal(), {.evaluations = 10000}, {.seed = 1, .run = run});
    const double z =
        (measured.evidence.log_evidence - log_evidence_of_normal) / measured.evidence.standard_error;
    squares += z * z / runs;
    error += measured.evidence.standard_error / runs;
    warned += measured.warnings.empty() ? 0 : 1;
    CHECK(measured.evaluations == 10000);
    CHECK(measured.weights.sum() == Approx(static_cast<double>(measured.points.rows())));
  }
  CHECK(std::sqrt(squares) < 1.5);
  CHECK(std::sqrt(squares) > 0.6);
  CHECK(error < 0.01);
  CHECK(warned <= 1);
}

TEST_CASE("Weighted moments and equally weighted points are those of the posterior") {
  const auto measured = run_with_independent_draws(normal(), {.evaluations = 20000}, {.seed = 2});
  const double n = static_cast<double>(measured.points.rows());
  const double independent = measured.effective_sample_size;
  CHECK(independent > 0.5 * n);
  const double mean = measured.points.col(0).dot(measured.weights) / n;
  const double product =
      (measured.points.col(0).array() * measured.points.col(1).array() * measured.weights.array()).sum() / n;
  CHECK(mean == Approx(0.0).margin(5.0 / std::sqrt(independent)));
  CHECK(product == Approx(0.7).margin(5.0 * std::sqrt(1.49 / independent)));
  const Population equal = equally_weighted(measured, 4000, {.seed = 2});
  CHECK(equal.rows() == 4000);
  CHECK(equal.col(1).squaredNorm() / 4000.0 == Approx(1.0).margin(5.0 * std::sqrt(2.0 / 4000.0)));
  CHECK_THROWS_AS(equally_weighted(measured, 0, {.seed = 2}), errors::InvalidValue);
}

TEST_CASE("A posterior against a corner of its box, a thousandth of it wide, is measured") {
  const Problem corner{
      problems::by_rows([](const auto& x) { return -(x[0] + x[1]) / 0.001 - 2.0 * std::log(0.001); }),
      BoxPrior(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, 1.0))};
  const auto measured = run_with_independent_draws(corner, {.evaluations = 20000}, {.seed = 3});
  CHECK(measured.evidence.standard_error < 0.02);
  CHECK(measured.evidence.log_evidence == Approx(0.0).margin(5.0 * measured.evidence.standard_error));
}

TEST_CASE("The same seed gives the same draws for any number of threads and size of batches") {
  IndependentDraws settings{.evaluations = 12000};
  const auto one = run_with_independent_draws(normal(), settings, {.seed = 4});
  settings.threads = 3;
  settings.batch_rows = 100;
  const auto three = run_with_independent_draws(normal(), settings, {.seed = 4});
  CHECK(one.points == three.points);
  CHECK(one.weights == three.weights);
  CHECK(one.evidence.log_evidence == three.evidence.log_evidence);
  const auto other = run_with_independent_draws(normal(), settings, {.seed = 4, .run = 1});
  CHECK(one.evidence.log_evidence != other.evidence.log_evidence);
}

TEST_CASE("Two modes of different mass are both measured") {
  const Problem two{problems::by_rows([](const auto& x) {
                      const double a = (x[0] + 4.0) * (x[0] + 4.0) + (x[1] + 4.0) * (x[1] + 4.0);
                      const double b = (x[0] - 3.0) * (x[0] - 3.0) + (x[1] - 3.0) * (x[1] - 3.0);
                      return std::log(0.3 / (2.0 * std::acos(-1.0) * 0.04) * std::exp(-0.5 * a / 0.04) +
                                      0.7 / (2.0 * std::acos(-1.0) * 0.25) * std::exp(-0.5 * b / 0.25) +
                                      1e-300);
                    }),
                    BoxPrior(Eigen::Vector2d(-10.0, -10.0), Eigen::Vector2d(10.0, 10.0))};
  const auto measured = run_with_independent_draws(two, {}, {.seed = 5});
  CHECK(measured.evidence.log_evidence ==
        Approx(log_evidence_of_normal).margin(5.0 * measured.evidence.standard_error));
  double mass = 0.0;
  for (Index i = 0; i < measured.points.rows(); ++i) {
    mass += measured.points(i, 0) < 0.0 ? measured.weights[i] : 0.0;
  }
  CHECK(mass / static_cast<double>(measured.points.rows()) == Approx(0.3).margin(0.02));
}

TEST_CASE("A wrong log-evidence comes with a warning where a spike holds most of the mass") {
  int wrong = 0;
  for (std::uint32_t run = 0; run < 10; ++run) {
    const auto measured =
        run_with_independent_draws(slab_and_spike(0.3), {.evaluations = 10000}, {.seed = 6, .run = run});
    const double z =
        (measured.evidence.log_evidence - log_evidence_of_normal) / measured.evidence.standard_error;
    if (measured.warnings.empty() && !(std::fabs(z) < 5.0)) {
      ++wrong;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("Where the searches do not come near the posterior, TMCMC takes over, with a warning") {
  const Problem wide{problems::by_rows([](const auto& x) { return -0.5 * x.squaredNorm(); }),
                     BoxPrior(Eigen::VectorXd::Constant(40, -10.0), Eigen::VectorXd::Constant(40, 10.0))};
  const auto measured = run_with_independent_draws(wide, {.evaluations = 6000}, {.seed = 7});
  CHECK(warns(measured, MeasurementWarningKind::search_not_completed));
  REQUIRE(measured.tmcmc.has_value());
  CHECK(measured.points == measured.tmcmc->final.points);
  CHECK(measured.evidence.log_evidence == measured.tmcmc->evidence.log_evidence);
  CHECK(measured.evaluations <= 6000);
}

TEST_CASE("Either rule of the paper chooses the same temperatures where the targets agree") {
  IndependentDraws settings{.evaluations = 8000};
  const auto by_size = run_with_independent_draws(normal(), settings, {.seed = 8});
  settings.criterion = coefficient_of_variation_rule(1.0);
  const auto by_variation = run_with_independent_draws(normal(), settings, {.seed = 8});
  CHECK(by_size.points == by_variation.points);
  settings.criterion = effective_sample_size_rule(0.8);
  CHECK(run_with_independent_draws(normal(), settings, {.seed = 8}).points(0, 0) != by_size.points(0, 0));
}

TEST_CASE("Two modes in ten dimensions keep their masses") {
  const Problem two{
      problems::by_rows([](const auto& x) {
        const double a = (x.array() - 4.0).square().sum() / 0.25;
        const double b = (x.array() + 4.0).square().sum() / 0.25;
        const double larger = std::max(-0.5 * a, -0.5 * b);
        return larger + std::log(0.75 * std::exp(-0.5 * a - larger) + 0.25 * std::exp(-0.5 * b - larger));
      }),
      BoxPrior(Eigen::VectorXd::Constant(10, -10.0), Eigen::VectorXd::Constant(10, 10.0))};
  const auto measured = run_with_independent_draws(two, {}, {.seed = 9});
  double mass = 0.0;
  for (Index i = 0; i < measured.points.rows(); ++i) {
    mass += measured.points(i, 0) > 0.0 ? measured.weights[i] : 0.0;
  }
  CHECK(mass / static_cast<double>(measured.points.rows()) == Approx(0.75).margin(0.05));
}

TEST_CASE("A model that excludes nearly all of the prior is measured, one that excludes all is refused") {
  const auto inside = [](double radius) {
    return Problem{problems::by_rows([=](const auto& x) {
                     return x.squaredNorm() < radius * radius ? 0.0
                                                              : -std::numeric_limits<double>::infinity();
                   }),
                   BoxPrior(Eigen::Vector2d(-1.0, -1.0), Eigen::Vector2d(1.0, 1.0))};
  };
  const auto measured = run_with_independent_draws(inside(0.1), {.evaluations = 20000}, {.seed = 10});
  const double exact = std::log(std::acos(-1.0) * 0.01 / 4.0);
  CHECK(measured.evidence.log_evidence == Approx(exact).margin(5.0 * measured.evidence.standard_error));
  CHECK(measured.evidence.standard_error < 0.1);
  CHECK_THROWS_AS(run_with_independent_draws(inside(0.0), {.evaluations = 3000}, {.seed = 10}),
                  InfeasiblePriorError);
}

TEST_CASE("A setting out of range is refused by name") {
  const auto field_of = [](const IndependentDraws& settings) {
    try {
      settings.validate();
    } catch (const errors::InvalidValue& error) {
      return error.field();
    }
    return std::string();
  };
  CHECK(field_of({}).empty());
  CHECK(field_of({.evaluations = 1999}) == "independent_draws.evaluations");
  CHECK(field_of({.search_share = 0.6}) == "independent_draws.search_share");
  CHECK(field_of({.prior_share = 1.0}) == "independent_draws.prior_share");
  CHECK(field_of({.fit = {.degrees_of_freedom = 7}}) == "independent_draws.fit.degrees_of_freedom");
  CHECK(field_of({.threads = 0}) == "independent_draws.threads");
}
