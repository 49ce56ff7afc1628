// Observations with known truth.

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "data/columns.hpp"
#include "errors/invalid_value.hpp"
#include "replication/synthetic.hpp"
#include "tmcmc/statistics.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using friction::Observations;
using replication::generate_observations;
using replication::nominal_ratios;
using replication::Truth;

const friction::Physics exact{};
const friction::Physics published{.limit = friction::LimitRule::grid,
                                  .phase = friction::PhaseRule::discrete_bin};

bool same(const Observations& a, const Observations& b) {
  return a.nominal_ratio == b.nominal_ratio && a.measured_ratio == b.measured_ratio &&
         a.driving_frequency_hz == b.driving_frequency_hz && a.phase_deg == b.phase_deg;
}

}  // namespace

TEST_CASE("the nominal ratios are those of Table 1", "[study][synthetic]") {
  CHECK(nominal_ratios() == test_data::table1().nominal_ratio);
}

TEST_CASE("without noise the observations are the model", "[study][synthetic]") {
  const Truth truth{.friction_force_n = 1.2,
                    .natural_frequency_hz = 3.0,
                    .phase_noise_deg = 0.0,
                    .frequency_ratio_noise = 0.0};
  for (const auto& physics : {exact, published}) {
    const Observations o = generate_observations(truth, nominal_ratios(), physics, 1);
    CHECK_NOTHROW(o.validate());
    CHECK(o.measured_ratio == nominal_ratios());
    for (std::size_t i = 0; i < o.size(); ++i) {
      CHECK_THAT(o.driving_frequency_hz[i], WithinRel(3.0 * o.nominal_ratio[i], 1e-15));
      CHECK(o.phase_deg[i] ==
            friction::phase_deg(friction::response_constants(o.nominal_ratio[i], physics), 1.2 / 2.5));
    }
  }
}

TEST_CASE("the phase is that at the measured ratio, not at the nominal one", "[study][synthetic]") {
  Truth truth;
  truth.phase_noise_deg = 0.0;
  const Observations o = generate_observations(truth, nominal_ratios(), exact, 5);
  for (std::size_t i = 0; i < o.size(); ++i) {
    CHECK(o.measured_ratio[i] != o.nominal_ratio[i]);
    CHECK(o.phase_deg[i] ==
          friction::phase_deg(friction::response_constants(o.measured_ratio[i], exact), 1.086 / 2.5));
  }
}

TEST_CASE("the errors are independent normals of the stated sizes", "[study][synthetic]") {
  const Truth truth;
  CHECK(truth.friction_force_n == 1.086);
  CHECK(truth.natural_frequency_hz == 3.086);
  CHECK(truth.phase_noise_deg == 2.0);
  CHECK(truth.frequency_ratio_noise == 0.01);
  std::vector<double> ratio_errors;
  std::vector<double> phase_errors;
  std::vector<double> next_row;
  std::vector<double> this_row;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const Observations o = generate_observations(truth, nominal_ratios(), exact, seed);
    REQUIRE(o.size() == 10);
    for (std::size_t i = 0; i < o.size(); ++i) {
      CHECK_THAT(o.driving_frequency_hz[i], WithinRel(o.measured_ratio[i] * 3.086, 1e-15));
      ratio_errors.push_back((o.measured_ratio[i] - o.nominal_ratio[i]) / 0.01);
      const double model =
          friction::phase_deg(friction::response_constants(o.measured_ratio[i], exact), 1.086 / 2.5);
      phase_errors.push_back((o.phase_deg[i] - model) / 2.0);
      if (i > 0) {
        this_row.push_back(phase_errors.back());
        next_row.push_back(phase_errors[phase_errors.size() - 2]);
      }
    }
  }
  CHECK(statistics::kolmogorov(ratio_errors, statistics::normal_cdf) < statistics::kolmogorov_bound);
  CHECK(statistics::kolmogorov(phase_errors, statistics::normal_cdf) < statistics::kolmogorov_bound);
  CHECK(std::fabs(statistics::scaled_correlation(ratio_errors, phase_errors)) < statistics::standard_errors);
  CHECK(std::fabs(statistics::scaled_correlation(this_row, next_row)) < statistics::standard_errors);
  const double n = static_cast<double>(ratio_errors.size());
  for (const auto& errors : {ratio_errors, phase_errors}) {
    const auto e = statistics::estimate(errors);
    CHECK(e.errors_from(0.0) < statistics::standard_errors);
    CHECK_THAT(e.standard_deviation, WithinAbs(1.0, statistics::standard_errors / std::sqrt(2.0 * n)));
  }
}

