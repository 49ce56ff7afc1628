/// \file
/// The printed Tables 3 and 4 against replicated studies.
#pragma once

#include <optional>

#include "replication/replication.hpp"
#include "replication/verdict.hpp"
#include "statistics/deviance_test.hpp"

namespace replication {

using statistics::category_probabilities;
using statistics::Counts;
using statistics::DevianceTest;
using statistics::log_multinomial;
using statistics::TableDraws;
using statistics::test_tables;
using statistics::test_two_tables;
using statistics::total_of;

/// Number of an area: which parameter's.
struct PrintedArea {
  std::string sampler;    ///< whose column
  std::size_t parameter;  ///< index into StudySummary::areas
  std::string printed;    ///< as printed, for its rounding
};

/// A printed column of Table 4.
struct PrintedCounts {
  std::string sampler;  ///< whose column
  Counts counts;        ///< number of runs by number of iterations
};

/// Which studies are the null distribution of a sampler's printed numbers.
enum class Null {
  own_studies,  ///< those of the sampler alone
  all_studies   ///< those of both samplers, where they are one algorithm: twice the draws
};

/// Margins within which two samplers are equivalent: ratios of median areas, and of mean iterations.
constexpr double area_margin = 0.10;
/// Margin of the ratio of mean iterations.
constexpr double iteration_margin = 0.02;

/// A printed number in its null distribution.
struct CellVerdict {
  std::string sampler;                         ///< as printed
  std::size_t parameter = 0;                   ///< index into StudySummary::areas
  double printed = 0.0;                        ///< the area as printed
  double median = 0.0;                         ///< of the null studies
  Interval95 interval{};                       ///< central 95 % of the null studies
  PValue p;                                    ///< two-sided
  PValue p_holm;                               ///< over all cells judged together
  Typicality number = Typicality::reproduced;  ///< judged by p_holm
};

/// The printed Table 4: the deviance of all its columns, which are independent runs, and the distribution of tables of as
/// many runs. One table is one verdict; the columns alone are for information, and not adjusted.
struct CountsVerdict {
  DevianceTest test;                           ///< of all columns together
  PValue p_holm;                               ///< adjusted with the areas
  Typicality number = Typicality::reproduced;  ///< judged by p_holm
  std::vector<DevianceTest> columns;           ///< in the order given
};

/// Comparison of two samplers in one quantity.
struct ContrastVerdict {
  double printed = 0.0;      ///< ratio of areas, or two-sample deviance of counts
  Interval95 interval{};     ///< central 95 % of the null
  PValue p;                  ///< of the printed contrast if both samplers are one algorithm
  Equivalence replicated{};  ///< second sampler over first: medians of areas, or of mean iterations
};

/// Verdicts on the printed numbers, adjusted together.
struct PublishedVerdicts {
  std::vector<CellVerdict> areas;       ///< in the order given
  std::optional<CountsVerdict> counts;  ///< none if no counts were given
};

/// Each printed area and the table of counts against replicated studies; Holm's adjustment over all of them.
/// \throws errors::InvalidValue if there is no study of a sampler.
[[nodiscard]] PublishedVerdicts judge_tables(const std::vector<StudySummary>& studies,
                                             const std::vector<PrintedArea>& areas,
                                             const std::vector<PrintedCounts>& counts, Null null,
                                             const TableDraws& draws = {});

/// all_studies if the replicated studies of the two samplers are equivalent (TOST at 5 % a side: the bootstrap intervals of
/// the ratios lie within the margins) in the areas of the first two parameters and in the number of iterations; else
/// own_studies. For the paper's criteria the reason to pool is algebra: N_eff = N/2 is CoV = 1 with the population standard
/// deviation, and with that of N - 1 it is CoV = 1 at N_eff = 500.25 of 1000. This function refuses studies for which
/// that does not hold, N/4 for instance.
/// \throws errors::InvalidValue if there is no study of a sampler.
[[nodiscard]] Null null_of(const std::vector<StudySummary>& studies, const std::string& first,
                           const std::string& second, std::uint64_t seed);

/// Ratio of the areas of two samplers, second over first, against the null that they are one algorithm: all pairs of
/// studies, of either sampler, are equally likely.
[[nodiscard]] ContrastVerdict contrast_areas(const std::vector<StudySummary>& studies,
                                             const std::string& first, const std::string& second,
                                             std::size_t parameter, double printed_ratio, std::uint64_t seed);

/// Iteration counts of two samplers: two-sample deviance against that of two tables of one algorithm, whose
/// probabilities come from the runs of both; and equivalence of the studies' mean numbers of iterations.
[[nodiscard]] ContrastVerdict contrast_iterations(const std::vector<StudySummary>& studies,
                                                  const Counts& first_printed, const Counts& second_printed,
                                                  const std::string& first, const std::string& second,
                                                  std::uint64_t seed, const TableDraws& draws = {});

/// log of the density of printed areas (Normal in the logarithms of the areas of one study, both parameters and their
/// correlation) and of the probability of the printed counts, under the studies given.
/// \throws errors::InvalidValue for fewer than 3 studies, or other than one or two areas a sampler.
[[nodiscard]] double log_likelihood_of_tables(const std::vector<StudySummary>& studies,
                                              const std::vector<PrintedArea>& areas,
                                              const std::vector<PrintedCounts>& counts, Null null);

/// Studies of one sampler, in the order given.
/// \throws errors::InvalidValue if there is none.
[[nodiscard]] std::vector<StudySummary> studies_of(const std::vector<StudySummary>& studies,
                                                   const std::string& sampler);

/// The studies that are the null distribution of a sampler's numbers.
/// \throws as studies_of.
[[nodiscard]] std::vector<StudySummary> null_studies(const std::vector<StudySummary>& studies,
                                                     const std::string& sampler, Null null);

/// Mean number of iterations of a study.
[[nodiscard]] double mean_iterations(const Counts& counts);

}  // namespace replication
