/// \file
/// Models whose outputs are compared with measurements.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "tmcmc/types.hpp"

namespace models {

/// A batch of points (n x d, a row per point) and the model's outputs (n x m, overwritten). No output is NaN; an infinite one excludes
/// its point.
using ForwardModel =
    std::function<void(const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::MatrixXd> outputs)>;

/// Measurements with independent Gaussian errors.
struct GaussianData {
  std::vector<double> observations;         ///< y, in the order of the model's outputs
  std::vector<double> standard_deviations;  ///< sigma, one for each observation, of the same unit
  /// The column of the points by which every sigma is multiplied, a positive parameter that the model does not see; none: sigma is
  /// known.
  std::optional<Eigen::Index> noise_column = {};

  /// \throws errors::InvalidValue for no observation, for numbers of them that differ, values that are not finite, or sigma <= 0.
  void validate() const;
  /// sum_k -((y_k - m_k) / (c sigma_k))^2 / 2 - log(c sigma_k) - log(2 pi) / 2; minus infinity for an m_k that is infinite.
  /// \param outputs  m, as many as there are observations
  /// \param noise  c, positive; minus infinity for another
  [[nodiscard]] double log_likelihood(const Eigen::Ref<const Eigen::VectorXd>& outputs,
                                      double noise = 1.0) const;
};

/// The same model for points that have the column of the noise too, which it does not see.
/// \param noise_column  GaussianData::noise_column; none: the model as it is
[[nodiscard]] ForwardModel without_noise(ForwardModel model, std::optional<Eigen::Index> noise_column);

/// The log-likelihood of the data under a model with as many outputs as there are observations.
/// \throws errors::InvalidValue as GaussianData::validate().
[[nodiscard]] tmcmc::LogLikelihood gaussian_likelihood(ForwardModel model, GaussianData data);

}  // namespace models
