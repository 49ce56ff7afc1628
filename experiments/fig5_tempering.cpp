// Figure 5, which the abstract of the paper promises: the evolution of the tempering parameter beta over the
// stages of every run, by sampler.
//
// Data: the stages that sampling_study writes.

#include <algorithm>
#include <map>
#include <tuple>

#include "inputs.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("Tempering parameter over the stages of all runs (promised in the abstract).",
               "fig5_tempering");
  Report report(app);
  std::string output;
  std::string input = "data/generated/sampling_study_stages.csv";
  add_output(app, output, "CSV: sampler, run, stage (from 0), beta");
  add_input(app, "--input", input, "Stages: CSV with columns sampler, run, stage, beta");

  return report.run(argc, argv, [&] {
    const auto table = io::CsvTable::read(input);
    const auto samplers = table.text("sampler");
    const auto runs = table.integers("run");
    const auto stages = positive_integers(table, "stage");
    const auto betas = checked(
        table, "beta", table.numbers("beta"), [](double beta) { return beta >= 0.0 && beta <= 1.0; },
        "a number from 0 to 1");
    std::vector<std::tuple<std::string_view, long, long>> keys;
    for (std::size_t row = 0; row < betas.size(); ++row) {
      keys.emplace_back(samplers[row], runs[row], stages[row]);
    }
    require_once(table, keys, "stage", "each stage once a run");
    auto csv = open_csv(output, {"sampler", "run", "stage", "beta"});
    std::map<std::pair<std::string, long>, std::vector<double>> by_stage;
    for (std::size_t row = 0; row < betas.size(); ++row) {
      by_stage[{samplers[row], stages[row]}].push_back(betas[row]);
      if (csv) {
        if (stages[row] == 1) {
          csv->row(samplers[row], runs[row], 0, 0.0);
        }
        csv->row(samplers[row], runs[row], stages[row], betas[row]);
      }
    }
    report("{:<12} {:>6} {:>6} {:>12} {:>12} {:>12}\n", "sampler", "stage", "runs", "lowest beta", "median",
           "highest");
    for (auto& [key, values] : by_stage) {
      std::sort(values.begin(), values.end());
      const std::size_t n = values.size();
      report("{:<12} {:>6} {:>6} {:>12.4g} {:>12.4g} {:>12.4g}\n", key.first, key.second, n, values.front(),
             0.5 * (values[(n - 1) / 2] + values[n / 2]), values.back());
    }
    io::commit_all(csv);
  });
}
