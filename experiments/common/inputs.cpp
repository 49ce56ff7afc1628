#include "inputs.hpp"

#include <filesystem>

#include "command_line/build_info.hpp"

namespace experiments {

std::string published(const std::string& file) {
  return data_file("published", file);
}

void InputFiles::add_observations_to(CLI::App& app) {
  observations = published("table1_observations.csv");
  add_input(app, "--observations", observations,
            "Measurements: CSV with columns r_nominal, r_measured, driving_frequency_hz, phase_deg");
}

void InputFiles::add_prior_to(CLI::App& app) {
  add_input(app, "--prior", prior,
            "CSV with columns parameter, lower, upper (uniform), or parameter, distribution and a "
            "column for each argument; "
            "without it Table 2 as the reading has it")
      ->default_str(table2);
  add_input(app, "--prior-correlation", prior_correlation,
            "Matrix of correlations: CSV with a first column parameter (correlations of the parameters) or "
            "normal_score, and a column for each parameter; without it they are independent");
}

void ProblemInputs::add_to(CLI::App& app) {
  add_observations_to(app);
  add_prior_to(app);
  physics.add_to(app);
}

bool is_table1(const std::string& observations) {
  std::error_code ignored;
  return std::filesystem::equivalent(observations, published("table1_observations.csv"), ignored);
}

friction::Observations read_observations(const std::string& path) {
  return replication::read_observations(path, warn);
}

}  // namespace experiments
