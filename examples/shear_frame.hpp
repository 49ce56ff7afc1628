/// \file
/// A two-storey shear frame whose storey stiffnesses are inferred from measured natural
/// frequencies, in the manner of Beck and Au (2002): the default model of own_model, to be replaced
/// by the reader's own.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace examples {

/// Measured natural frequencies, one entry per measurement.
struct FrameObservations {
  /// Number of the mode, 1 or 2.
  std::vector<long> mode;
  /// Frequency in Hz, positive.
  std::vector<double> frequency_hz;
};

/// Reads a CSV with columns mode and frequency_hz.
/// \throws io::InputError naming file, line, column and value.
[[nodiscard]] FrameObservations read_frame_observations(const std::string& path);

/// Natural frequencies in Hz, ascending, of floors of 16000 kg on storeys of 3e7 N/m times the
/// multipliers: the roots of m^2 w^4 - m (k1 + 2 k2) w^2 + k1 k2 = 0.
[[nodiscard]] std::array<double, 2> frame_frequencies_hz(double stiffness_1, double stiffness_2);

/// Log-likelihood of storey stiffnesses and noise: each measured frequency is Normal around the
/// frequency of the model, with a standard deviation of relative_noise times the latter.
class FrameLikelihood {
 public:
  /// Names of the columns of the points.
  static const std::vector<std::string>& parameter_names();

  explicit FrameLikelihood(FrameObservations observations) : observations_(std::move(observations)) {}

  /// \param points  n x 3, multipliers of the storey stiffnesses and relative noise, all positive
  /// \param log_likelihood  n, overwritten
  void operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                  Eigen::Ref<Eigen::VectorXd> log_likelihood) const;

  /// Log-likelihood of each single observation: n x observations, whose rows add up to the values
  /// above.
  [[nodiscard]] Eigen::MatrixXd pointwise(const Eigen::Ref<const Eigen::MatrixXd>& points) const;

  /// Natural frequencies of the model, Hz, with which the observations are compared: n x
  /// observations.
  [[nodiscard]] Eigen::MatrixXd frequencies_hz(const Eigen::Ref<const Eigen::MatrixXd>& points) const;

  [[nodiscard]] const FrameObservations& observations() const { return observations_; }

 private:
  FrameObservations observations_;
};

}  // namespace examples
