#include <catch2/catch.hpp>

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
