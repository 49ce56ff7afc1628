// Table 4: number of runs that needed each number of iterations (tempering stages), by sampler.
//
// Data: the runs that sampling_study writes.

#include "inputs.hpp"
#include "replication/paper_tables.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("How many runs needed how many iterations (Table 4).", "table4_iteration_counts");
  Report report(app);
  std::string output;
  std::string input = "data/generated/sampling_study_runs.csv";
  add_output(app, output,
             "CSV in the form of table4_iteration_counts.csv: iterations and one column a sampler");
  add_input(app, "--input", input,
            "Runs: CSV with columns sampler, iterations; and run, each once a sampler");

  return report.run(argc, argv, [&] {
    const auto table = replication::count_iterations(io::CsvTable::read(input));
    std::vector<std::string> columns = {"iterations"};
    columns.insert(columns.end(), table.samplers.begin(), table.samplers.end());
    auto csv = open_csv(output, columns);
    report("Runs by number of iterations\n{:<12} {:>12}\n", "iterations", fmt::join(table.samplers, " "));
    for (const auto& [iterations, runs] : table.runs) {
      report("{:<12} {:>12}\n", iterations, fmt::join(runs, " "));
      csv.row(iterations, runs);
    }
    io::commit_all(csv);
  });
}
