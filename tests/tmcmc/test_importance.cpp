// Estimates from weighted independent draws, and the fitted tail of the weights.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tmcmc/importance.hpp"
#include "tmcmc/random.hpp"

using namespace tmcmc;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<double> uniforms(std::uint64_t seed, std::size_t n) {
  std::vector<double> values;
  for (std::size_t i = 0; i < n; ++i) {
    values.push_back(
        uniform_open(random_words({.seed = seed}, {.purpose = Purpose::statistics, .row = i})[0]));
  }
  return values;
}

/// Log-weights whose upper tail is Pareto with the given shape: w = u^-shape.
std::vector<double> pareto(double shape, std::uint64_t seed, std::size_t n) {
  auto values = uniforms(seed, n);
  for (double& value : values) {
    value = -shape * std::log(value);
  }
  return values;
}

}  // namespace

TEST_CASE("The mean weight and the effective size are those of the definition, at any level") {
  for (const double level : {0.0, -800.0, 800.0}) {
    const std::vector<double> log_weights{level, level + std::log(2.0), level + std::log(3.0), -infinity};
    const auto estimate = importance_estimate(log_weights);
    CHECK(estimate.log_mean == Approx(level + std::log(1.5)).epsilon(1e-12));
    CHECK(estimate.effective_sample_size == Approx(36.0 / 14.0));
    CHECK(estimate.standard_error == Approx(std::sqrt(5.0 / 3.0 / 4.0) / 1.5));
    CHECK(normalised_weights(log_weights)[2] == Approx(2.0));
  }
}

TEST_CASE("Draws without any weight have an infinite error") {
  const std::vector<double> none(30, -infinity);
  const auto estimate = importance_estimate(none);
  CHECK(estimate.log_mean == -infinity);
  CHECK(estimate.standard_error == infinity);
  CHECK(estimate.effective_sample_size == 0.0);
  CHECK(tempering_power(none, 1.0) == 0.0);
}

TEST_CASE("The error does not count differences between strata of fixed size") {
  std::vector<double> log_weights = uniforms(1, 6400);
  const double free = importance_estimate(log_weights).standard_error;
  for (std::size_t i = 3200; i < 6400; ++i) {
    log_weights[i] += 3.0;
  }
  // Relative to the larger mean, the first half hardly counts: sqrt(1/2) of the draws at twice the
  // share.
  const double mean_ratio = 2.0 / (1.0 + std::exp(-3.0));
  CHECK(importance_estimate(log_weights).standard_error ==
        Approx(free * mean_ratio * std::sqrt(0.5 * (1.0 + std::exp(-6.0)))).epsilon(0.03));
}

TEST_CASE("The stated error of the log-mean is that of repetitions") {
  double squares = 0.0;
  constexpr int repetitions = 400;
  for (int r = 0; r < repetitions; ++r) {
    auto log_weights = uniforms(100 + static_cast<std::uint64_t>(r), 500);
    const auto estimate = importance_estimate(log_weights);
    const double z = (estimate.log_mean - std::log(std::exp(1.0) - 1.0)) / estimate.standard_error;
    squares += z * z / repetitions;
  }
  CHECK(squares == Approx(1.0).margin(5.0 * std::sqrt(2.0 / repetitions)));
}

TEST_CASE("The fitted shape of a Pareto tail is its shape") {
  for (const double shape : {0.2, 0.5, 1.0}) {
    double mean = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      mean += pareto_shape(pareto(shape, seed, 4000)) / 20.0;
    }
    CHECK(mean == Approx(shape).margin(0.1));
  }
}

TEST_CASE("The fitted shape does not change with the level of the weights, and equal weights have no tail") {
  auto log_weights = pareto(0.5, 2, 1000);
  const double shape = pareto_shape(log_weights);
  for (double& value : log_weights) {
    value -= 5000.0;
  }
  CHECK(pareto_shape(log_weights) == Approx(shape).epsilon(1e-9));
  CHECK(pareto_shape(std::vector<double>(1000, 2.0)) == -infinity);
  CHECK(pareto_shape(std::vector<double>(24, 2.0)) == -infinity);
}

TEST_CASE("Weights to the tempering power have the effective size asked for") {
  auto log_weights = pareto(2.0, 3, 2000);
  const double power = tempering_power(log_weights, 800.0);
  REQUIRE(power > 0.0);
  REQUIRE(power < 1.0);
  for (double& value : log_weights) {
    value *= power;
  }
  CHECK(importance_estimate(log_weights).effective_sample_size == Approx(800.0).epsilon(1e-6));
  CHECK(tempering_power(log_weights, 10.0) == 1.0);
}
