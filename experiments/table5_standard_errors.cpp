// Table 5, which the abstract of the paper promises: the standard error of the estimates. For each sampler
// and parameter the posterior mean of a run has a spread over the runs; independent samples would have sd /
// sqrt(N). The ratio squared says how many independent samples a run of N is worth.
//
// Data: the samples that sampling_study writes.

#include <cmath>

#include "inputs.hpp"

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
    for (std::size_t s = 0; s < samples.samplers.size(); ++s) {
      for (std::size_t c = 0; c < samples.columns.size(); ++c) {
        std::vector<double> means, variances;
        double count = 0.0;
        for (std::size_t run = 0; run < samples.values[s][c].size(); ++run) {
          const auto m = samples.moments_of(s, c, run);
          means.push_back(m.mean);
          variances.push_back(m.standard_deviation * m.standard_deviation);
          count += static_cast<double>(samples.values[s][c][run].size());
        }
        count /= static_cast<double>(means.size());
        const auto m = replication::moments(means);
        // The variance of the pooled posterior: within the runs and, if there are two or more, between them.
        const double between = means.size() > 1 ? m.standard_deviation * m.standard_deviation : 0.0;
        const double variance = replication::moments(variances).mean + between;
        const double independent = std::sqrt(variance / count);
        const double effective = variance / (m.standard_deviation * m.standard_deviation);
        report("{:<12} {:<24} {:>10.5f} {:>15.6f} {:>13.5f} {:>17.6f} {:>14.1f}\n", samples.samplers[s],
               samples.columns[c], m.mean, m.standard_deviation, std::sqrt(variance), independent, effective);
        csv.row(samples.samplers[s], samples.columns[c], m.mean, m.standard_deviation, std::sqrt(variance),
                independent, effective);
      }
    }
    io::commit_all(csv);
  });
}
