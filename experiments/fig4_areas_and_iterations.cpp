// Figure 4: p-box areas (left half) and iteration counts (right half) of both samplers, as printed
// and as reproduced.
//
// Data: Tables 3 and 4, the printed ones and the generated ones.

#include <array>

#include "inputs.hpp"
#include "replication/paper_tables.hpp"

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
    const std::array<std::string, 2> samplers = {"TMCMC", "TMCMC-II"};
    const auto read = [](const std::string& table3, const std::string& table4) {
      return replication::AreasAndCounts{io::CsvTable::read(table3), io::CsvTable::read(table4)};
    };
    const auto bars =
        replication::bar_pairs(read(printed_areas, printed_counts), read(areas, counts), samplers);
    auto csv = open_csv(output, {"panel", "source", "category", samplers[0], samplers[1]});
    report("{:<12} {:<10} {:<22} {:>12} {:>12}\n", "panel", "source", "category", samplers[0], samplers[1]);
    for (const auto& b : bars) {
      report("{:<12} {:<10} {:<22} {:>12.5g} {:>12.5g}\n", b.panel, b.source, b.category, b.heights[0],
             b.heights[1]);
      csv.row(b.panel, b.source, b.category, b.heights);
    }
    io::commit_all(csv);
  });
}
