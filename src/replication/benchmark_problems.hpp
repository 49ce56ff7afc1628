/// \file
/// Sampling problems whose evidence and marginal distributions are known, for the sampler at large.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tmcmc/sampler.hpp"

namespace replication {

/// A problem with what is known of its posterior.
struct BenchmarkProblem {
  std::string name;           ///< as the tables of benchmark_problems have it
  tmcmc::Problem problem;     ///< likelihood and prior box
  double log_evidence = 0.0;  ///< exact, the prior normalised
  /// P(parameter <= x) of the posterior.
  std::function<double(tmcmc::Index parameter, double x)> marginal_cdf;
  /// Where the posterior has two separate modes: whether a point belongs to the first, and the posterior mass of that.
  std::function<bool(const Eigen::Ref<const Eigen::RowVectorXd>&)> in_first_mode;
  double first_mode_mass = 1.0;  ///< exact; 1 for a posterior of one mode
  tmcmc::Options
      options;  ///< the recommended ones, with budget, samples, chains and cross_fit as the problem asks for
};

/// Linear-Gaussian posteriors in 2, 10 and 50 dimensions (correlation 0.5^|i-j|), a mixture of two normals of unequal mass
/// and width in 2 dimensions, a banana (a normal bent along a parabola), a posterior against a corner of the box, and the
/// stiffnesses of a two-storey shear frame from its two natural frequencies, which two pairs of stiffnesses explain (Beck
/// and Au 2002; Ching and Chen 2007). Evidence and marginals are in closed form, those of the frame by quadrature.
[[nodiscard]] std::vector<BenchmarkProblem> benchmark_problems();

/// Two-storey shear frame: natural frequencies in Hz, ascending, of storeys with the given masses (kg) and interstorey
/// stiffnesses (N/m), ground floor first.
struct FrameFrequencies {
  double first;   ///< Hz, the lower one
  double second;  ///< Hz, the higher one
};
/// Square roots of the eigenvalues of M^-1 K over 2 pi, in closed form.
[[nodiscard]] FrameFrequencies shear_frame_frequencies(double mass_1, double mass_2, double stiffness_1,
                                                       double stiffness_2);

}  // namespace replication
