/// \file
/// Measurements of the rig, and synthetic ones with known truth (Eqs. 22-23).
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace friction {

/// Measured pairs of frequency ratio and phase angle (Table 1); all vectors have one entry per data
/// set.
struct Observations {
  /// r_nom, commanded frequency ratio.
  std::vector<double> nominal_ratio;
  /// r, enters the phase model.
  std::vector<double> measured_ratio;
  /// omega_b.
  std::vector<double> driving_frequency_hz;
  /// Measured phase angle, positive where the response lags.
  std::vector<double> phase_deg;

  /// Number of data sets.
  [[nodiscard]] std::size_t size() const { return nominal_ratio.size(); }

  /// \throws errors::InvalidValue, naming field, row (from 0) and value, unless there is at least
  ///         one row, all vectors have the same length, ratios and frequencies are positive, phases
  ///         lie within one turn of 0 (largest_phase_deg), and no measured ratio is singular.
  void validate() const;
};

/// States what makes the unit or the sign of a column of at least three phases doubtful, and how
/// the phases are read: values that all lie within 2 pi of 0 look like radians, and values that are
/// all negative look like leads. Empty if nothing is doubtful.
[[nodiscard]] std::string doubtful_unit_or_sign(const std::vector<double>& phase_deg);

}  // namespace friction
