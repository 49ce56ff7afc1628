/// \file
/// Effect of each reading of the paper on the printed numbers: the presets, and single changes to `as_published`.
#pragma once

#include <string>
#include <vector>

#include "replication/published.hpp"
#include "replication/reading.hpp"

namespace replication {

/// A reading that is tried on the printed numbers.
struct ReadingVariant {
  std::string name;            ///< of the preset, or what is changed
  Reading reading;             ///< complete
  bool random_ratios = false;  ///< the measured ratios are drawn anew in each study (Eq. 22)
};

/// The presets, and then each difference between text, scripts and mathematics changed alone in `as_published`.
/// \param samples  N of each run
[[nodiscard]] std::vector<ReadingVariant> reading_variants(tmcmc::Index samples);

/// Measured ratios drawn anew around the nominal ones (Eq. 22), with the standard deviation that the paper states. Where the
/// published script takes the ratios of the phase model from a column that is not in the paper, this stands for that column.
[[nodiscard]] friction::Observations with_random_ratios(friction::Observations observations,
                                                        std::uint64_t seed, std::uint32_t study);

/// Areas of the p-boxes of one parameter over studies, and the printed one among them.
struct AreaEffect {
  double median = 0.0;    ///< of the studies
  Interval95 interval{};  ///< central 95 % of them
  double p = 1.0;         ///< of the printed area, two-sided
};

/// What a reading makes of one sampler's numbers.
struct ReadingEffect {
  std::string sampler;             ///< whose studies
  AreaEffect force;                ///< F_mu, N
  AreaEffect frequency;            ///< omega_n, Hz
  double share_up_to_9 = 0.0;      ///< of runs, by their number of iterations
  double share_10 = 0.0;           ///< likewise
  double share_from_11 = 0.0;      ///< likewise
  double counts_p = 1.0;           ///< of the printed column of Table 4
  double mean_force_n = 0.0;       ///< over the studies, of the posterior means
  double mean_frequency_hz = 0.0;  ///< likewise
  double mean_log_evidence = 0.0;  ///< over the runs
  double log_likelihood = 0.0;     ///< of all printed tables under this reading: see log_likelihood_of_tables
};

/// One entry a sampler, in the order of the printed counts. Under each reading both samplers are one algorithm (N_eff of 500 or
/// 500.25): the studies of both are one null.
/// \throws errors::InvalidValue for fewer than 3 studies of a sampler or tables without both areas.
[[nodiscard]] std::vector<ReadingEffect> effects_of(const std::vector<StudySummary>& studies,
                                                    const std::vector<PrintedArea>& areas,
                                                    const std::vector<PrintedCounts>& counts,
                                                    const TableDraws& draws);

}  // namespace replication
