/// \file
/// Deterministic baseline: least squares of the phases in F_mu and of the nominal ratios in
/// omega_n.
#pragma once

#include <string>
#include <vector>

#include "friction/observations.hpp"
#include "friction/response.hpp"

namespace estimation {

/// Noise levels used for the standard errors, and settings of the search for the global minimum.
struct LeastSquaresOptions {
  /// sigma_phase, deg (Eq. 23); for standard errors and chi^2 only.
  double phase_noise_deg = 2.0;
  /// sigma_r (Eq. 22); for standard errors and chi^2 only.
  double frequency_ratio_noise = 0.01;
  /// Starting points, equidistant inside the bounds; from 1 to 1000.
  int starts = 8;
  /// Starts whose estimates differ by at most this fraction of the width of the bounds count as
  /// having found the same minimum; from 1e-10 to 0.1.
  double agreement_tolerance = 1e-7;
  /// Iterations of one start, at least 1.
  int max_iterations = 200;

  /// \throws errors::InvalidValue if a field is out of its range.
  void validate() const;
};

/// Whether the residuals of a fit determine a noise level.
enum class FittedNoise {
  /// sqrt(SS / n).
  determined,
  /// n = 1: the estimate takes the only degree of freedom.
  one_observation,
  /// sqrt(SS / n) is at most 1e-9 of the largest observed value, the accuracy of the estimate.
  perfect_fit
};

/// Why a noise level is determined or not, as part of a sentence.
[[nodiscard]] const char* describe(FittedNoise noise);

/// One weighted fit of n residuals with one unknown x, in N or Hz; residuals are in deg or
/// dimensionless.
struct BlockFit {
  /// Global minimum among the starts.
  double estimate = 0.0;
  /// Lower bound of x.
  double lower = 0.0;
  /// Upper bound of x.
  double upper = 0.0;
  /// Within agreement_tolerance of a bound: the standard errors then mean little.
  bool at_bound = false;

  /// Observed minus model, unweighted.
  std::vector<double> residuals;
  /// SS, sum of squared residuals.
  double sum_of_squares = 0.0;
  /// sigma as given in the options.
  double noise_given = 0.0;
  /// If not determined, what depends on it is NaN.
  FittedNoise fitted_noise = FittedNoise::determined;
  /// sqrt(SS / n), the maximum-likelihood sigma; NaN unless fitted_noise is determined.
  double noise_ml = 0.0;
  /// Standard error of the estimate with noise_given, from ceres::Covariance (Gauss-Newton, bounds
  /// ignored); NaN if the model does not depend on x at the estimate.
  double standard_error = 0.0;
  /// The same with noise_ml; NaN where noise_ml is NaN.
  double standard_error_ml = 0.0;
  /// SS / noise_given^2.
  double chi_squared = 0.0;
  /// chi_squared / (n - 1); NaN for n = 1.
  double reduced_chi_squared = 0.0;
  /// -n/2 (log(2 pi noise_ml^2) + 1), this block's part of the maximum log-likelihood; NaN where
  /// noise_ml is NaN.
  double log_likelihood = 0.0;

  /// Standard error of a noise level sigma that is estimated from the residuals: the Fisher
  /// information of a normal standard deviation is 2 n / sigma^2.
  [[nodiscard]] double standard_error_of_noise(double sigma) const;

  /// Starts that were run.
  int starts = 0;
  /// Starts that converged to the estimate.
  int agreed = 0;
  /// Starts that did not converge.
  int failed = 0;
  /// Local minima that the converged starts found, including the estimate.
  int distinct_minima = 0;
  /// Iterations of the start that found the estimate.
  int iterations = 0;
  /// Ceres' message for that start.
  std::string termination;
};

/// Both fits; Eq. 24 factorises into the two blocks.
struct LeastSquaresFit {
  /// F_mu, N, and sigma_phase.
  BlockFit friction_force;
  /// omega_n, Hz, and sigma_r.
  BlockFit natural_frequency;

  /// Log-likelihood of Eq. 24 at its maximum over all four parameters; NaN unless both noise levels
  /// are determined.
  [[nodiscard]] double log_likelihood() const {
    return friction_force.log_likelihood + natural_frequency.log_likelihood;
  }
};

/// Minimises, independently and with Ceres (Levenberg-Marquardt, automatic derivatives),
///
///     sum_n (phase_n - phase_deg(r_n, F_mu))^2 / sigma_phase^2   over 0 <= F_mu <= limit of continuous motion,
///     sum_n (r_nom,n - omega_b,n / omega_n)^2 / sigma_r^2        over half the least to twice the largest
///                                                                omega_b,n / r_nom,n,
///
/// where the limit is the smallest over the observations, and the second interval contains the
/// minimiser for any data. The estimates do not depend on the noise levels and are accurate to
/// about 1e-9 relative if the minimum is well conditioned; their last digits depend on the C
/// library. The function writes nothing to the streams.
/// \throws errors::InvalidValue for invalid observations, physics or options; std::runtime_error if
///         no start converges.
[[nodiscard]] LeastSquaresFit fit_least_squares(const friction::Observations& observations,
                                                const friction::Physics& physics,
                                                const LeastSquaresOptions& options = {});

}  // namespace estimation
