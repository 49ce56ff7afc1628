// The model at given points: phase angle (Eq. 21) and limit of continuous motion (Eq. 18) for points of
// friction force and frequency ratio, log-likelihood (Eq. 24) for points of the four parameters.
//
// Data: the reader's points; for the log-likelihood the observations of Table 1 or the reader's own.

#include <algorithm>

#include "inputs.hpp"
#include "replication/model_tables.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app(
      "Model values at points. Columns friction_force_n and frequency_ratio give phase_deg (nan where the\n"
      "motion is not continuous) and limit_force_ratio; the four columns friction_force_n,\n"
      "natural_frequency_hz, phase_noise_deg and frequency_ratio_noise give log_likelihood. Other columns\n"
      "are passed on.",
      "evaluate_model");
  Report report(app);
  std::string output = "-";
  InputFiles inputs;
  PhysicsOptions physics;
  std::string points;
  add_input(app, "--points", points, "Points: CSV")->required();
  add_output(app, "--output", output, "CSV: the points with the results added");
  inputs.add_observations_to(app);
  physics.add_to(app);

  return report.run(argc, argv, [&] {
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
    replication::Phases phase_columns;
    std::vector<double> log_likelihood;
    if (with_phase) {
      phase_columns = replication::phases(table, reading.physics);
      columns.insert(columns.end(), {"phase_deg", "limit_force_ratio"});
    }
    if (with_likelihood) {
      log_likelihood = replication::log_likelihoods(
          table, friction::Likelihood(read_observations(inputs.observations), reading.physics,
                                      reading.infeasible_log_likelihood));
      columns.push_back("log_likelihood");
    }
    io::CsvWriter csv(output, columns);
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
    if (output != "-") {
      report("{} points, reading {}: {}\n", table.rows(), physics.reading_name, output);
    }
  });
}
