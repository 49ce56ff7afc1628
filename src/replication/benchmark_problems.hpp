/// \file
/// Sampling problems whose evidence is known, for the sampler at large.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "replication/reading.hpp"
#include "tmcmc/sampler.hpp"

namespace replication {

/// A problem with what is known of its posterior.
struct BenchmarkProblem {
  std::string name;           ///< as the tables of benchmark_problems have it
  tmcmc::Problem problem;     ///< likelihood and prior box
  double log_evidence = 0.0;  ///< exact, the prior normalised
  bool tuned_on = true;       ///< the sampler's settings were chosen with this problem among others
  /// Where the posterior has separate modes: the number of the mode that a point belongs to.
  std::function<std::size_t(const Eigen::Ref<const Eigen::RowVectorXd>&)> mode_of = {};
  std::vector<double> mode_masses = {};  ///< posterior mass of each mode; empty for a posterior of one mode
  /// Log-likelihoods at or below it belong to excluded points: see tmcmc::Options.
  double infeasible_level = -std::numeric_limits<double>::infinity();
};

/// Posteriors in closed form or by quadrature:
///
/// - Gaussians in 2, 10, 20 and 50 dimensions, every correlation 0.7;
/// - a normal bent along a parabola in 2 and 6 dimensions (banana);
/// - two equal normals of masses 0.75 and 0.25 in 4 and 10 dimensions, 8 apart in each coordinate;
/// - five narrow normals of masses 1 : 2 : 3 : 4 : 5 in 2 and 6 dimensions;
/// - Neal's funnel (2003) in 5 dimensions;
/// - a ball of high likelihood on a plateau in 5 dimensions (a phase transition: Skilling 2006);
/// - a spike of nine tenths of the mass within a slab, 20 times as narrow, in 2 dimensions;
/// - a posterior in a corner of its box;
/// - the stiffnesses of a two-storey shear frame from its two natural frequencies, which two pairs of stiffnesses explain
///   (Beck and Au 2002; Ching and Chen 2007): from precise data of unknown noise, and under a prior a thousand times too wide;
/// - eight schools (Rubin 1981), with standardised effects.
[[nodiscard]] std::vector<BenchmarkProblem> closed_form_problems();

/// The frame of the above with precise data, the frame with wide priors, and eight schools.
[[nodiscard]] std::vector<BenchmarkProblem> structural_problems();

/// The friction posterior of a reading and of simulated rigs, whose parameters are drawn from the prior: simulate_pair()
/// number 0 to rigs - 1 of the seed. Evidence by quadrature (estimation::ExactPosterior).
/// \param name  of the reading, for the names of the problems
/// \throws as problem() and simulate_pair().
[[nodiscard]] std::vector<BenchmarkProblem> friction_problems(const std::string& name, const Reading& reading,
                                                              const friction::Observations& observations,
                                                              const tmcmc::BoxPrior& prior, int rigs,
                                                              std::uint64_t seed);

/// Two-storey shear frame: natural frequencies in Hz, ascending.
struct FrameFrequencies {
  double first;   ///< Hz, the lower one
  double second;  ///< Hz, the higher one
};
/// Square roots of the eigenvalues of M^-1 K over 2 pi, in closed form, of storeys with the given masses (kg) and interstorey
/// stiffnesses (N/m), ground floor first.
[[nodiscard]] FrameFrequencies shear_frame_frequencies(double mass_1, double mass_2, double stiffness_1,
                                                       double stiffness_2);

namespace detail {
/// A log-likelihood of single points, for a whole batch.
[[nodiscard]] tmcmc::LogLikelihood by_rows(std::function<double(const double*)> function);
/// Log-density of a normal of standard deviation sd at z standard deviations from its mean.
[[nodiscard]] double log_normal_density(double z, double sd);
}  // namespace detail

}  // namespace replication
