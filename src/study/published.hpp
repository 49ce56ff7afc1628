/// \file
/// The printed Tables 3 and 4 against replicated studies.
#pragma once

#include "study/replication.hpp"
#include "study/verdict.hpp"

namespace study {

/// Number of an area: which parameter's.
struct PrintedArea {
  std::string sampler;
  std::size_t parameter;  ///< index into StudySummary::areas
  std::string printed;    ///< as printed, for its rounding
};

struct PrintedCounts {
  std::string sampler;
  Counts counts;
};

/// A printed number, or a column of Table 4, in its null distribution.
struct CellVerdict {
  std::string sampler;
  std::size_t parameter = 0;
  double printed = 0.0;
  double median = 0.0;
  Interval95 interval{};
  double p = 1.0;          ///< two-sided for an area
  double p_holm = 1.0;     ///< over all cells judged together
  bool reproduced = true;  ///< p_holm at or above significance_level
};

/// Deviance of a printed column of Table 4, and its distribution.
struct CountsVerdict {
  std::string sampler;
  double statistic = 0.0;
  double critical = 0.0;  ///< 95 % quantile of the null
  double p = 1.0;
  double p_holm = 1.0;
  bool reproduced = true;
};

/// Comparison of two samplers in one quantity.
struct ContrastVerdict {
  double printed = 0.0;   ///< ratio of areas, or two-sample deviance of counts
  Interval95 interval{};  ///< central 95 % of the null
  double p = 1.0;
  Equivalence replicated{};  ///< second sampler over first: medians of areas, or of mean iterations
};

struct PublishedVerdicts {
  std::vector<CellVerdict> areas;
  std::vector<CountsVerdict> counts;
};

/// Each printed number against the studies of its own sampler; Holm's adjustment over areas and counts together.
/// \throws std::invalid_argument if there is no study of a sampler.
[[nodiscard]] PublishedVerdicts judge_tables(const std::vector<StudySummary>& studies,
                                             const std::vector<PrintedArea>& areas,
                                             const std::vector<PrintedCounts>& counts);

/// Ratio of the areas of two samplers, second over first, against the null that they are one algorithm: in each study
/// the ratio and its inverse are equally likely.
/// \param margin  of the equivalence test
[[nodiscard]] ContrastVerdict contrast_areas(const std::vector<StudySummary>& studies,
                                             const std::string& first, const std::string& second,
                                             std::size_t parameter, double printed_ratio, double margin,
                                             std::uint64_t seed);

/// Iteration counts of two samplers: two-sample deviance against that of the replicated pairs, and equivalence of the
/// studies' mean numbers of iterations.
[[nodiscard]] ContrastVerdict contrast_iterations(const std::vector<StudySummary>& studies,
                                                  const Counts& first_printed, const Counts& second_printed,
                                                  const std::string& first, const std::string& second,
                                                  double margin, std::uint64_t seed);

/// log of the density of printed areas (Normal in the logarithms of the areas of one study, both parameters and their
/// correlation) and of the probability of the printed counts, under the studies given.
/// \param parameters  the areas that were printed
[[nodiscard]] double log_likelihood_of_tables(const std::vector<StudySummary>& studies,
                                              const std::vector<PrintedArea>& areas,
                                              const std::vector<PrintedCounts>& counts);

/// Studies of one sampler, in the order given.
[[nodiscard]] std::vector<StudySummary> studies_of(const std::vector<StudySummary>& studies,
                                                   const std::string& sampler);

/// Mean number of iterations of a study.
[[nodiscard]] double mean_iterations(const Counts& counts);

}  // namespace study
