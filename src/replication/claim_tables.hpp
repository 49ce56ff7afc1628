/// \file
/// Tables that the verdicts on claims rest on.
#pragma once

#include <string>
#include <vector>

#include "replication/run_worth.hpp"

namespace replication {

/// The claims in the order of their file.
struct ClaimTable {
  std::vector<std::string> ids,  ///< C1, C2, ...
      places,                    ///< where the paper says it
      texts;                     ///< what it says
};

/// Claims in columns id, place and claim: each that has a judge, once.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] ClaimTable read_claims(const std::string& path);

/// Over the runs of a study, as sampling_study writes them: rank correlation of the iterations with
/// the distance of the mean friction force from the exact one.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] RankCorrelation iterations_and_error(const std::string& path, double exact_mean_n);

/// Median of a column of positive numbers.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] double median_of_column(const std::string& path, const std::string& column);

}  // namespace replication
