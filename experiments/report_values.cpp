// The numbers and table rows of the replication report (paper/), as LaTeX definitions. Which they are and where they come
// from stands in two lists, paper/values.csv and paper/tables.csv; report/values.hpp describes them.
//
// Data: the generated and printed tables, and the times of paper/measured.csv.

#include "inputs.hpp"
#include "report/format.hpp"
#include "report/values.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  Program program("report_values", "Numbers and table rows of the replication report, as LaTeX definitions.");
  std::string values = "paper/values.csv", tables = "paper/tables.csv";
  std::string generated = "data/generated", printed = "data/published", paper = "paper";
  program.add_output("TeX: \\reportvalue{KEY}{VALUE} and \\reporttable{KEY}{ROWS}");
  program.add_input("--values", values, "List of values: key, file, where, column, statistic, format");
  program.add_input("--tables", tables, "List of tables: key, file, where, columns");
  program.add_text("--generated", generated, "DIR", "Directory of the files generated/...");
  program.add_text("--published", printed, "DIR", "Directory of the files published/...");
  program.add_text("--paper", paper, "DIR", "Directory of the files paper/...");

  return program.run(argc, argv, [&] {
    const report::Roots roots = {{"generated", generated}, {"published", printed}, {"paper", paper}};
    const auto value_list = io::CsvTable::read(values);
    const auto table_list = io::CsvTable::read(tables);
    const std::string tex =
        fmt::format("% Made by report_values from {} and {}.\n", values, tables) +
        fmt::format("\\reportvalue{{significant-digits}}{{{}}}\n", report::significant_digits) +
        report::tex_values(value_list, roots) + report::tex_tables(table_list, roots);
    program.report("{} values and {} tables\n", value_list.rows(), table_list.rows());
    if (!program.output().empty()) {
      io::OutputFile file(program.output());
      file.write(tex);
      file.commit();
    }
  });
}
