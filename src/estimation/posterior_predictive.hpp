/// \file
/// Posterior predictive distributions of new measurements of the rig, and the position of the
/// measured values in them.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "friction/likelihood.hpp"

namespace estimation {

/// A draw from the posterior, with the standard normal errors of one new measurement.
struct PredictiveDraw {
  /// Parameters in the order of friction::Parameter.
  std::array<double, friction::parameter_count> point;
  /// Error of the phase angle over sigma_phase.
  double phase_score;
  /// Error of the frequency ratio over sigma_r.
  double ratio_score;
};

/// Central 95 % intervals at one ratio or frequency: of the model output, with parameter
/// uncertainty, and of a new measurement, with measurement noise as well.
struct PredictiveBand {
  /// 2.5 % quantile of the model.
  double model_low;
  /// Median of the model.
  double median;
  /// 97.5 % quantile of the model.
  double model_high;
  /// 2.5 % quantile of a new measurement.
  double low;
  /// 97.5 % quantile of a new measurement.
  double high;
  /// Of the draws that have a response here; quantiles are over these, NaN if there are none.
  double share;
};

/// Band of the phase angle at a measured frequency ratio, deg: M_phase(r, F_mu) + sigma_phase z
/// (Eq. 23). Draws whose motion is not continuous there have no response. With noise the phase may
/// leave [0, 180], as measured phases do.
/// \param draws  draws from the posterior, not empty
/// \throws errors::InvalidValue for a ratio that response_constants() refuses, or if there is no
///         draw.
[[nodiscard]] PredictiveBand phase_band(std::span<const PredictiveDraw> draws, double measured_ratio,
                                        const friction::Physics& physics);

/// Band of the nominal frequency ratio at a driving frequency: omega_b / omega_n + sigma_r z (Eq.
/// 24).
/// \throws errors::InvalidValue if there is no draw.
[[nodiscard]] PredictiveBand ratio_band(std::span<const PredictiveDraw> draws, double driving_frequency_hz);

/// P(new phase < observed), a number in (0, 1): the normal distribution function of the residual of
/// an angle (friction::angle_residual_deg), averaged over the draws that have a response at this
/// ratio; NaN if no draw has one. For a calibrated prediction of measurements that were not used to
/// fit it, these probabilities are uniform.
/// \throws as phase_band
[[nodiscard]] double phase_probability(std::span<const PredictiveDraw> draws, double measured_ratio,
                                       double observed_deg, const friction::Physics& physics);

/// P(new nominal ratio < observed), as phase_probability.
/// \throws as ratio_band
[[nodiscard]] double ratio_probability(std::span<const PredictiveDraw> draws, double driving_frequency_hz,
                                       double observed);

}  // namespace estimation
