/// \file
/// Which settings of the sampler could have produced the printed columns? A search after the fact over each
/// column under each setting and over each pair of settings, and the result of a search over so many pairs
/// when there is nothing to find.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "replication/published.hpp"
#include "replication/reading.hpp"

namespace replication {

/// A way to run the sampler that the published scripts leave open, or nearly so.
struct Setting {
  std::string name;               ///< for tables and figures
  Reading reading;                ///< reading of all runs, or of the first half
  std::optional<Reading> second;  ///< of the second half, if stitched from files of two settings
};

/// Settings with 2 to 5 Metropolis steps per move, once with proposals outside the prior redrawn and once
/// with them rejected; with the population standard deviation; without the penalty; and two stitched sets.
/// The first setting is `as_published`.
/// \param samples  N of each run
[[nodiscard]] std::vector<Setting> forensic_settings(tmcmc::Index samples);

/// Studies of one setting, `count` of them from number 0, with streams of their own.
/// \param make_problem  the sampling problem of a reading
/// \param index  index of the setting, which selects the streams
/// \param after_each  called after each study
/// \throws as run_arm.
[[nodiscard]] std::vector<StudySummary> run_setting(
    const Setting& setting, const std::function<tmcmc::Problem(const Reading&)>& make_problem,
    std::uint32_t index, long count, StudyOptions options, const std::function<void()>& after_each);

/// A printed column under a setting.
struct ColumnFit {
  double log_density = 0.0;  ///< log predictive density of the column
  PValue p;                  ///< absolute: against the setting's own studies
};

/// One setting, its runs counted in one way.
struct SettingFit {
  std::string name;                ///< name of the setting
  int shift = 0;                   ///< added to each number of iterations; 1 if beta_0 was counted too
  std::vector<ColumnFit> columns;  ///< of the printed columns, in their order
};

/// The first printed column explained by one setting and the second by another.
struct PairFit {
  std::size_t first = 0;     ///< index of the setting of the first column
  std::size_t second = 0;    ///< index of the setting of the second column
  double log_density = 0.0;  ///< log predictive density of all printed numbers
  PValue p;                  ///< absolute: against pairs of studies of these settings
  double weight = 0.0;       ///< share of the likelihood over all pairs, which are equally likely a priori
};

/// Results of the search.
struct Forensics {
  std::vector<SettingFit> settings;  ///< shifts 0, 1 and -1 of each setting
  std::vector<PairFit> pairs;        ///< of settings without shift, row by row
  double gain = 0.0;  ///< log-density of the best pair over that of the first setting for both columns
  double number_of_pairs = 0.0;  ///< that were looked at: gain is worth less than its logarithm
  /// Probability that two columns made by the first setting alone have a best pair with at least this gain: the p-value of the
  /// search, corrected for the number of looks. Against the pairs of studies of the first setting.
  PValue search_p;
};

/// A number of the search or the name of a setting, as a row of a table.
struct SearchStatistic {
  std::string quantity;   ///< what the value is
  std::string value;      ///< number or name
  double standard_error;  ///< NaN unless the value is estimated by simulation
};

/// The numbers that the report quotes, with the best pair.
/// \param names  names of the settings
/// \param studies  number of studies of each setting other than the first
[[nodiscard]] std::vector<SearchStatistic> search_statistics(const Forensics& found,
                                                             const std::vector<std::string>& names,
                                                             long studies);

/// \param studies  studies of each setting, at least 3; the first setting is the one sampler with which the
///        search is compared
/// \param names  names of the settings
/// \throws errors::InvalidValue unless there are as many names as sets of studies, and two printed columns.
[[nodiscard]] Forensics compare_settings(const std::vector<std::vector<StudySummary>>& studies,
                                         const std::vector<std::string>& names,
                                         const std::vector<PrintedColumn>& printed);

}  // namespace replication
