#include "replication/synthetic.hpp"

#include <cmath>
#include <string>

#include "errors/invalid_value.hpp"
#include "friction/angle.hpp"
namespace replication {

std::vector<double> nominal_ratios() {
  std::vector<double> ratios;
  for (int k = 9; k <= 27; k += 2) {
    ratios.push_back(std::round(1000.0 * k / 14.0) / 1000.0);
  }
  return ratios;
}

friction::Observations generate_observations(const Truth& truth, const std::vector<double>& nominal_ratio,
                                             const friction::Physics& physics, std::uint64_t seed) {
  const auto require = [](bool condition, const char* field, double value, const char* expected) {
    if (!condition || !std::isfinite(value)) {
      throw errors::InvalidValue(field, value, expected);
    }
  };
  require(truth.friction_force_n >= 0.0, "friction_force_n", truth.friction_force_n,
          "a number of at least 0");
  require(truth.natural_frequency_hz > 0.0, "natural_frequency_hz", truth.natural_frequency_hz,
          "a positive number");
  require(truth.phase_noise_deg >= 0.0, "phase_noise_deg", truth.phase_noise_deg, "a number of at least 0");
  require(truth.frequency_ratio_noise >= 0.0, "frequency_ratio_noise", truth.frequency_ratio_noise,
          "a number of at least 0");
  friction::Observations o;
  for (std::size_t i = 0; i < nominal_ratio.size(); ++i) {
    const auto words = tmcmc::random_words({.seed = seed}, {.purpose = tmcmc::Purpose::data, .row = i});
    const auto noise = tmcmc::normal_pair(words[0], words[1] >> 32U);
    const double r = nominal_ratio[i] + truth.frequency_ratio_noise * noise.first;
    const double phase = friction::phase_deg(friction::response_constants(r, physics),
                                             truth.friction_force_n / physics.driving_force_n);
    if (std::isnan(phase)) {
      throw errors::InvalidValue("friction_force_n", truth.friction_force_n,
                                 "continuous motion at the frequency ratio " + std::to_string(r) +
                                     ", the phase angle of stick-slip is not modelled");
    }
    o.nominal_ratio.push_back(nominal_ratio[i]);
    o.measured_ratio.push_back(r);
    o.driving_frequency_hz.push_back(r * truth.natural_frequency_hz);
    o.phase_deg.push_back(friction::within_a_turn_deg(phase + truth.phase_noise_deg * noise.second));
  }
  return o;
}

}  // namespace replication
