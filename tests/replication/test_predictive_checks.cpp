#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "replication/predictive_checks.hpp"
#include "replication/synthetic.hpp"

using namespace replication;
using Catch::Matchers::WithinAbs;

namespace {

const friction::Physics physics{};
const PosteriorOf posterior_of = [](const friction::Observations& o) {
  return estimation::ExactPosterior(
      friction::Likelihood(o, physics),
      estimation::ParameterBounds{{{0.01, 10.0}, {0.01, 10.0}, {0.001, 10.0}, {0.001, 1.0}}});
};

}  // namespace

TEST_CASE("predictions of simulated measurements from the others are calibrated", "[predictive]") {
  // Uniform probabilities: of 20 data sets with 10 rows each, 95 % of the phases and of the ratios
  // lie in the central 95 %. Rows of one set share a posterior, so that the bound is that of
  // independent sets with few effective rows: 4 standard errors.
  std::vector<double> phases, ratios;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto measured = generate_observations({.friction_force_n = 0.6}, nominal_ratios(), physics, seed);
    const PredictiveDrawing drawing{.seed = seed, .draws = 400};
    const auto draws = predictive_draws(posterior_of(measured), drawing, 0);
    for (const auto& row : predict_rows(measured, draws, posterior_of, physics, drawing)) {
      phases.push_back(row.phase.left_out);
      ratios.push_back(row.ratio.left_out);
      CHECK(row.phase.band.low < row.phase.band.model_low);
      CHECK(row.phase.probability > 0.0);
    }
  }
  for (const auto& probabilities : {phases, ratios}) {
    const auto coverage = coverage_95(probabilities);
    CHECK(coverage.measurements == 200);
    const double standard_error = std::sqrt(0.95 * 0.05 / 200.0);
    CHECK_THAT(static_cast<double>(coverage.inside) / 200.0, WithinAbs(0.95, 4.0 * standard_error));
    double mean = 0.0;
    for (const double p : probabilities) {
      mean += p / 200.0;
    }
    CHECK_THAT(mean, WithinAbs(0.5, 4.0 / std::sqrt(12.0 * 200.0)));
  }
}

TEST_CASE("coverage counts what has a prediction, and says how probable so few are", "[predictive]") {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const auto coverage = coverage_95({0.5, 0.01, none, 0.9});
  CHECK(coverage.measurements == 3);
  CHECK(coverage.inside == 2);
  CHECK_THAT(coverage.probability, WithinAbs(1.0 - 0.95 * 0.95 * 0.95, 1e-12));
  CHECK_THAT(coverage_95({0.5, 0.5}).probability, WithinAbs(1.0, 1e-12));
  CHECK(coverage_95({none}).measurements == 0);
}

TEST_CASE("one row has no others to be predicted from", "[predictive]") {
  friction::Observations one{{0.8}, {0.81}, {2.4}, {25.0}};
  const PredictiveDrawing drawing{.draws = 200};
  const auto rows =
      predict_rows(one, predictive_draws(posterior_of(one), drawing, 0), posterior_of, physics, drawing);
  REQUIRE(rows.size() == 1);
  CHECK(std::isnan(rows[0].phase.left_out));
  CHECK(rows[0].phase.probability > 0.0);
}

TEST_CASE("a curve reaches a tenth beyond the measurements, but stays positive", "[predictive]") {
  const auto range = curve_range({2.0, 1.0, 1.5});
  CHECK_THAT(range.lower, WithinAbs(0.9, 1e-15));
  CHECK_THAT(range.upper, WithinAbs(2.1, 1e-15));
  CHECK(curve_range({0.1, 5.0}).lower == 0.05);
  CHECK_THAT(curve_range({3.0}).upper, WithinAbs(3.3, 1e-15));
}

TEST_CASE("a bound that cuts the posterior off is found, one in its tail is not", "[predictive]") {
  const auto measured = generate_observations({}, nominal_ratios(), physics, 1);
  const friction::Likelihood likelihood(measured, physics);
  estimation::ParameterBounds bounds{{{0.01, 10.0}, {0.01, 10.0}, {0.001, 10.0}, {0.001, 1.0}}};
  CHECK(cut_offs(estimation::ExactPosterior(likelihood, bounds)).empty());
  const double median = posterior_of(measured).marginal(friction::natural_frequency).quantile(0.5);
  bounds[friction::natural_frequency].upper = median;
  const auto cuts = cut_offs(estimation::ExactPosterior(likelihood, bounds));
  REQUIRE(cuts.size() == 1);
  CHECK(cuts[0].parameter == friction::natural_frequency);
  CHECK(cuts[0].bound == median);
}
