// The model at given points: phase angle (Eq. 21) and limit of continuous motion (Eq. 18) for
// points of friction force and frequency ratio, log-likelihood (Eq. 24) for points of the four
// parameters.
//
// Data: the reader's points; for the log-likelihood the observations of Table 1 or the reader's
// own.

#include <algorithm>
#include <iterator>

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
    std::vector<std::pair<std::string, std::vector<double>>> results;
    if (with_phase) {
      const auto phases = replication::phases(table, reading.physics);
      results.emplace_back("phase_deg", phases.phase_deg);
      results.emplace_back("limit_force_ratio", phases.limit_force_ratio);
    }
    if (with_likelihood) {
      results.emplace_back(
          "log_likelihood",
          replication::log_likelihoods(
              table, friction::Likelihood(read_observations(inputs.observations), reading.physics,
                                          reading.infeasible_log_likelihood)));
    }
    std::vector<std::string> columns;
    std::copy_if(table.column_names().begin(), table.column_names().end(), std::back_inserter(columns),
                 [&](const auto& name) {
                   return std::none_of(results.begin(), results.end(),
                                       [&](const auto& result) { return result.first == name; });
                 });
    const std::vector<std::string> kept = columns;
    for (const auto& result : results) {
      columns.push_back(result.first);
    }
    io::CsvWriter csv(output, columns);
    for (std::size_t row = 0; row < table.rows(); ++row) {
      std::vector<std::string> cells;
      for (const auto& name : kept) {
        cells.emplace_back(table.cell(row, name));
      }
      for (const auto& result : results) {
        cells.push_back(io::format_number(result.second[row]));
      }
      csv.row(cells);
    }
    csv.commit();
    if (output != "-") {
      report("{} points, reading {}: {}\n", table.rows(), physics.reading_name, output);
    }
  });
}
