/// \file
/// What one setting of a sampler predicts for the printed tables: a density, and how often its own studies are as improbable.
#pragma once

#include <array>
#include <map>
#include <span>
#include <vector>

#include "replication/replication.hpp"
#include "replication/verdict.hpp"
#include "statistics/counts.hpp"

namespace replication {

using statistics::category_probabilities;
using statistics::Counts;
using statistics::log_multinomial;

/// Logarithm of the predictive density of a column, in two parts. Their sum leaves their dependence out, which is in
/// the studies that the sum is compared with.
struct LogDensity {
  double areas =
      0.0;  ///< Normal in the logarithms of the areas, with the moments and the correlation of the studies
  double counts = 0.0;  ///< multinomial, with the shares of all runs of the studies

  /// Of the whole column.
  [[nodiscard]] double both() const { return areas + counts; }
};

/// The prediction of one setting, from replicated studies of it.
class Prediction {
 public:
  /// \param studies  of the setting, at least 3, each with at least two areas
  /// \param categories  numbers of iterations that have to have a probability, whether a run took so many or not
  /// \throws errors::InvalidValue for fewer studies, or areas that are not positive or all equal.
  Prediction(const std::vector<StudySummary>& studies, const Counts& categories);

  /// Log-density of a column. \throws errors::InvalidValue for a number of iterations without probability.
  [[nodiscard]] LogDensity log_density(std::span<const double> areas, const Counts& counts) const;

  /// That of each study, in the order given.
  [[nodiscard]] const std::vector<LogDensity>& of_studies() const { return of_studies_; }

 private:
  std::array<double, 2> mean_{};  // of the logarithms of the areas
  std::array<double, 2> standard_deviation_{};
  double correlation_ = 0.0;
  std::map<std::int64_t, double> probabilities_;  // of numbers of iterations
  std::vector<LogDensity> of_studies_;
};

/// Absolute predictive p-value of one column: the share of the setting's own studies that are at most as probable, the column
/// itself counted as one of them.
/// \param scores  log-densities of the studies, not empty
/// \param printed  log-density of what was printed
[[nodiscard]] PValue predictive_p(std::span<const double> scores, double printed);

/// The same of two columns that one setting made: the share of all pairs of its studies whose log-densities add up to at most that of
/// the printed pair. The standard error is that of a U-statistic by Hoeffding's projection.
/// \param scores  of at least two studies
[[nodiscard]] PValue predictive_p_of_pair(std::span<const double> scores, double printed);

/// The same of two columns that two settings made: all pairs of a study of the first and one of the second.
[[nodiscard]] PValue predictive_p_of_pair(std::span<const double> first, std::span<const double> second,
                                          double printed);

/// One part of the density of each study.
[[nodiscard]] std::vector<double> scores_of(const Prediction& prediction, double (*part)(const LogDensity&));

}  // namespace replication
