/// \file
/// The failure of a model that is another program, with the point that it failed at.
#pragma once

#include <Eigen/Core>
#include <stdexcept>
#include <string>
#include <vector>

namespace models {

/// A call that gave no log-likelihoods. what() is one line: the program or server, what it did, and the point.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A point for a message: "point 3 of 100 (stiffness_1 = 0.9, stiffness_2 = 1.2)".
/// \param parameter_names  one for each column of the points
/// \param row  from 0
[[nodiscard]] std::string describe_point(const std::vector<std::string>& parameter_names,
                                         const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Index row);

/// The point that stands for a whole batch: "the first of 100 points (stiffness_1 = 0.9, stiffness_2 = 1.2)".
[[nodiscard]] std::string describe_first_point(const std::vector<std::string>& parameter_names,
                                               const Eigen::Ref<const Eigen::MatrixXd>& points);

/// Columns of what a model fills: one for each of its outputs, or one for the log-likelihood of a model without.
[[nodiscard]] constexpr std::size_t columns_of(std::size_t outputs) {
  return outputs > 0 ? outputs : 1;
}

/// Refuses a batch of another shape than the model has.
/// \param outputs  of each point; 0: its log-likelihood
/// \throws errors::InvalidValue unless points has d columns, and values as many rows and columns_of(outputs) columns.
void require_shape(const Eigen::Ref<const Eigen::MatrixXd>& points,
                   const Eigen::Ref<const Eigen::MatrixXd>& values, std::size_t d, std::size_t outputs);

/// Whether a model may give this value: as a log-likelihood a number or minus infinity, as an output all but NaN.
[[nodiscard]] bool is_admitted(double value, std::size_t outputs);

/// What is_admitted asks for, to complete "expected ...".
[[nodiscard]] std::string admitted(std::size_t outputs);

/// The parts of its options that every such model checks.
/// \throws errors::InvalidValue for no parameter, or for a time-out that is negative or not finite.
void require_options(const std::vector<std::string>& parameter_names, double timeout_seconds);

}  // namespace models
