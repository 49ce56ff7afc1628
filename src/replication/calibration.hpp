/// \file
/// Simulation-based calibration (Talts, Betancourt, Simpson, Vehtari and Gelman 2018): parameters
/// are drawn from the prior, and observations from the model at these parameters; over many such
/// pairs the rank of the true parameter among posterior draws is uniform if the sampler samples the
/// posterior.
#pragma once

#include <functional>
#include <vector>

#include "replication/reading.hpp"

namespace replication {

/// Size of a calibration, and its random streams.
struct CalibrationOptions {
  /// Simulated data sets.
  tmcmc::Index replications = 2000;
  /// Posterior draws among which the truth is ranked: evenly spaced rows of the final population,
  /// or, if its samples are weighted, multinomial draws from it.
  tmcmc::Index draws = 99;
  /// Bins of the rank histogram; must divide draws + 1.
  tmcmc::Index bins = 20;
  /// Seed of the simulated pairs and of the runs.
  std::uint64_t seed = 1;
  /// Number of threads over the replications.
  int threads = 1;

  /// \throws errors::InvalidValue naming field, value and constraint.
  void validate() const;
};

/// Ranks of the true parameters; see rank_histogram for their interpretation.
struct CalibrationResult {
  /// [parameter][replication], from 0 to draws.
  std::vector<std::vector<tmcmc::Index>> ranks;
  /// Runs that ended before beta = 1; ranked in their last population.
  tmcmc::Index unfinished = 0;
  /// Runs with a warning (Options::diagnose); they are ranked nevertheless.
  tmcmc::Index warned = 0;
};

/// Parameters drawn from the prior, and observations simulated with them: the nominal ratio and the
/// phase of each row of the design are drawn anew, while measured ratio and driving frequency stay.
/// Pairs without continuous motion or with a nominal ratio that is not positive are drawn again;
/// since the latter condition depends on the data alone, the ranks stay uniform.
struct SimulatedPair {
  /// The true parameters, in the order of friction::Parameter.
  Eigen::VectorXd parameters;
  /// Drawn from the model at these parameters.
  friction::Observations observations;
};
/// Simulated pair number `replication` of the seed.
/// \throws tmcmc::InfeasiblePriorError if none of 1000000 draws can be kept.
[[nodiscard]] SimulatedPair simulate_pair(const friction::Observations& design,
                                          const friction::Physics& physics, const tmcmc::BoxPrior& prior,
                                          std::uint64_t seed, std::uint32_t replication);

/// \param arm_index  arm of the random streams of the runs; the simulated pairs do not depend on it
/// \throws errors::InvalidValue for invalid options; also as simulate_pair and tmcmc::run.
[[nodiscard]] CalibrationResult calibrate(const friction::Observations& design, const Reading& reading,
                                          const tmcmc::BoxPrior& prior, const Arm& arm,
                                          std::uint32_t arm_index, const CalibrationOptions& options,
                                          const std::function<void()>& observer = {});

/// Rank histogram of one parameter, and tests of its uniformity.
struct RankHistogram {
  /// One entry per bin.
  std::vector<tmcmc::Index> counts;
  /// Chi-squared statistic of the counts, with bins - 1 degrees of freedom.
  double chi_squared = 0.0;
  /// Fraction of the truths inside the central 50 % of the draws.
  double coverage_50 = 0.0;
  /// Fraction of the truths inside the central 90 % of the draws.
  double coverage_90 = 0.0;
  /// p-value of chi_squared.
  double p_chi_squared = 1.0;
  /// Two-sided, from the binomial distribution.
  double p_coverage_50 = 1.0;
  /// Two-sided, from the binomial distribution.
  double p_coverage_90 = 1.0;
};
/// \param ranks  ranks from 0 to draws, at least one
/// \throws errors::InvalidValue for invalid options or a rank out of range.
[[nodiscard]] RankHistogram rank_histogram(const std::vector<tmcmc::Index>& ranks,
                                           const CalibrationOptions& options);

/// Data of a figure for one bin of a rank histogram, and for the ranks' distribution function at
/// its upper edge.
struct RankBin {
  /// Middle of the bin, in (0, 1).
  double place = 0.0;
  /// Ranks in the bin.
  tmcmc::Index count = 0;
  /// Expected count for uniform ranks.
  double expected = 0.0;
  /// 0.5 % quantile of the binomial distribution.
  double band_low = 0.0;
  /// 99.5 % quantile of the binomial distribution.
  double band_high = 0.0;
  /// Upper end of the bin, in (0, 1].
  double edge = 0.0;
  /// Share of the ranks below the edge, minus the edge.
  double ecdf_difference = 0.0;
  /// Uniform ranks: all differences at the edges of 20 bins lie within it with probability 99 %.
  double ecdf_band = 0.0;
};
/// The bins of a histogram, from low ranks to high ones.
[[nodiscard]] std::vector<RankBin> rank_bins(const RankHistogram& histogram);

/// Judgement of a sampler by the ranks of all parameters.
struct CalibrationVerdict {
  /// One per parameter.
  std::vector<RankHistogram> histograms;
  /// Over the three tests of each parameter, adjusted for their number (Holm 1979).
  double smallest_p = 1.0;
  /// Whether smallest_p is 0.01 or more.
  bool is_calibrated = false;
};
/// \throws errors::InvalidValue as rank_histogram.
[[nodiscard]] CalibrationVerdict judge_calibration(const CalibrationResult& result,
                                                   const CalibrationOptions& options);

}  // namespace replication
