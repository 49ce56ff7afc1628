// Tables 1 to 4 as printed beside ours, cell by cell.
//
// Table 1: generated observations of the stated truth differ by their noise; r_nom is
// deterministic. Table 2: the prior of the reading that made the study. Tables 3 and 4: p-box areas
// and iteration counts of the sampling study.

#include "inputs.hpp"
#include "replication/comparison.hpp"

using namespace experiments;
using replication::ComparedCell;

namespace {

/// Opens the file and writes the text, unless the path is empty.
void write_text(std::optional<io::OutputFile>& file, const std::string& path, const std::string& text) {
  if (!path.empty()) {
    file.emplace(path);
    file->write(text);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Tables 1-4 of the paper beside ours, cell by cell.", "compare_published");
  Report report(app);
  std::string output;
  PhysicsOptions physics;
  InputFiles inputs;
  std::string printed_directory = "data/published";
  std::string table1 = "data/generated/table1_observations.csv";
  std::string table3 = "data/generated/table3_pbox_area.csv";
  std::string table4 = "data/generated/table4_iteration_counts.csv";
  std::string replicated;
  add_output(app, output,
             "CSV: table, row, column, printed, ours, difference, median, low, high, printed_percentile, "
             "our_percentile, p, p_error, verdict");
  std::string markdown_output;
  add_output(app, "--markdown-output", markdown_output, "Tables 3 and 4 as a Markdown table");
  std::string text_output;
  add_output(app, "--text-output", text_output, "The report that is printed");
  app.add_option("--published", printed_directory, "Directory of the tables as printed")->type_name("DIR");
  add_input(app, "--table1", table1, "Generated observations");
  add_input(app, "--table3", table3, "Our p-box areas");
  add_input(app, "--table4", table4, "Our iteration counts");
  add_input(app, "--replicated", replicated,
            "Studies of replicated_study; without them no intervals and verdicts");
  inputs.add_prior_to(app);
  physics.add_to(app);

  return report.run(argc, argv, [&] {
    const auto printed = [&](const std::string& file) {
      return io::CsvTable::read(printed_directory + "/" + file);
    };
    std::vector<ComparedCell> cells;
    replication::compare(
        cells, "Table 1", "index", {"r_nominal", "r_measured", "driving_frequency_hz", "phase_deg"},
        printed("table1_observations.csv"), io::CsvTable::read(table1), ComparedCell::unknown);
    const auto prior = prior_for(inputs, physics.reading());
    replication::compare_bounds(cells, read_prior(printed_directory + "/table2_prior.csv"), prior);
    replication::compare(cells, "Table 3", "sampler", {"friction_force_n", "natural_frequency_hz"},
                         printed("table3_pbox_area.csv"), io::CsvTable::read(table3), ComparedCell::unknown);
    const auto printed_counts = printed("table4_iteration_counts.csv");
    const auto our_counts = io::CsvTable::read(table4);
    for (const auto* table : {&printed_counts, &our_counts}) {
      static_cast<void>(positive_integers(*table, "iterations"));
    }
    replication::compare(cells, "Table 4", "iterations", {"TMCMC", "TMCMC-II"}, printed_counts, our_counts,
                         0.0);
    if (!replicated.empty()) {
      const auto tables = read_printed_tables(printed_directory + "/table3_pbox_area.csv",
                                              printed_directory + "/table4_iteration_counts.csv");
      const auto studies = read_studies(replicated, tables);
      replication::place_among_studies(cells, studies, tables.areas, tables.counts, null_of(studies, tables),
                                       parameter_columns);
    }
    auto csv = open_csv(output, {"table", "row", "column", "printed", "ours", "difference", "median", "low",
                                 "high", "printed_percentile", "our_percentile", "p", "p_error", "verdict"});
    for (const ComparedCell& cell : cells) {
      csv.row(cell.table, cell.row, cell.column, cell.printed, cell.ours, replication::difference(cell),
              cell.median, cell.interval.low, cell.interval.high, cell.printed_percentile,
              cell.our_percentile, cell.p.value, cell.p.standard_error, cell.verdict);
    }
    std::optional<io::OutputFile> markdown_file;
    write_text(markdown_file, markdown_output, replication::comparison_markdown(cells));
    const std::string text = replication::comparison_text(cells);
    std::optional<io::OutputFile> report_file;
    write_text(report_file, text_output, text);
    report("{}", text);
    io::commit_all(csv, markdown_file, report_file);
  });
}
