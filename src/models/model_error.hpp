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

/// Refuses a batch of another shape than the model has.
/// \throws errors::InvalidValue unless points has d columns and as many rows as there are results.
void require_shape(const Eigen::Ref<const Eigen::MatrixXd>& points,
                   const Eigen::Ref<const Eigen::VectorXd>& log_likelihood, std::size_t d);

/// The parts of its options that every such model checks.
/// \throws errors::InvalidValue for no parameter, or for a time-out that is negative or not finite.
void require_options(const std::vector<std::string>& parameter_names, double timeout_seconds);

}  // namespace models
