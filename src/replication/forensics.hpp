/// \file
/// Which settings of the sampler could have produced the printed columns? A search after the fact
/// over each column under each setting and over each pair of settings, and the result of a search
/// over so many pairs when there is nothing to find.
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
  /// For tables and figures.
  std::string name;
  /// Reading of all runs, or of the first half.
  Reading reading;
  /// Reading of the second half, if the runs are stitched from files of two settings.
  std::optional<Reading> second;
};

/// Settings with 2 to 5 Metropolis steps per move, once with proposals outside the prior redrawn
/// and once with them rejected; with the population standard deviation; without the penalty; and
/// two stitched sets. The first setting is `as_published`.
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
  /// log predictive density of the column.
  double log_density = 0.0;
  /// Absolute: against the setting's own studies.
  PValue p;
};

/// One setting, its runs counted in one way.
struct SettingFit {
  /// Name of the setting.
  std::string name;
  /// Added to each number of iterations; 1 if beta_0 was counted too.
  int shift = 0;
  /// Fits of the printed columns, in their order.
  std::vector<ColumnFit> columns;
};

/// The first printed column explained by one setting and the second by another.
struct PairFit {
  /// Index of the setting of the first column.
  std::size_t first = 0;
  /// Index of the setting of the second column.
  std::size_t second = 0;
  /// log predictive density of all printed numbers.
  double log_density = 0.0;
  /// Absolute: against pairs of studies of these settings.
  PValue p;
  /// Share of the likelihood over all pairs, which are equally likely a priori.
  double weight = 0.0;
};

/// Results of the search.
struct Forensics {
  /// Shifts 0, 1 and -1 of each setting.
  std::vector<SettingFit> settings;
  /// Pairs of settings without shift, row by row.
  std::vector<PairFit> pairs;
  /// Log-density of the best pair over that of the first setting for both columns.
  double gain = 0.0;
  /// Number of pairs that were looked at: the gain is worth less than its logarithm.
  double number_of_pairs = 0.0;
  /// Probability that two columns made by the first setting alone have a best pair with at least
  /// this gain: the p-value of the search, corrected for the number of looks. Against the pairs of
  /// studies of the first setting.
  PValue search_p;
};

/// A number of the search or the name of a setting, as a row of a table.
struct SearchStatistic {
  /// Name of the value.
  std::string quantity;
  /// Number or name.
  std::string value;
  /// NaN unless the value is estimated by simulation.
  double standard_error;
};

/// The numbers that the report quotes, with the best pair.
/// \param names  names of the settings
/// \param studies  number of studies of each setting other than the first
[[nodiscard]] std::vector<SearchStatistic> search_statistics(const Forensics& found,
                                                             const std::vector<std::string>& names,
                                                             long studies);

/// \param studies  studies of each setting, at least 3; the first setting is the one sampler with
///        which the search is compared
/// \param names  names of the settings
/// \throws errors::InvalidValue unless there are as many names as sets of studies, and two printed
///         columns.
[[nodiscard]] Forensics compare_settings(const std::vector<std::vector<StudySummary>>& studies,
                                         const std::vector<std::string>& names,
                                         const std::vector<PrintedColumn>& printed);

}  // namespace replication
