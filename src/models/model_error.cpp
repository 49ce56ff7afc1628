#include "models/model_error.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"

namespace models {
namespace {

std::string coordinates(const std::vector<std::string>& names,
                        const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Index row) {
  std::string text;
  for (Eigen::Index j = 0; j < points.cols(); ++j) {
    text += fmt::format("{}{} = {}", j > 0 ? ", " : "", names[static_cast<std::size_t>(j)],
                        io::format_number(points(row, j)));
  }
  return text;
}

}  // namespace

std::string describe_point(const std::vector<std::string>& parameter_names,
                           const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Index row) {
  return fmt::format("point {} of {} ({})", row + 1, points.rows(),
                     coordinates(parameter_names, points, row));
}

std::string describe_first_point(const std::vector<std::string>& parameter_names,
                                 const Eigen::Ref<const Eigen::MatrixXd>& points) {
  return fmt::format("the first of {} points ({})", points.rows(), coordinates(parameter_names, points, 0));
}

void require_shape(const Eigen::Ref<const Eigen::MatrixXd>& points,
                   const Eigen::Ref<const Eigen::MatrixXd>& values, std::size_t d, std::size_t outputs) {
  const std::size_t columns = columns_of(outputs);
  if (points.cols() != static_cast<Eigen::Index>(d) || values.rows() != points.rows() ||
      values.cols() != static_cast<Eigen::Index>(columns)) {
    throw errors::InvalidValue("points",
                               fmt::format("{} x {} with {} x {} results", points.rows(), points.cols(),
                                           values.rows(), values.cols()),
                               fmt::format("{} columns, and {} results for each point", d, columns));
  }
}

bool is_admitted(double value, std::size_t outputs) {
  return outputs > 0 ? !std::isnan(value) : value < std::numeric_limits<double>::infinity();
}

std::string admitted(std::size_t outputs) {
  return outputs > 0 ? "a number, inf or -inf" : "a number or -inf";
}

void require_options(const std::vector<std::string>& parameter_names, double timeout_seconds) {
  if (parameter_names.empty()) {
    throw errors::InvalidValue("parameter_names", "", "at least one name");
  }
  if (!(timeout_seconds >= 0.0) || !std::isfinite(timeout_seconds)) {
    throw errors::InvalidValue("timeout_seconds", io::format_number(timeout_seconds),
                               "a finite number of at least 0");
  }
}

}  // namespace models
