/// \file
/// Sampling problems with known evidence, for testing the sampler in general.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "replication/reading.hpp"
#include "tmcmc/sampler.hpp"

namespace replication {

/// A problem with the known properties of its posterior.
struct BenchmarkProblem {
  /// Name of the problem in the tables of benchmark_problems.
  std::string name;
  /// Likelihood and prior box.
  tmcmc::Problem problem;
  /// Exact, for the normalised prior.
  double log_evidence = 0.0;
  /// Whether this problem was among those used to choose the sampler's settings.
  bool tuned_on = true;
  /// For a posterior with separate modes: the number of the mode to which a point belongs.
  std::function<std::size_t(const Eigen::Ref<const Eigen::RowVectorXd>&)> mode_of = {};
  /// Posterior mass of each mode; empty for a posterior of one mode.
  std::vector<double> mode_masses = {};
  /// Points with log-likelihoods at or below this level are excluded: see tmcmc::Options.
  double infeasible_level = -std::numeric_limits<double>::infinity();
};

/// Problems whose posterior is known in closed form or by quadrature:
///
/// - Gaussians in 2, 10, 20 and 50 dimensions, every correlation 0.7;
/// - a normal bent along a parabola in 2 and 6 dimensions (banana);
/// - two equal normals of masses 0.75 and 0.25 in 4 and 10 dimensions, 8 apart in each coordinate;
/// - five narrow normals of masses 1 : 2 : 3 : 4 : 5 in 2 and 6 dimensions;
/// - Neal's funnel (2003) in 5 dimensions;
/// - a ball of high likelihood on a plateau in 5 dimensions (a phase transition: Skilling 2006);
///  - a spike with nine tenths of the mass within a slab, 20 times as narrow as the slab, in 2
///    dimensions;
/// - a posterior in a corner of its box;
///  - the stiffnesses of a two-storey shear frame given its two natural frequencies, which two
///    pairs of stiffnesses explain (Beck and Au 2002; Ching and Chen 2007): with precise data of
///    unknown noise, and under a prior a thousand times too wide;
/// - eight schools (Rubin 1981), with standardised effects.
[[nodiscard]] std::vector<BenchmarkProblem> closed_form_problems();

/// The frame of the list above with precise data, the frame with wide priors, and eight schools.
[[nodiscard]] std::vector<BenchmarkProblem> structural_problems();

/// The friction posterior of a reading for simulated rigs, whose parameters are drawn from the
/// prior by simulate_pair(), numbers 0 to rigs - 1 of the seed. The evidence is computed by
/// quadrature (estimation::ExactPosterior).
/// \param name  name of the reading, used in the names of the problems
/// \throws as problem() and simulate_pair().
[[nodiscard]] std::vector<BenchmarkProblem> friction_problems(const std::string& name, const Reading& reading,
                                                              const friction::Observations& observations,
                                                              const tmcmc::BoxPrior& prior, int rigs,
                                                              std::uint64_t seed);

/// Two-storey shear frame: natural frequencies in Hz, ascending.
struct FrameFrequencies {
  /// Hz, the lower one.
  double first;
  /// Hz, the higher one.
  double second;
};
/// Square roots of the eigenvalues of M^-1 K over 2 pi, in closed form, for storeys with the given
/// masses (kg) and interstorey stiffnesses (N/m), ground floor first.
[[nodiscard]] FrameFrequencies shear_frame_frequencies(double mass_1, double mass_2, double stiffness_1,
                                                       double stiffness_2);

namespace detail {
/// Turns a log-likelihood of single points into one for a whole batch.
[[nodiscard]] tmcmc::LogLikelihood by_rows(std::function<double(const double*)> function);
/// Log-density of a normal distribution with standard deviation sd, at z standard deviations from
/// its mean.
[[nodiscard]] double log_normal_density(double z, double sd);
}  // namespace detail

}  // namespace replication