TEST_CASE("observations depend on the seed, and a row on its number alone", "[study][synthetic]") {
  const Observations o = generate_observations({}, nominal_ratios(), exact, 7);
  CHECK(same(o, generate_observations({}, nominal_ratios(), exact, 7)));
  CHECK_FALSE(same(o, generate_observations({}, nominal_ratios(), exact, 8)));
  auto fewer = nominal_ratios();
  fewer.resize(4);
  const Observations first = generate_observations({}, fewer, exact, 7);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(first.measured_ratio[i] == o.measured_ratio[i]);
    CHECK(first.phase_deg[i] == o.phase_deg[i]);
  }
}

TEST_CASE("noise beyond a turn leaves an angle", "[study][synthetic]") {
  Truth wide;
  wide.phase_noise_deg = 500.0;
  Truth narrow;
  const Observations far = generate_observations(wide, nominal_ratios(), exact, 7);
  const Observations near = generate_observations(narrow, nominal_ratios(), exact, 7);
  CHECK_NOTHROW(far.validate());
  bool reduced = false;
  for (std::size_t i = 0; i < far.size(); ++i) {
    const double phase =
        friction::phase_deg(friction::response_constants(near.measured_ratio[i], exact), 1.086 / 2.5);
    const double unreduced = phase + 250.0 * (near.phase_deg[i] - phase);
    CHECK_THAT(std::remainder(far.phase_deg[i] - unreduced, 360.0), WithinAbs(0.0, 1e-9));
    reduced = reduced || std::fabs(unreduced) > 360.0;
  }
  CHECK(reduced);
}

TEST_CASE("a truth in stick-slip is refused, naming ratio and force", "[study][synthetic]") {
  Truth truth;
  truth.friction_force_n = 2.0;
  CHECK_THROWS_AS(generate_observations(truth, nominal_ratios(), exact, 1), errors::InvalidValue);
  CHECK_THROWS_WITH(generate_observations(truth, nominal_ratios(), exact, 1),
                    Contains("friction_force_n = 2:") && Contains("stick-slip"));
  CHECK_NOTHROW(generate_observations(truth, {0.8, 0.9}, exact, 1));  // continuous there
}

TEST_CASE("a truth out of range is refused by name", "[study][synthetic]") {
  const auto refused = [](const std::function<void(Truth&, double)>& set, const char* field,
                          double zero_is_allowed) {
    const double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> bad{-1.0, infinity, -infinity, std::numeric_limits<double>::quiet_NaN()};
    if (zero_is_allowed == 0.0) {
      bad.push_back(0.0);
    }
    for (const double value : bad) {
      CAPTURE(field, value);
      Truth truth;
      set(truth, value);
      CHECK_THROWS_AS(generate_observations(truth, nominal_ratios(), exact, 1), errors::InvalidValue);
      CHECK_THROWS_WITH(generate_observations(truth, nominal_ratios(), exact, 1), Contains(field));
    }
  };
  refused([](Truth& t, double v) { t.friction_force_n = v; }, "friction_force_n = ", 1.0);
  refused([](Truth& t, double v) { t.natural_frequency_hz = v; }, "natural_frequency_hz = ", 0.0);
  refused([](Truth& t, double v) { t.phase_noise_deg = v; }, "phase_noise_deg = ", 1.0);
  refused([](Truth& t, double v) { t.frequency_ratio_noise = v; }, "frequency_ratio_noise = ", 1.0);
}
