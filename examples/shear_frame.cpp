#include "shear_frame.hpp"

#include <cmath>
#include <numbers>

#include "io/csv.hpp"
#include "portable_math/elementary.hpp"

namespace examples {

namespace {

constexpr double floor_mass_kg = 16000.0;
constexpr double storey_stiffness_n_per_m = 3e7;
constexpr double log_2_pi = 1.8378770664093453;

}  // namespace

FrameObservations read_frame_observations(const std::string& path) {
  const auto table = io::CsvTable::read(path);
  table.require_columns({"mode", "frequency_hz"});
  FrameObservations result{table.integers("mode"), table.numbers("frequency_hz")};
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (result.mode[row] != 1 && result.mode[row] != 2) {
      table.fail(row, "mode", "1 or 2");
    }
    if (!(result.frequency_hz[row] > 0.0)) {
      table.fail(row, "frequency_hz", "a positive number");
    }
  }
  return result;
}

std::array<double, 2> frame_frequencies_hz(double stiffness_1, double stiffness_2) {
  const double unit = storey_stiffness_n_per_m / floor_mass_kg;
  const double half_sum = 0.5 * unit * (stiffness_1 + 2.0 * stiffness_2);
  const double product = unit * unit * stiffness_1 * stiffness_2;
  const double larger = half_sum + std::sqrt(half_sum * half_sum - product);
  const double to_hz = 0.5 / std::numbers::pi;
  return {to_hz * std::sqrt(product / larger), to_hz * std::sqrt(larger)};
}

const std::vector<std::string>& FrameLikelihood::parameter_names() {
  static const std::vector<std::string> names = {"stiffness_1", "stiffness_2", "relative_noise"};
  return names;
}

Eigen::MatrixXd FrameLikelihood::frequencies_hz(const Eigen::Ref<const Eigen::MatrixXd>& points) const {
  Eigen::MatrixXd result(points.rows(), static_cast<Eigen::Index>(observations_.mode.size()));
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const auto model = frame_frequencies_hz(points(i, 0), points(i, 1));
    for (Eigen::Index k = 0; k < result.cols(); ++k) {
      const long mode = observations_.mode[static_cast<std::size_t>(k)];
      result(i, k) = model[static_cast<std::size_t>(mode - 1)];
    }
  }
  return result;
}

Eigen::MatrixXd FrameLikelihood::pointwise(const Eigen::Ref<const Eigen::MatrixXd>& points) const {
  Eigen::MatrixXd result = frequencies_hz(points);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double noise = points(i, 2);
    for (Eigen::Index k = 0; k < result.cols(); ++k) {
      const double frequency = result(i, k);
      const double measured = observations_.frequency_hz[static_cast<std::size_t>(k)];
      const double residual = (measured / frequency - 1.0) / noise;
      result(i, k) = -(0.5 * (log_2_pi + residual * residual) + portable_math::log(noise * frequency));
    }
  }
  return result;
}

void FrameLikelihood::operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                                 Eigen::Ref<Eigen::VectorXd> log_likelihood) const {
  const Eigen::MatrixXd terms = pointwise(points);
  log_likelihood.setZero();
  for (Eigen::Index k = 0; k < terms.cols(); ++k) {  // in the order of the observations
    log_likelihood += terms.col(k);
  }
}

}  // namespace examples
