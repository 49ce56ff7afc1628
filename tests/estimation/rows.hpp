// Observations for the tests: Table 1 as printed and synthetic rows.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

#include "estimation/parameter_bounds.hpp"
#include "friction/observations.hpp"
#include "friction/response.hpp"

namespace rows {

inline friction::Observations table1() {
  return {{0.643, 0.786, 0.929, 1.071, 1.214, 1.357, 1.500, 1.643, 1.786, 1.929},
          {0.644, 0.793, 0.954, 1.065, 1.216, 1.356, 1.481, 1.639, 1.768, 1.937},
          {1.987, 2.447, 2.945, 3.286, 3.753, 4.186, 4.569, 5.056, 5.455, 5.978},
          {27.466, 29.968, 27.739, 149.366, 148.301, 153.816, 151.774, 144.536, 149.090, 149.947}};
}

inline friction::Physics as_published() {
  return {2.5, friction::LimitRule::grid, friction::PhaseRule::discrete_bin};
}

inline estimation::ParameterBounds table2() {
  return {{{0.01, 10.0}, {0.01, 10.0}, {0.001, 10.0}, {0.001, 1.0}}};
}

inline friction::Observations first(std::size_t count, friction::Observations o) {
  for (auto* column : {&o.nominal_ratio, &o.measured_ratio, &o.driving_frequency_hz, &o.phase_deg}) {
    column->resize(count);
  }
  return o;
}

/// Uniform numbers in (0, 1) and nearly normal ones, the same with every standard library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : generator_(seed) {}
  double uniform() { return (static_cast<double>(generator_() >> 11U) + 0.5) * 0x1p-53; }
  double normal() {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) {
      sum += uniform();
    }
    return sum;
  }

 private:
  std::mt19937_64 generator_;
};

constexpr double true_force_n = 1.0;
constexpr double true_frequency_hz = 3.086;

/// Exact physics at the truth above, ratios from 0.6 to 1.95, with noise added.
inline friction::Observations synthetic(std::size_t count, double phase_noise_deg, double ratio_noise) {
  Random random(7);
  friction::Observations o;
  const friction::Physics physics;
  for (std::size_t i = 0; i < count; ++i) {
    const double equidistant = 0.6 + 1.35 * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
    const double r = std::fabs(equidistant - 1.0) < 0.03 ? 1.05 : equidistant;
    const auto constants = friction::response_constants(r, physics);
    o.measured_ratio.push_back(r);
    o.phase_deg.push_back(friction::phase_deg(constants, true_force_n / physics.driving_force_n) +
                          phase_noise_deg * random.normal());
    o.driving_frequency_hz.push_back(r * true_frequency_hz);
    o.nominal_ratio.push_back(r + ratio_noise * random.normal());
  }
  return o;
}

}  // namespace rows
