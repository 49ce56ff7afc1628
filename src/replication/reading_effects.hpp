/// \file
/// Effect of each reading of the paper on the printed numbers: the presets, and single changes to
/// `as_published`.
#pragma once

#include <string>
#include <vector>

#include "replication/published.hpp"
#include "replication/reading.hpp"

namespace replication {

/// A reading whose effect on the printed numbers is examined.
struct ReadingVariant {
  /// Name of the preset, or of the change.
  std::string name;
  /// The complete reading.
  Reading reading;
  /// Whether the measured ratios are drawn anew in each study (Eq. 22).
  bool random_ratios = false;
};

/// The presets, and then `as_published` with each difference between text, scripts and mathematics
/// changed on its own.
/// \param samples  N of each run
[[nodiscard]] std::vector<ReadingVariant> reading_variants(tmcmc::Index samples);

/// Measured ratios drawn anew around the nominal ones (Eq. 22), with the standard deviation that
/// the paper states. The published script takes the ratios of the phase model from a column that is
/// not in the paper; these ratios stand for that column.
[[nodiscard]] friction::Observations with_random_ratios(friction::Observations observations,
                                                        std::uint64_t seed, std::uint32_t study);

/// Areas of the p-boxes of one parameter over studies, and the printed area among them.
struct AreaEffect {
  /// Median of the studies.
  double median = 0.0;
  /// Central 95 % of the studies.
  Interval95 interval{};
  /// Two-sided p-value of the printed area.
  double p = 1.0;
};

/// The numbers of one sampler under a reading.
struct ReadingEffect {
  /// Sampler of the studies.
  std::string sampler;
  /// F_mu, N.
  AreaEffect force;
  /// omega_n, Hz.
  AreaEffect frequency;
  /// Share of runs with at most 9 iterations.
  double share_up_to_9 = 0.0;
  /// Share of runs with 10 iterations.
  double share_10 = 0.0;
  /// Share of runs with at least 11 iterations.
  double share_from_11 = 0.0;
  /// p-value of the printed column of Table 4.
  double counts_p = 1.0;
  /// Mean over the studies of the posterior means.
  double mean_force_n = 0.0;
  /// Mean over the studies of the posterior means.
  double mean_frequency_hz = 0.0;
  /// Mean over the runs.
  double mean_log_evidence = 0.0;
  /// Log-likelihood of all printed tables (log_likelihood_of_tables).
  double log_likelihood = 0.0;
};

/// One entry per sampler, in the order of the printed counts. Under each reading both samplers are
/// one algorithm (N_eff of 500 or 500.25), so the studies of both form one null distribution.
/// \throws errors::InvalidValue for fewer than 3 studies of a sampler, or for tables without both
///         areas.
[[nodiscard]] std::vector<ReadingEffect> effects_of(const std::vector<StudySummary>& studies,
                                                    const std::vector<PrintedArea>& areas,
                                                    const std::vector<PrintedCounts>& counts,
                                                    const TableDraws& draws);

}  // namespace replication
