/// \file
/// The predictive distribution of the printed tables under one setting of a sampler: a density, and
/// how often the setting's own studies are as improbable.
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

/// Logarithm of the predictive density of a column, in two parts. Their sum ignores the dependence
/// between the parts, which is present in the studies with which the sum is compared.
struct LogDensity {
  /// Normal in the logarithms of the areas, with the moments and the correlation of the studies.
  double areas = 0.0;
  /// Multinomial, with the shares of all runs of the studies.
  double counts = 0.0;

  /// Log-density of the whole column.
  [[nodiscard]] double both() const { return areas + counts; }
};

/// The prediction of one setting, from replicated studies of it.
class Prediction {
 public:
  /// \param studies  studies of the setting, at least 3, each with at least two areas
  /// \param categories  numbers of iterations that must have a probability, whether or not a run
  ///        took that many
  /// \throws errors::InvalidValue for fewer studies, or areas that are not positive or all equal.
  Prediction(const std::vector<StudySummary>& studies, const Counts& categories);

  /// Log-density of a column.
  /// \throws errors::InvalidValue for a number of iterations without probability.
  [[nodiscard]] LogDensity log_density(std::span<const double> areas, const Counts& counts) const;

  /// Log-density of each study, in the order given.
  [[nodiscard]] const std::vector<LogDensity>& of_studies() const { return of_studies_; }

 private:
  // mean of the logarithms of the areas
  std::array<double, 2> mean_{};
  std::array<double, 2> standard_deviation_{};
  double correlation_ = 0.0;
  // probability of each number of iterations
  std::map<std::int64_t, double> probabilities_;
  std::vector<LogDensity> of_studies_;
};

/// Absolute predictive p-value of one column: the share of the setting's own studies that are at
/// most as probable as the column, where the column itself counts as one of them.
/// \param scores  log-densities of the studies, not empty
/// \param printed  log-density of the printed column
[[nodiscard]] PValue predictive_p(std::span<const double> scores, double printed);

/// Absolute predictive p-value of two columns made by one setting: the share of all pairs of its
/// studies whose log-densities add up to at most that of the printed pair. The standard error is
/// that of a U-statistic, by Hoeffding's projection.
/// \param scores  log-densities of at least two studies
[[nodiscard]] PValue predictive_p_of_pair(std::span<const double> scores, double printed);

/// Absolute predictive p-value of two columns made by two settings: over all pairs of a study of
/// the first setting and one of the second.
[[nodiscard]] PValue predictive_p_of_pair(std::span<const double> first, std::span<const double> second,
                                          double printed);

/// One part of the log-density of each study.
[[nodiscard]] std::vector<double> scores_of(const Prediction& prediction, double (*part)(const LogDensity&));

}  // namespace replication
