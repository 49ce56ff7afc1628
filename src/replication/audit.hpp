/// \file
/// Audit of a table of observations: do they agree with the truth and the noise levels stated for
/// them?
#pragma once

#include <string>
#include <vector>

#include "estimation/least_squares.hpp"
#include "replication/synthetic.hpp"

namespace replication {

/// One value x of the friction force (N) or the natural frequency (Hz), tested against n
/// observations with misfit S(x), a sum of squared residuals whose minimum, S_min, is at the
/// least-squares estimate. All numbers are NaN unless the motion is continuous at every
/// observation.
struct PointTest {
  /// x, N or Hz.
  double value = 0.0;
  /// S(x) / sigma^2, sigma as stated.
  double chi_squared = 0.0;
  /// Probability of a larger value, chi^2 with n degrees of freedom.
  double chi_squared_p = 0.0;
  /// (S(x) - S_min) / sigma^2: twice the log-likelihood ratio for known sigma.
  double likelihood_ratio = 0.0;
  /// chi^2 with 1 degree of freedom.
  double likelihood_ratio_p = 0.0;
  /// (n - 1) (S(x) - S_min) / S_min, which orders x in the same way as the likelihood ratio for
  /// unknown sigma; NaN unless the residuals determine sigma (estimation::FittedNoise).
  double f_statistic = 0.0;
  /// F with 1 and n - 1 degrees of freedom.
  double f_p = 0.0;
};

/// 95 % confidence interval: the values around the estimate that a test at the 5 % level does not
/// reject. If the test rejects no value before the bound of the fit, that end is the bound, and it
/// is marked.
struct ConfidenceInterval {
  /// N or Hz.
  double lower = 0.0;
  /// N or Hz.
  double upper = 0.0;
  /// Lower is the bound of the fit.
  bool lower_at_bound = false;
  /// Upper is the bound of the fit.
  bool upper_at_bound = false;
};

/// Least squares of one parameter, its goodness of fit with the stated noise, and tests of other
/// values.
struct ParameterAudit {
  /// Least squares.
  double estimate = 0.0;
  /// sigma.
  double noise_stated = 0.0;
  /// Whether the residuals determine sigma.
  estimation::FittedNoise fitted_noise{};
  /// sqrt(S_min / (n - 1)); NaN unless residuals determine sigma.
  double noise_unbiased = 0.0;
  /// S_min / sigma^2.
  double chi_squared = 0.0;
  /// n - 1 degrees of freedom; NaN for n = 1.
  double chi_squared_p = 0.0;
  /// 95 % interval by the likelihood ratio with sigma as stated.
  ConfidenceInterval noise_known_95;
  /// 95 % interval by the F test; NaN unless the residuals determine sigma.
  ConfidenceInterval noise_unknown_95;
  /// Tests of single values, in the order stated in Audit.
  std::vector<PointTest> tests;
};

/// Results of testing the table against its own stated truth; vectors have one entry per
/// observation.
struct Audit {
  /// omega_b - r omega_n.
  std::vector<double> frequency_difference_hz;
  /// (r - r_nom) / sigma_r.
  std::vector<double> ratio_residual;
  /// Sum of squares of ratio_residual: the errors of Eq. 22.
  double ratio_chi_squared = 0.0;
  /// chi^2 with n degrees of freedom.
  double ratio_chi_squared_p = 0.0;
  /// (phase - model) / sigma_phase at the stated friction force
  std::vector<double> phase_residual_truth;
  /// The same at the alternative friction force.
  std::vector<double> phase_residual_alternative;
  /// tests: stated truth, then alternative.
  ParameterAudit friction_force;
  /// tests: stated truth.
  ParameterAudit natural_frequency;
};

/// \param truth  the stated values; both noise levels positive
/// \param alternative_n  another friction force to test, N
/// \throws errors::InvalidValue for invalid observations or physics, or for noise levels that are
///         not positive; std::runtime_error if least squares does not converge.
[[nodiscard]] Audit audit(const friction::Observations& observations, const Truth& truth,
                          double alternative_n, const friction::Physics& physics);

/// One line of the audit table: a value of a parameter and its goodness of fit.
struct AuditLine {
  /// One of parameter_columns.
  std::string parameter;
  /// "least squares", "stated truth" or "alternative".
  std::string hypothesis;
  /// Noise level as stated, as in ParameterAudit.
  double noise_stated;
  /// Noise level from the residuals, as in ParameterAudit.
  double noise_unbiased;
  /// For least squares without probabilities of the likelihood ratio and F.
  PointTest test;
  /// Interval around the least-squares estimate; NaN in the other lines.
  ConfidenceInterval noise_known_95;
  /// Interval around the least-squares estimate; NaN in the other lines.
  ConfidenceInterval noise_unknown_95;
};

/// For each parameter the least-squares estimate, then the values that were tested.
[[nodiscard]] std::vector<AuditLine> audit_lines(const Audit& audit);

}  // namespace replication
