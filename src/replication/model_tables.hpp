/// \file
/// Outputs of the model at the points of a table.
#pragma once

#include <vector>

#include "friction/likelihood.hpp"
#include "io/csv.hpp"

namespace replication {

/// Phase angle (Eq. 21), NaN where the motion is not continuous, and limit of continuous motion
/// (Eq. 18), one row per point.
struct Phases {
  /// Phase angles in degrees.
  std::vector<double> phase_deg;
  /// Limits of continuous motion as multiples of the driving force.
  std::vector<double> limit_force_ratio;
};

/// Phases and limits at the points in the columns friction_force_n and frequency_ratio.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] Phases phases(const io::CsvTable& table, const friction::Physics& physics);

/// Log-likelihoods (Eq. 24) at the points in the columns parameter_columns.
/// \throws as phases.
[[nodiscard]] std::vector<double> log_likelihoods(const io::CsvTable& table,
                                                  const friction::Likelihood& likelihood);

}  // namespace replication
