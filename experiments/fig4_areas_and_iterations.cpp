// Figure 4: p-box areas (left half) and iteration counts (right half) of both samplers, as printed and as
// reproduced.
//
// Data: Tables 3 and 4, the printed ones and the generated ones.

#include <algorithm>

#include "inputs.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("Bars of Figure 4: p-box areas and iteration counts, printed beside reproduced.",
               "fig4_areas_and_iterations");
  Report report(app);
  std::string output;
  std::string areas = "data/generated/table3_pbox_area.csv";
  std::string counts = "data/generated/table4_iteration_counts.csv";
  std::string printed_areas = published("table3_pbox_area.csv");
  std::string printed_counts = published("table4_iteration_counts.csv");
  add_output(app, output, "CSV: panel, source, category, one column a sampler");
  add_input(app, "--areas", areas, "Table 3 as reproduced");
  add_input(app, "--counts", counts, "Table 4 as reproduced");
  add_input(app, "--printed-areas", printed_areas, "Table 3 as printed");
  add_input(app, "--printed-counts", printed_counts, "Table 4 as printed");

  return report.run(argc, argv, [&] {
    const std::vector<std::string> samplers = {"TMCMC", "TMCMC-II"};
    auto csv = open_csv(output, {"panel", "source", "category", samplers[0], samplers[1]});
    report("{:<12} {:<10} {:<22} {:>12} {:>12}\n", "panel", "source", "category", samplers[0], samplers[1]);
    const auto add = [&](const char* panel, const char* source, const std::string& category, double first,
                         double second) {
      report("{:<12} {:<10} {:<22} {:>12.5g} {:>12.5g}\n", panel, source, category, first, second);
      csv.row(panel, source, category, first, second);
    };
    const auto add_areas = [&](const char* source, const std::string& path) {
      const auto table = io::CsvTable::read(path);
      const auto names = table.text("sampler");
      require_once(table, names, "sampler", "each sampler once");
      for (const char* column : {"friction_force_n", "natural_frequency_hz"}) {
        const auto values = nonnegative_numbers(table, column);
        std::vector<double> cells;
        for (const auto& sampler : samplers) {
          const auto row = std::find(names.begin(), names.end(), sampler);
          if (row == names.end()) {
            throw io::InputError(
                fmt::format("{}: column 'sampler': no row '{}': expected one", path, sampler));
          }
          cells.push_back(values[static_cast<std::size_t>(row - names.begin())]);
        }
        add("area", source, column, cells[0], cells[1]);
      }
    };
    std::vector<long> categories;
    const auto iterations = [&](const std::string& path) {
      const auto table = io::CsvTable::read(path);
      const auto numbers = positive_integers(table, "iterations");
      require_once(table, numbers, "iterations", "each number of iterations once");
      categories.insert(categories.end(), numbers.begin(), numbers.end());
    };
    const auto add_counts = [&](const char* source, const std::string& path) {
      const auto table = io::CsvTable::read(path);
      const auto numbers = table.integers("iterations");
      const auto first = nonnegative_numbers(table, samplers[0]);
      const auto second = nonnegative_numbers(table, samplers[1]);
      for (const long category : categories) {
        const auto row = std::find(numbers.begin(), numbers.end(), category);
        const auto i = static_cast<std::size_t>(row - numbers.begin());
        const bool present = row != numbers.end();
        add("iterations", source, std::to_string(category), present ? first[i] : 0.0,
            present ? second[i] : 0.0);
      }
    };
    add_areas("printed", printed_areas);
    add_areas("reproduced", areas);
    iterations(printed_counts);
    iterations(counts);
    std::sort(categories.begin(), categories.end());
    categories.erase(std::unique(categories.begin(), categories.end()), categories.end());
    add_counts("printed", printed_counts);
    add_counts("reproduced", counts);
    io::commit_all(csv);
  });
}
