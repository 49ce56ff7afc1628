// Table 3: area of the p-box of the runs' ECDFs (Eq. 25), for each sampler and parameter.
//
// Data: the samples that sampling_study writes; any CSV with columns sampler, run and one or more
// parameters will do, also with unequal numbers of samples a run. A column weight holds weights of
// the samples.

#include "inputs.hpp"
#include "pbox/pbox.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("Area of the p-box of all runs, for each sampler and parameter (Table 3).",
               "table3_pbox_area");
  Report report(app);
  std::string output;
  std::string input = "data/generated/sampling_study_samples.csv";
  add_output(app, output, "CSV in the form of table3_pbox_area.csv: sampler and one column a parameter");
  add_input(app, "--input", input, "Samples: CSV with columns sampler, run and parameters");

  return report.run(argc, argv, [&] {
    const auto samples = read_samples(input);
    std::vector<std::string> columns = {"sampler"};
    columns.insert(columns.end(), samples.columns.begin(), samples.columns.end());
    auto csv = open_csv(output, columns);
    report("Area of the p-box (Eq. 25)\n{:<12}", "sampler");
    for (const auto& name : samples.columns) {
      report(" {:>22}", name);
    }
    report("\n");
    for (std::size_t s = 0; s < samples.samplers.size(); ++s) {
      std::vector<double> areas;
      report("{:<12}", samples.samplers[s]);
      for (std::size_t c = 0; c < samples.columns.size(); ++c) {
        areas.push_back(pbox::area_metric(samples.ecdfs(s, c)));
        report(" {:>22.6g}", areas.back());
      }
      report("\n");
      csv.row(samples.samplers[s], areas);
    }
    io::commit_all(csv);
  });
}
