/// \file
/// Models whose outputs are compared with measurements.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <vector>

#include "tmcmc/types.hpp"

namespace models {

/// The model as a function of a batch of points (n x d, one row per point) and its outputs (n x m,
/// overwritten). No output may be NaN; an infinite output excludes its point.
using ForwardModel =
    std::function<void(const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::MatrixXd> outputs)>;

/// Measurements with independent Gaussian errors.
struct GaussianData {
  /// y, in the order of the model's outputs.
  std::vector<double> observations;
  /// sigma, one for each observation, in the same unit.
  std::vector<double> standard_deviations;
  /// Column of the points that holds a positive factor of every sigma, a parameter that the model
  /// does not see; none if the sigmas are known.
  std::optional<Eigen::Index> noise_column = {};

  /// \throws errors::InvalidValue if there are no observations, if the numbers of observations and
  ///         standard deviations differ, if a value is not finite, or if sigma <= 0.
  void validate() const;
  /// sum_k -((y_k - m_k) / (c sigma_k))^2 / 2 - log(c sigma_k) - log(2 pi) / 2; minus infinity if
  /// an m_k is infinite.
  /// \param outputs  m, as many as there are observations
  /// \param noise  c, positive; for other values the result is minus infinity
  [[nodiscard]] double log_likelihood(const Eigen::Ref<const Eigen::VectorXd>& outputs,
                                      double noise = 1.0) const;
};

/// The model as a function of points that also have the column of the noise, which the model does
/// not see.
/// \param noise_column  GaussianData::noise_column; none: the model is returned as it is
[[nodiscard]] ForwardModel without_noise(ForwardModel model, std::optional<Eigen::Index> noise_column);

/// The log-likelihood of the data under a model with as many outputs as there are observations.
/// \throws errors::InvalidValue as GaussianData::validate().
[[nodiscard]] tmcmc::LogLikelihood gaussian_likelihood(ForwardModel model, GaussianData data);

}  // namespace models
