// Table 4: number of runs that needed each number of iterations (tempering stages), by sampler.
//
// Data: the runs that sampling_study writes.

#include <map>
#include <set>

#include "inputs.hpp"

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
    const auto table = io::CsvTable::read(input);
    const auto samplers = table.text("sampler");
    const auto iterations = positive_integers(table, "iterations");
    if (table.has("run")) {
      require_runs_once(table);
    }
    std::vector<std::string> names;
    std::set<std::string_view> known;
    std::map<long, std::map<std::string, long>> counts;
    for (std::size_t row = 0; row < samplers.size(); ++row) {
      if (known.insert(samplers[row]).second) {
        names.push_back(samplers[row]);
      }
      ++counts[iterations[row]][samplers[row]];
    }
    std::vector<std::string> columns = {"iterations"};
    columns.insert(columns.end(), names.begin(), names.end());
    auto csv = open_csv(output, columns);
    report("Runs by number of iterations\n{:<12}", "iterations");
    for (const auto& name : names) {
      report(" {:>12}", name);
    }
    report("\n");
    for (auto& [number, by_sampler] : counts) {
      std::vector<double> cells;
      report("{:<12}", number);
      for (const auto& name : names) {
        cells.push_back(static_cast<double>(by_sampler[name]));
        report(" {:>12}", by_sampler[name]);
      }
      report("\n");
      csv.row(number, cells);
    }
    io::commit_all(csv);
  });
}
