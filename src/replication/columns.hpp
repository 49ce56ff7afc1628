/// \file
/// Columns of the replication's tables: their names, and checks of their contents.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/csv_checks.hpp"

namespace replication {

/// Names of the four parameters in columns of generated files, in the order of friction::Parameter,
/// with units.
inline const std::vector<std::string> parameter_columns = {"friction_force_n", "natural_frequency_hz",
                                                           "phase_noise_deg", "frequency_ratio_noise"};

using io::checked;
using io::require_once;

/// The numbers of a column, all of which must be positive.
/// \throws as io::checked.
[[nodiscard]] std::vector<double> positive_numbers(const io::CsvTable& table, std::string_view column);

/// The numbers of a column, none of which may be negative.
/// \throws as io::checked.
[[nodiscard]] std::vector<double> nonnegative_numbers(const io::CsvTable& table, std::string_view column);

/// The integers of a column, all of which must be at least 1.
/// \throws as io::checked.
[[nodiscard]] std::vector<long> positive_integers(const io::CsvTable& table, std::string_view column);

/// Refuses a second row of the same run; uses the columns sampler and run.
/// \throws as io::checked.
void require_runs_once(const io::CsvTable& table);

}  // namespace replication
