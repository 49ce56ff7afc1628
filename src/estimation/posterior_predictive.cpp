#include "estimation/posterior_predictive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "errors/invalid_value.hpp"
#include "friction/angle.hpp"

namespace estimation {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void require_draws(std::span<const PredictiveDraw> draws) {
  if (draws.empty()) {
    throw errors::InvalidValue("draws", 0.0, "at least one draw of the posterior");
  }
}

/// Quantile by linear interpolation of the order statistics, as statistics::sample_quantile.
double quantile(std::vector<double>& values, double p) {
  const double place = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[static_cast<std::size_t>(below)];
  if (below + 1 == static_cast<std::ptrdiff_t>(values.size())) {
    return low;
  }
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  return low + (place - static_cast<double>(below)) * (high - low);
}

PredictiveBand band_of(std::vector<double> model, std::vector<double> measured, std::size_t draws) {
  if (model.empty()) {
    return {nan, nan, nan, nan, nan, 0.0};
  }
  return {quantile(model, 0.025),    quantile(model, 0.5),
          quantile(model, 0.975),    quantile(measured, 0.025),
          quantile(measured, 0.975), static_cast<double>(model.size()) / static_cast<double>(draws)};
}

double normal_probability(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

}  // namespace

PredictiveBand phase_band(std::span<const PredictiveDraw> draws, double measured_ratio,
                          const friction::Physics& physics) {
  require_draws(draws);
  const auto constants = friction::response_constants(measured_ratio, physics);
  std::vector<double> model, measured;
  for (const auto& draw : draws) {
    const double phase =
        friction::phase_deg(constants, draw.point[friction::friction_force] / physics.driving_force_n);
    if (!std::isnan(phase)) {
      model.push_back(phase);
      measured.push_back(phase + draw.point[friction::phase_noise] * draw.phase_score);
    }
  }
  return band_of(std::move(model), std::move(measured), draws.size());
}

PredictiveBand ratio_band(std::span<const PredictiveDraw> draws, double driving_frequency_hz) {
  require_draws(draws);
  std::vector<double> model, measured;
  for (const auto& draw : draws) {
    model.push_back(driving_frequency_hz / draw.point[friction::natural_frequency]);
    measured.push_back(model.back() + draw.point[friction::frequency_ratio_noise] * draw.ratio_score);
  }
  return band_of(std::move(model), std::move(measured), draws.size());
}

double phase_probability(std::span<const PredictiveDraw> draws, double measured_ratio, double observed_deg,
                         const friction::Physics& physics) {
  require_draws(draws);
  const auto constants = friction::response_constants(measured_ratio, physics);
  double sum = 0.0;
  double count = 0.0;
  for (const auto& draw : draws) {
    const double phase =
        friction::phase_deg(constants, draw.point[friction::friction_force] / physics.driving_force_n);
    if (!std::isnan(phase)) {
      sum += normal_probability(friction::angle_residual_deg(observed_deg, phase) /
                                draw.point[friction::phase_noise]);
      count += 1.0;
    }
  }
  return count > 0.0 ? sum / count : nan;
}

double ratio_probability(std::span<const PredictiveDraw> draws, double driving_frequency_hz,
                         double observed) {
  require_draws(draws);
  double sum = 0.0;
  for (const auto& draw : draws) {
    sum += normal_probability((observed - driving_frequency_hz / draw.point[friction::natural_frequency]) /
                              draw.point[friction::frequency_ratio_noise]);
  }
  return sum / static_cast<double>(draws.size());
}

}  // namespace estimation
