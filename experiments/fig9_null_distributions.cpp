// Figures 9 and 10: the distributions that replicated studies give the printed numbers. Areas of
// the p-boxes as distribution functions over the studies, for both samplers, and their ratio;
// iteration counts as the number of studies in which so many of the runs took so many iterations.
//
// Data: replicated_study.csv; Tables 3 and 4 as printed, for the marks.

#include <algorithm>

#include "inputs.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("Distributions of areas and iteration counts over replicated studies.",
               "fig9_null_distributions");
  Report report(app);
  std::string output;
  std::string replicated = "data/generated/replicated_study.csv";
  std::string table3 = published("table3_pbox_area.csv");
  std::string table4 = published("table4_iteration_counts.csv");
  std::string counts_output, printed_output, pairs_output;
  add_output(app, output, "CSV: sampler, parameter, area, cumulative");
  add_output(app, "--counts-output", counts_output,
             "CSV: sampler, iterations, runs, share_of_studies, printed");
  add_output(app, "--printed-output", printed_output, "CSV: sampler, parameter, printed, low, high, p");
  add_output(app, "--pairs-output", pairs_output,
             "CSV: areas of the friction force under both samplers, a row for each study");
  add_input(app, "--replicated", replicated, "Studies written by replicated_study");
  add_input(app, "--table3", table3, "Table 3 as printed");
  add_input(app, "--table4", table4, "Table 4 as printed");
  TableOptions table_options;
  table_options.add_to(app);

  return report.run(argc, argv, [&] {
    const auto printed = read_printed_tables(table3, table4);
    const auto studies = read_studies(replicated, printed);
    auto csv = open_csv(output, {"sampler", "parameter", "area", "cumulative"});
    auto counts_csv =
        open_csv(counts_output, {"sampler", "iterations", "runs", "share_of_studies", "printed"});
    auto printed_csv = open_csv(printed_output, {"sampler", "parameter", "printed", "low", "high", "p"});
    auto pairs_csv = open_csv(pairs_output, {"first", "second"});
    const auto first = replication::studies_of(studies, printed.counts.front().sampler);
    const auto second = replication::studies_of(studies, printed.counts.back().sampler);
    for (std::size_t i = 0; pairs_csv && i < std::min(first.size(), second.size()); ++i) {
      pairs_csv->row(first[i].areas[0], second[i].areas[0]);
    }
    const auto null = null_of(studies, printed);
    for (const auto& v : replication::judge_areas(studies, printed.areas, null)) {
      const auto& parameter = parameter_columns[v.parameter];
      report("{:<10} {:<22} printed {:.5g}, median {:.5g}, 95 % {:.5g} to {:.5g}, p = {:.3g}\n", v.sampler,
             parameter, v.printed, v.median, v.interval.low, v.interval.high, v.p.value);
      printed_csv.row(v.sampler, parameter, v.printed, v.interval.low, v.interval.high, v.p.value);
      std::vector<double> areas;
      for (const auto& s : replication::studies_of(studies, v.sampler)) {
        areas.push_back(s.areas[v.parameter]);
      }
      std::sort(areas.begin(), areas.end());
      for (std::size_t i = 0; csv && i < areas.size(); ++i) {
        csv->row(v.sampler, parameter, areas[i],
                 static_cast<double>(i + 1) / static_cast<double>(areas.size()));
      }
    }
    for (const auto& column : printed.counts) {
      for (const auto& share : replication::count_shares(studies, column)) {
        counts_csv.row(column.sampler, share.iterations, share.runs, share.share_of_studies, share.printed);
      }
    }
    const auto report_test = [&](const std::string& what, const replication::DevianceTest& test) {
      report(
          "{:<10} Table 4: deviance {:.3g}, 95 % of tables below {:.3g}, p = {:.3g} (standard error "
          "{:.1g})\n",
          what, test.statistic, test.critical, test.p.value, test.p.standard_error);
    };
    const auto tests = replication::judge_counts(studies, printed.counts, null, table_options.draws);
    for (std::size_t i = 0; i < tests.size(); ++i) {
      report_test(i < printed.counts.size() ? printed.counts[i].sampler : "both", tests[i]);
    }
    io::commit_all(csv, counts_csv, printed_csv, pairs_csv);
  });
}
