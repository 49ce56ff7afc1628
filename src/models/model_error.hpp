/// \file
/// The failure of a model that is an external program or server, with the point at which it failed.
#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>
#include <vector>

namespace models {

/// Thrown by a call that gave no log-likelihoods. what() is one line: the program or server, what
/// it did, and the point.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Description of a point for a message: "point 3 of 100 (stiffness_1 = 0.9, stiffness_2 = 1.2)".
/// \param parameter_names  one name for each column of the points
/// \param row  row of the point, from 0
[[nodiscard]] std::string describe_point(const std::vector<std::string>& parameter_names,
                                         const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Index row);

/// Description of the point that represents a whole batch:
/// "the first of 100 points (stiffness_1 = 0.9, stiffness_2 = 1.2)".
[[nodiscard]] std::string describe_first_point(const std::vector<std::string>& parameter_names,
                                               const Eigen::Ref<const Eigen::MatrixXd>& points);

/// Number of columns that a model fills: one for each output, or one for the log-likelihood if it
/// has no outputs.
[[nodiscard]] constexpr std::size_t columns_of(std::size_t outputs) {
  return outputs > 0 ? outputs : 1;
}

/// Refuses a batch whose shape does not fit the model.
/// \param outputs  number of outputs per point; 0: the model returns the log-likelihood
/// \throws errors::InvalidValue unless points has d columns, and values has as many rows as points
///         and columns_of(outputs) columns.
void require_shape(const Eigen::Ref<const Eigen::MatrixXd>& points,
                   const Eigen::Ref<const Eigen::MatrixXd>& values, std::size_t d, std::size_t outputs);

/// Whether a model may return this value: a log-likelihood must be finite or minus infinity, an
/// output anything but NaN.
[[nodiscard]] bool is_admitted(double value, std::size_t outputs);

/// The values that is_admitted accepts, to complete "expected ...".
[[nodiscard]] std::string admitted(std::size_t outputs);

/// Checks the options that all such models share.
/// \throws errors::InvalidValue if there is no parameter, or if the time-out is negative or not
///         finite.
void require_options(const std::vector<std::string>& parameter_names, double timeout_seconds);

}  // namespace models
