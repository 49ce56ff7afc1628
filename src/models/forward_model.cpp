#include "models/forward_model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "errors/invalid_value.hpp"
#include "portable_math/elementary.hpp"

namespace models {

void GaussianData::validate() const {
  if (observations.empty() || standard_deviations.size() != observations.size()) {
    throw errors::InvalidValue(
        "standard_deviations", standard_deviations.size(),
        fmt::format("one for each of {} observations, at least one", observations.size()));
  }
  for (std::size_t k = 0; k < observations.size(); ++k) {
    if (!std::isfinite(observations[k])) {
      throw errors::InvalidValue(fmt::format("observations[{}]", k), observations[k], "a finite number");
    }
    if (!(standard_deviations[k] > 0.0) || !std::isfinite(standard_deviations[k])) {
      throw errors::InvalidValue(fmt::format("standard_deviations[{}]", k), standard_deviations[k],
                                 "a positive, finite number");
    }
  }
}

double GaussianData::log_likelihood(const Eigen::Ref<const Eigen::VectorXd>& outputs, double noise) const {
  if (!(noise > 0.0)) {
    return -std::numeric_limits<double>::infinity();
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const double sigma = noise * standard_deviations[k];
    const double residual = (observations[k] - outputs[static_cast<Eigen::Index>(k)]) / sigma;
    sum -= 0.5 * residual * residual + portable_math::log(sigma);
  }
  return sum - 0.5 * static_cast<double>(observations.size()) * portable_math::log(2.0 * std::numbers::pi);
}

ForwardModel without_noise(ForwardModel model, std::optional<Eigen::Index> noise_column) {
  if (!noise_column) {
    return model;
  }
  return [model = std::move(model), noise = *noise_column](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                                           Eigen::Ref<Eigen::MatrixXd> outputs) {
    const Eigen::Index after = points.cols() - noise - 1;
    Eigen::MatrixXd seen(points.rows(), points.cols() - 1);
    seen << points.leftCols(noise), points.rightCols(after);
    model(seen, outputs);
  };
}

tmcmc::LogLikelihood gaussian_likelihood(ForwardModel model, GaussianData data) {
  data.validate();
  model = without_noise(std::move(model), data.noise_column);
  return [model = std::move(model), data = std::move(data)](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                                            Eigen::Ref<Eigen::VectorXd> values) {
    Eigen::MatrixXd outputs(points.rows(), static_cast<Eigen::Index>(data.observations.size()));
    model(points, outputs);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      values[i] = data.log_likelihood(outputs.row(i).transpose(),
                                      data.noise_column ? points(i, *data.noise_column) : 1.0);
    }
  };
}

}  // namespace models
