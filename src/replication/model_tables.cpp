#include "replication/model_tables.hpp"

#include "replication/columns.hpp"

namespace replication {

namespace {

/// Values of one of the four parameters. The squares of the noise levels must be positive doubles.
std::vector<double> parameter(const io::CsvTable& table, std::size_t p) {
  const std::string& column = parameter_columns[p];
  if (p == friction::friction_force) {
    return nonnegative_numbers(table, column);
  }
  if (p == friction::natural_frequency) {
    return positive_numbers(table, column);
  }
  return checked(
      table, column, table.numbers(column), [](double x) { return x > 1e-100 && x < 1e100; },
      "a number between 1e-100 and 1e100");
}

}  // namespace

Phases phases(const io::CsvTable& table, const friction::Physics& physics) {
  const auto force = nonnegative_numbers(table, "friction_force_n");
  const auto ratio = positive_numbers(table, "frequency_ratio");
  Phases result;
  for (std::size_t row = 0; row < force.size(); ++row) {
    if (friction::is_singular_ratio(ratio[row])) {
      table.fail(row, "frequency_ratio",
                 "a ratio other than 1, 1/3, 1/5, ..., where the response is unbounded");
    }
    if (!(ratio[row] > 1e-4 && ratio[row] < 1e6)) {
      table.fail(row, "frequency_ratio", "a ratio between 1e-4 and 1e6");
    }
    const auto constants = friction::response_constants(ratio[row], physics);
    result.phase_deg.push_back(friction::phase_deg(constants, force[row] / physics.driving_force_n));
    result.limit_force_ratio.push_back(constants.limit_force_ratio);
  }
  return result;
}

std::vector<double> log_likelihoods(const io::CsvTable& table, const friction::Likelihood& likelihood) {
  Eigen::MatrixXd points(static_cast<Eigen::Index>(table.rows()), friction::parameter_count);
  for (std::size_t j = 0; j < parameter_columns.size(); ++j) {
    const auto values = parameter(table, j);
    points.col(static_cast<Eigen::Index>(j)) =
        Eigen::Map<const Eigen::VectorXd>(values.data(), points.rows());
  }
  Eigen::VectorXd result(points.rows());
  likelihood(points, result);
  return {result.begin(), result.end()};
}

}  // namespace replication
