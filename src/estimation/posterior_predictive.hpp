/// \file
/// What the posterior predicts for new measurements of the rig, and how the measured ones lie in it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "friction/likelihood.hpp"

namespace estimation {

/// A draw of the posterior with the standard normal errors of one new measurement.
struct PredictiveDraw {
  std::array<double, friction::parameter_count> point;  ///< in the order of friction::Parameter
  double phase_score;                                   ///< error of the phase angle over sigma_phase
  double ratio_score;                                   ///< error of the frequency ratio over sigma_r
};

/// Central 95 % at one place: of the model, with the uncertainty of its parameters, and of a new measurement, with noise too.
struct PredictiveBand {
  double model_low;   ///< 2.5 % quantile of the model
  double median;      ///< of the model
  double model_high;  ///< 97.5 % quantile of the model
  double low;         ///< 2.5 % quantile of a new measurement
  double high;        ///< 97.5 % quantile of a new measurement
  double
      share;  ///< of the draws that have a response at this place; the quantiles are theirs, NaN if there is none
};

/// Phase angle at a measured frequency ratio, deg: M_phase(r, F_mu) + sigma_phase z (Eq. 23). Draws whose motion is not
/// continuous there have no response. With noise it may leave [0, 180], as measured phases do.
/// \param draws  of the posterior, not empty
/// \throws errors::InvalidValue for a ratio that response_constants() refuses, or if there is no draw.
[[nodiscard]] PredictiveBand phase_band(std::span<const PredictiveDraw> draws, double measured_ratio,
                                        const friction::Physics& physics);

/// Nominal frequency ratio at a driving frequency: omega_b / omega_n + sigma_r z (Eq. 24).
/// \throws errors::InvalidValue if there is no draw.
[[nodiscard]] PredictiveBand ratio_band(std::span<const PredictiveDraw> draws, double driving_frequency_hz);

/// P(new phase < observed), a number in (0, 1): the normal distribution function averaged over the draws that have a response
/// at this ratio, of the residual of an angle (friction::angle_residual_deg); NaN if none has. Of a calibrated prediction of
/// measurements that it has not seen, these are uniform.
/// \throws as phase_band
[[nodiscard]] double phase_probability(std::span<const PredictiveDraw> draws, double measured_ratio,
                                       double observed_deg, const friction::Physics& physics);

/// P(new nominal ratio < observed), as phase_probability. \throws as ratio_band
[[nodiscard]] double ratio_probability(std::span<const PredictiveDraw> draws, double driving_frequency_hz,
                                       double observed);

}  // namespace estimation
