// Table 5, which the abstract of the paper promises: the standard error of the estimates. For each
// sampler and parameter the posterior mean of a run has a spread over the runs; independent samples
// would have sd / sqrt(N). The ratio squared says how many independent samples a run of N is worth.
//
// Data: the samples that sampling_study writes.

#include "inputs.hpp"
#include "replication/paper_tables.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("Standard error of the posterior means over the runs (promised in the abstract).",
               "table5_standard_errors");
  Report report(app);
  std::string output;
  std::string input = "data/generated/sampling_study_samples.csv";
  add_output(app, output,
             "CSV: sampler, parameter, mean, standard_error, posterior_sd, standard_error_independent, "
             "effective_sample_size");
  add_input(app, "--input", input, "Samples: CSV with columns sampler, run and parameters");

  return report.run(argc, argv, [&] {
    const auto samples = read_samples(input);
    auto csv = open_csv(output, {"sampler", "parameter", "mean", "standard_error", "posterior_sd",
                                 "standard_error_independent", "effective_sample_size"});
    report("{:<12} {:<24} {:>10} {:>15} {:>13} {:>17} {:>14}\n", "sampler", "parameter", "mean",
           "standard error", "posterior sd", "if independent", "effective size");
    for (const auto& e : replication::standard_errors(samples)) {
      report("{:<12} {:<24} {:>10.5f} {:>15.6f} {:>13.5f} {:>17.6f} {:>14.1f}\n", e.sampler, e.parameter,
             e.mean, e.standard_error, e.posterior_sd, e.independent, e.effective_size);
      csv.row(e.sampler, e.parameter, e.mean, e.standard_error, e.posterior_sd, e.independent,
              e.effective_size);
    }
    io::commit_all(csv);
  });
}
