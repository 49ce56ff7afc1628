/// \file
/// Tables on which the verdicts on claims are based.
#pragma once

#include <string>
#include <vector>

#include "replication/run_worth.hpp"

namespace replication {

/// The claims in the order of their file.
struct ClaimTable {
  /// C1, C2, ...
  std::vector<std::string> ids;
  /// Where the paper makes the claim.
  std::vector<std::string> places;
  /// What the claim says.
  std::vector<std::string> texts;
};

/// Reads claims from the columns id, place and claim; each claim that has a judge must occur once.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] ClaimTable read_claims(const std::string& path);

/// Rank correlation, over the runs of a study as written by sampling_study, of the number of
/// iterations with the distance between the run's mean friction force and the exact mean.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] RankCorrelation iterations_and_error(const std::string& path, double exact_mean_n);

/// Median of a column of positive numbers.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] double median_of_column(const std::string& path, const std::string& column);

}  // namespace replication
