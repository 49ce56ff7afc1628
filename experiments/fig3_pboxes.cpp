// Figure 3: the p-box of the 50 posterior ECDFs, for each sampler and parameter, on a grid of the
// parameter.
//
// Data: the samples that sampling_study writes.

#include <algorithm>

#include "inputs.hpp"
#include "pbox/pbox.hpp"
#include "statistics/summary.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("Bounds of the ECDFs of all runs, for each sampler and parameter (Figure 3).", "fig3_pboxes");
  Report report(app);
  std::string output;
  std::string input = "data/generated/sampling_study_samples.csv";
  long points = 401;
  add_output(app, output, "CSV: sampler, parameter, x, lower, upper");
  add_input(app, "--input", input, "Samples: CSV with columns sampler, run and parameters");
  app.add_option("--points", points, "Grid points between the smallest and the largest sample")
      ->transform(count(2, 1000000));

  return report.run(argc, argv, [&] {
    const auto samples = read_samples(input);
    auto csv = open_csv(output, {"sampler", "parameter", "x", "lower", "upper"});
    report("{:<12} {:<24} {:>12} {:>12} {:>14}\n", "sampler", "parameter", "smallest", "largest", "area");
    for (std::size_t s = 0; s < samples.samplers.size(); ++s) {
      for (std::size_t c = 0; c < samples.columns.size(); ++c) {
        const auto box = pbox::envelope(samples.ecdfs(s, c));
        const double low = box.x.front();
        const double high = box.x.back();
        report("{:<12} {:<24} {:>12.5g} {:>12.5g} {:>14.6g}\n", samples.samplers[s], samples.columns[c], low,
               high, pbox::area(box));
        for (const double x : statistics::evenly_spaced(low, high, points)) {
          const auto bounds = pbox::evaluate(box, x);
          csv.row(samples.samplers[s], samples.columns[c], x, bounds.lower, bounds.upper);
        }
      }
    }
    io::commit_all(csv);
  });
}
