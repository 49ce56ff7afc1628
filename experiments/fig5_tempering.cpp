// Figure 5, which the abstract of the paper promises: the evolution of the tempering parameter beta
// over the stages of every run, by sampler.
//
// Data: the stages that sampling_study writes.

#include <algorithm>
#include <map>

#include "inputs.hpp"
#include "replication/paper_tables.hpp"
#include "statistics/summary.hpp"

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
    const auto stages = replication::read_stages(io::CsvTable::read(input));
    auto csv = open_csv(output, {"sampler", "run", "stage", "beta"});
    std::map<std::pair<std::string, long>, std::vector<double>> by_stage;
    for (const auto& s : stages) {
      by_stage[{s.sampler, s.stage}].push_back(s.beta);
      if (s.stage == 1) {
        csv.row(s.sampler, s.run, 0, 0.0);
      }
      csv.row(s.sampler, s.run, s.stage, s.beta);
    }
    report("{:<12} {:>6} {:>6} {:>12} {:>12} {:>12}\n", "sampler", "stage", "runs", "lowest beta", "median",
           "highest");
    for (auto& [key, values] : by_stage) {
      std::sort(values.begin(), values.end());
      report("{:<12} {:>6} {:>6} {:>12.4g} {:>12.4g} {:>12.4g}\n", key.first, key.second, values.size(),
             values.front(), statistics::sample_quantile(values, 0.5), values.back());
    }
    io::commit_all(csv);
  });
}
