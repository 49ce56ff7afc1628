/// \file
/// Simulation-based calibration (Talts, Betancourt, Simpson, Vehtari and Gelman 2018): parameters are drawn from the prior
/// and observations from the model at these; over many such pairs the rank of the true parameter among posterior draws is
/// uniform if the sampler samples the posterior.
#pragma once

#include <functional>
#include <vector>

#include "replication/reading.hpp"

namespace replication {

/// Size of a calibration, and its random streams.
struct CalibrationOptions {
  tmcmc::Index replications = 2000;  ///< simulated data sets
  tmcmc::Index draws =
      99;  ///< posterior draws that the truth is ranked among: evenly spaced rows of the final population, or, where its samples are weighted, drawn from them (multinomial)
  tmcmc::Index bins = 20;  ///< of the rank histogram; has to divide draws + 1
  std::uint64_t seed = 1;  ///< of the simulated pairs and of the runs
  int threads = 1;         ///< over the replications

  /// \throws errors::InvalidValue naming field, value and constraint.
  void validate() const;
};

/// Ranks of the truths; see rank_histogram for what they say.
struct CalibrationResult {
  std::vector<std::vector<tmcmc::Index>> ranks;  ///< [parameter][replication], from 0 to draws
  tmcmc::Index unfinished =
      0;                    ///< runs that ended before beta = 1; their last population is ranked all the same
  tmcmc::Index warned = 0;  ///< runs with a warning (Options::diagnose); ranked all the same
};

/// Parameters from the prior, and observations from them: the nominal ratio and the phase of each row of the
/// design are drawn anew, measured ratio and driving frequency stay. Pairs without continuous motion or with a nominal ratio
/// that is not positive are drawn again; since the latter depends on the data alone, the ranks stay uniform.
struct SimulatedPair {
  Eigen::VectorXd parameters;           ///< in the order of friction::Parameter
  friction::Observations observations;  ///< drawn from the model at these
};
/// Pair number `replication` of the seed.
/// \throws tmcmc::InfeasiblePriorError if none of 1000000 draws is one to keep.
[[nodiscard]] SimulatedPair simulate_pair(const friction::Observations& design,
                                          const friction::Physics& physics, const tmcmc::BoxPrior& prior,
                                          std::uint64_t seed, std::uint32_t replication);

/// \param arm_index  of the random streams of the runs; the simulated pairs do not depend on it
/// \throws errors::InvalidValue for invalid options; as simulate_pair and tmcmc::run.
[[nodiscard]] CalibrationResult calibrate(const friction::Observations& design, const Reading& reading,
                                          const tmcmc::BoxPrior& prior, const Arm& arm,
                                          std::uint32_t arm_index, const CalibrationOptions& options,
                                          const std::function<void()>& observer = {});

/// Rank histogram of one parameter, and how far it is from uniform.
struct RankHistogram {
  std::vector<tmcmc::Index> counts;  ///< one entry a bin
  double chi_squared = 0.0;          ///< with bins - 1 degrees of freedom
  double coverage_50 = 0.0;          ///< fraction of the truths inside the central 50 % of the draws
  double coverage_90 = 0.0;          ///< likewise, of the central 90 %
  double p_chi_squared = 1.0;        ///< of chi_squared
  double p_coverage_50 = 1.0;        ///< two-sided, of the binomial distribution
  double p_coverage_90 = 1.0;        ///< likewise
};
/// \param ranks  from 0 to draws, at least one
/// \throws errors::InvalidValue for invalid options or a rank out of range.
[[nodiscard]] RankHistogram rank_histogram(const std::vector<tmcmc::Index>& ranks,
                                           const CalibrationOptions& options);

/// What a figure shows of one bin of a rank histogram, and of the ranks' distribution function at its upper edge.
struct RankBin {
  double place = 0.0;            ///< middle of the bin, in (0, 1)
  tmcmc::Index count = 0;        ///< ranks in it
  double expected = 0.0;         ///< of uniform ranks
  double band_low = 0.0;         ///< 0.5 % quantile of the binomial distribution
  double band_high = 0.0;        ///< 99.5 % quantile
  double edge = 0.0;             ///< upper end of the bin, in (0, 1]
  double ecdf_difference = 0.0;  ///< share of the ranks below the edge, less the edge
  double ecdf_band =
      0.0;  ///< the differences of uniform ranks stay within it at all edges of 20 bins, with a probability of 99 %
};
/// The bins of a histogram, from low ranks to high ones.
[[nodiscard]] std::vector<RankBin> rank_bins(const RankHistogram& histogram);

/// What the ranks of all parameters say of a sampler.
struct CalibrationVerdict {
  std::vector<RankHistogram> histograms;  ///< one a parameter
  double smallest_p = 1.0;  ///< of the three tests of each parameter, adjusted for their number (Holm 1979)
  bool is_calibrated = false;  ///< smallest_p is 0.01 or more
};
/// \throws errors::InvalidValue as rank_histogram.
[[nodiscard]] CalibrationVerdict judge_calibration(const CalibrationResult& result,
                                                   const CalibrationOptions& options);

}  // namespace replication
