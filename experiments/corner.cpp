// Samples of any parameters as a corner plot: marginal densities, joint densities of all pairs with
// the smallest regions that hold a given probability, and a table of moments and quantiles. All
// samplers and runs are pooled.
//
// Data: a CSV file with a column for each parameter, such as sampling_study or own_model writes.

#include <algorithm>

#include "command_line/corner_tables.hpp"
#include "inputs.hpp"

using namespace experiments;

namespace {

/// Whether the column is a parameter, and not one of the other columns in the files that the
/// executables write.
bool is_parameter(const std::string& column) {
  const std::vector<std::string> others = {"sampler", "run", "log_likelihood", "weight"};
  return std::find(others.begin(), others.end(), column) == others.end();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Marginal and joint densities of samples, for a corner plot.", "corner");
  Report report(app);
  std::string output, marginals_output, summary_output;
  std::string input = "data/generated/sampling_study_samples.csv";
  long bins = 40;
  add_output(app, output, "CSV: x_parameter, y_parameter, x, y (middle of a cell), density, level");
  add_output(app, "--marginals-output", marginals_output, "CSV: parameter, low, high, density of each bin");
  add_output(app, "--summary-output", summary_output,
             "CSV: a row for each parameter with moments, quantiles, the range that is drawn and the "
             "distance of its tics");
  add_input(app, "--input", input,
            "Samples: a column for each parameter; those named sampler, run and log_likelihood are none, and "
            "weight "
            "holds the weights");
  app.add_option("--bins", bins, "Bins of each parameter")->transform(count(1, 1000));

  return report.run(argc, argv, [&] {
    const auto table = io::CsvTable::read(input);
    CornerSamples samples;
    for (const auto& name : table.column_names()) {
      if (is_parameter(name)) {
        samples.names.push_back(name);
        samples.columns.push_back(table.numbers(name));
      }
    }
    if (samples.names.empty()) {
      throw io::InputError(fmt::format("{}: expected a column of a parameter", io::printable(input, 200)));
    }
    if (table.has("weight")) {
      samples.weights = nonnegative_numbers(table, "weight");
    }
    CornerTables tables(output, marginals_output, summary_output);
    tables.write(samples, bins, &report);
    io::commit_all(tables.joint, tables.marginals, tables.summary);
  });
}
