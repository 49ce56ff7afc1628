#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "friction_study.hpp"
#include "replication/calibration.hpp"

using Catch::Matchers::Contains;

namespace {

tmcmc::BoxPrior with_friction_force(const replication::Reading& reading, double lower, double upper) {
  const auto table2 = test_data::table2(reading);
  Eigen::VectorXd low = table2.lower();
  Eigen::VectorXd high = table2.upper();
  low[friction::friction_force] = lower;
  high[friction::friction_force] = upper;
  return {low, high};
}

}  // namespace

TEST_CASE("simulated pairs have continuous motion and positive ratios", "[study][calibration]") {
  const auto reading = replication::reading(replication::ReadingName::corrected);
  const auto design = test_data::table1();
  const auto prior = with_friction_force(reading, 1.0, 1000.0);
  const double limit = friction::Likelihood(design, reading.physics).limit_friction_force_n();
  for (std::uint32_t replication = 0; replication < 10; ++replication) {
    const auto pair = replication::simulate_pair(design, reading.physics, prior, 1, replication);
    CHECK(pair.parameters[friction::friction_force] <= limit);
    CHECK_NOTHROW(pair.observations.validate());
    CHECK(pair.observations.measured_ratio == design.measured_ratio);
  }
}

TEST_CASE("a prior without continuous motion is refused, not drawn from for ever", "[study][calibration]") {
  const auto reading = replication::reading(replication::ReadingName::corrected);
  const auto design = test_data::table1();
  for (const auto& prior :
       {with_friction_force(reading, 8.0, 10.0), with_friction_force(reading, 0.0, 1e100)}) {
    CHECK_THROWS_AS(replication::simulate_pair(design, reading.physics, prior, 1, 0),
                    tmcmc::InfeasiblePriorError);
    replication::CalibrationOptions options;
    CHECK_THROWS_WITH(
        replication::calibrate(design, reading, prior, {"arm", reading.sampler}, 0, options),
        Contains("expected friction forces up to 1.5") && Contains("the limit of continuous motion"));
  }
}

TEST_CASE("bins of ranks have the binomial band and the distance from the uniform distribution function",
          "[calibration]") {
  const replication::RankHistogram histogram{.counts = {30, 10, 40, 20}};
  const auto bins = replication::rank_bins(histogram);
  REQUIRE(bins.size() == 4);
  CHECK(bins[1].place == 0.375);
  CHECK(bins[1].count == 10);
  CHECK(bins[1].expected == 25.0);
  CHECK(bins[1].edge == 0.5);
  CHECK(bins[1].ecdf_difference == Approx(-0.1));
  CHECK(bins[3].ecdf_difference == Approx(0.0).margin(1e-15));
  CHECK(bins[1].ecdf_band == Approx(3.47 * std::sqrt(0.25 / 100.0)));
  // Of 100 ranks, with a probability of a quarter each, 0.5 % are below 15 and 0.5 % above 36.
  CHECK(bins[0].band_low == Approx(14.0).margin(1.0));
  CHECK(bins[0].band_high == Approx(37.0).margin(1.0));
}

TEST_CASE("a sampler is calibrated unless a test of one of its parameters fails, counted with the others",
          "[calibration]") {
  const replication::CalibrationOptions options{.replications = 100, .draws = 99, .bins = 20};
  std::vector<tmcmc::Index> uniform(100);
  std::iota(uniform.begin(), uniform.end(), 0);
  std::vector<tmcmc::Index> skewed = uniform;
  for (auto& rank : skewed) {
    rank = rank * 7 / 10;  // the truth is never among the largest three tenths
  }
  const auto good = replication::judge_calibration({.ranks = {uniform, uniform}}, options);
  CHECK(good.histograms.size() == 2);
  CHECK(good.smallest_p == 1.0);
  CHECK(good.is_calibrated);
  const auto bad = replication::judge_calibration({.ranks = {uniform, skewed}}, options);
  CHECK_FALSE(bad.is_calibrated);
  // Six tests: the smallest of their p-values counts six times (Holm 1979).
  const auto& h = bad.histograms[1];
  CHECK(bad.smallest_p ==
        Approx(6.0 * std::min({h.p_chi_squared, h.p_coverage_50, h.p_coverage_90})).epsilon(1e-12));
}
