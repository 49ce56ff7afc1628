// The model at given points: phase angle (Eq. 21) and limit of continuous motion (Eq. 18) for points of
// friction force and frequency ratio, log-likelihood (Eq. 24) for points of the four parameters.
//
// Data: the reader's points; for the log-likelihood the measurements of Table 1 or the reader's own.

#include <algorithm>

#include "inputs.hpp"

using namespace experiments;

namespace {

/// One of the four parameters. The squares of the noise levels have to be positive doubles.
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

struct Phases {
  std::vector<double> phase_deg, limit_force_ratio;
};

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

}  // namespace

int main(int argc, char** argv) {
  Program program(
      "evaluate_model",
      "Model values at points. Columns friction_force_n and frequency_ratio give phase_deg (nan where the\n"
      "motion is not continuous) and limit_force_ratio; the four columns friction_force_n,\n"
      "natural_frequency_hz, phase_noise_deg and frequency_ratio_noise give log_likelihood. Other columns\n"
      "are passed on.");
  InputFiles inputs;
  PhysicsOptions physics;
  std::string points;
  program.add_required_input("--points", points, "Points: CSV");
  program.add_output("CSV: the points with the results added", "-");
  inputs.add_observations_to(program);
  physics.add_to(program);

  return program.run(argc, argv, [&] {
    const auto reading = physics.reading();
    const auto table = io::CsvTable::read(points);
    const bool with_phase = table.has("frequency_ratio");
    const bool with_likelihood = std::all_of(parameter_columns.begin(), parameter_columns.end(),
                                             [&](const std::string& name) { return table.has(name); });
    if (!with_phase && !with_likelihood) {
      table.require_columns({"friction_force_n"});
      if (table.column_names().size() <= 2) {
        table.require_columns({"frequency_ratio"});
      }
      table.require_columns({"natural_frequency_hz", "phase_noise_deg", "frequency_ratio_noise"});
    }
    std::vector<std::string> columns;
    for (const auto& name : table.column_names()) {
      const bool replaced = (with_phase && (name == "phase_deg" || name == "limit_force_ratio")) ||
                            (with_likelihood && name == "log_likelihood");
      if (!replaced) {
        columns.push_back(name);
      }
    }
    const std::vector<std::string> kept = columns;
    Phases phase_columns;
    std::vector<double> log_likelihood;
    if (with_phase) {
      phase_columns = phases(table, reading.physics);
      columns.insert(columns.end(), {"phase_deg", "limit_force_ratio"});
    }
    if (with_likelihood) {
      log_likelihood =
          log_likelihoods(table, friction::Likelihood(read_observations(inputs.observations), reading.physics,
                                                      reading.infeasible_log_likelihood));
      columns.push_back("log_likelihood");
    }
    io::CsvWriter csv(program.output(), columns);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      std::vector<std::string> cells;
      for (const auto& name : kept) {
        cells.emplace_back(table.cell(row, name));
      }
      if (with_phase) {
        cells.push_back(io::format_number(phase_columns.phase_deg[row]));
        cells.push_back(io::format_number(phase_columns.limit_force_ratio[row]));
      }
      if (with_likelihood) {
        cells.push_back(io::format_number(log_likelihood[row]));
      }
      csv.row(cells);
    }
    csv.commit();
    if (program.output() != "-") {
      program.report("{} points, reading {}: {}\n", table.rows(), physics.reading_name, program.output());
    }
  });
}
