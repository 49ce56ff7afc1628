/// \file
/// Measurements of the rig, and synthetic ones with known truth (Eqs. 22-23).
#pragma once

#include <cstddef>
#include <vector>

namespace friction {

/// Measured pairs of frequency ratio and phase angle (Table 1); all vectors have one entry a data set.
struct Observations {
  std::vector<double> nominal_ratio;         ///< r_nom, commanded frequency ratio
  std::vector<double> measured_ratio;        ///< r, enters the phase model
  std::vector<double> driving_frequency_hz;  ///< omega_b
  std::vector<double> phase_deg;             ///< measured phase angle

  /// Number of data sets.
  [[nodiscard]] std::size_t size() const { return nominal_ratio.size(); }

  /// \throws std::invalid_argument naming field, row (from 0) and value unless there is at least one row, all
  ///        vectors have one length, ratios and frequencies are positive, phases finite, and no measured ratio
  ///        singular.
  void validate() const;
};

}  // namespace friction
