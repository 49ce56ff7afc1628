/// \file
/// Likelihood of friction force, natural frequency and the two noise levels (Eq. 24).
#pragma once

#include <Eigen/Core>
#include <limits>
#include <vector>

#include "friction/observations.hpp"
#include "friction/response.hpp"

namespace friction {

/// Column of each parameter in a matrix of points.
enum Parameter : int {
  /// F_mu, N.
  friction_force,
  /// omega_n, Hz.
  natural_frequency,
  /// sigma_phase, deg.
  phase_noise,
  /// sigma_r, dimensionless.
  frequency_ratio_noise,
  parameter_count
};

/// Batch log-likelihood of Eq. 24. It factorises into one part that depends on (F_mu, sigma_phase)
/// and one that depends on (omega_n, sigma_r); sums over the observations that do not depend on a
/// parameter are computed once, at construction. The residual of a phase is the residual of an
/// angle (angle_residual_deg). It is given a Normal density, which approximates the density of an
/// angle as long as sigma_phase is small against a half turn. Const members may be called
/// concurrently.
class Likelihood {
 public:
  /// \param infeasible_log_likelihood  value where the motion is not continuous for some
  ///        observation: minus infinity, or the penalty -1e10 of the published scripts.
  /// \throws errors::InvalidValue for invalid observations or physics.
  Likelihood(const Observations& observations, const Physics& physics,
             double infeasible_log_likelihood = -std::numeric_limits<double>::infinity());

  /// Log-likelihood of each point, in natural logarithms (normalised densities).
  /// \param points  n x 4, one column per parameter in the order of Parameter, noise levels and
  ///        frequency positive
  /// \param log_likelihood  n values, overwritten
  /// \throws errors::InvalidValue if the shapes do not match.
  void operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                  Eigen::Ref<Eigen::VectorXd> log_likelihood) const;

  /// Sum of squared phase residuals (angle_residual_deg), deg^2; NaN where the motion is not
  /// continuous.
  [[nodiscard]] double phase_misfit(double friction_force_n) const;

  /// Sum of squared residuals of the nominal frequency ratio.
  [[nodiscard]] double frequency_misfit(double natural_frequency_hz) const;

  /// Largest friction force, N, at which the motion is continuous for every observation.
  [[nodiscard]] double limit_friction_force_n() const { return limit_force_ratio_ * driving_force_n_; }

  /// Number of observations, n of Eq. 24.
  [[nodiscard]] std::size_t observation_count() const { return constants_.size(); }
  /// Amplitude k Y_b of the driving force, N, as given in the physics.
  [[nodiscard]] double driving_force_n() const { return driving_force_n_; }
  /// Value where the motion is not continuous for some observation, as given.
  [[nodiscard]] double infeasible_log_likelihood() const { return infeasible_log_likelihood_; }

 private:
  std::vector<ResponseConstants> constants_;
  std::vector<double> phase_deg_;
  double driving_force_n_;
  double infeasible_log_likelihood_;
  double limit_force_ratio_;
  // Sum of (r_nom - omega_b / omega_n)^2 = minimum + curvature (1/omega_n - best)^2
  double frequency_curvature_;
  double frequency_best_period_;
  double frequency_minimum_;
};

}  // namespace friction
