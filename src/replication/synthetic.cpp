#include "replication/synthetic.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

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
      throw std::invalid_argument(std::string(field) + " = " + std::to_string(value) + ": expected " +
                                  expected);
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
    const auto errors = tmcmc::normal_pair(words[0], words[1] >> 32U);
    const double r = nominal_ratio[i] + truth.frequency_ratio_noise * errors.first;
    const double phase = friction::phase_deg(friction::response_constants(r, physics),
                                             truth.friction_force_n / physics.driving_force_n);
    if (std::isnan(phase)) {
      throw std::invalid_argument(
          "frequency ratio " + std::to_string(r) + " at friction force " +
          std::to_string(truth.friction_force_n) +
          " N: expected continuous motion, the phase angle of stick-slip is not modelled");
    }
    o.nominal_ratio.push_back(nominal_ratio[i]);
    o.measured_ratio.push_back(r);
    o.driving_frequency_hz.push_back(r * truth.natural_frequency_hz);
    o.phase_deg.push_back(phase + truth.phase_noise_deg * errors.second);
  }
  return o;
}

}  // namespace replication
