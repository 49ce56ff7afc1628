// Forensics: which settings of the sampler could have made the printed pair of columns? A search
// after the fact, over settings that the published scripts leave open or nearly: steps a move, what
// happens to a proposal outside the prior, the deviation in the criterion, the penalty of
// infeasible samples, runs stitched from two settings, iterations counted from another start. Each
// setting is calibrated against its own studies, and the search as a whole against what it finds in
// studies of one sampler.
//
// Data: Tables 1 to 4 as printed; replicated_study.csv, whose studies of both samplers are those of
// the first setting.

#include "replication/forensics.hpp"

#include <algorithm>

#include "inputs.hpp"

using namespace experiments;

namespace {

void report_findings(const Report& report, const replication::Forensics& f,
                     const std::vector<std::string>& names) {
  report("{:<30} {:>10} {:>16} {:>10} {:>16}\n", "setting", "column 1", "p", "column 2", "p");
  for (const auto& s : f.settings) {
    if (s.shift == 0) {
      const auto& a = s.columns[0];
      const auto& b = s.columns[1];
      report("{:<30} {:>10.2f} {:>8.4f} +- {:<6.4f} {:>8.2f} {:>8.4f} +- {:<6.4f}\n", s.name, a.log_density,
             a.p.value, a.p.standard_error, b.log_density, b.p.value, b.p.standard_error);
    }
  }
  auto pairs = f.pairs;
  std::sort(pairs.begin(), pairs.end(),
            [](const auto& a, const auto& b) { return a.log_density > b.log_density; });
  report("best pairs:\n");
  for (std::size_t i = 0; i < std::min<std::size_t>(5, pairs.size()); ++i) {
    report("  {} / {}: log-density {:.2f}, p = {:.4f} +- {:.4f}, weight {:.2f}\n", names[pairs[i].first],
           names[pairs[i].second], pairs[i].log_density, pairs[i].p.value, pairs[i].p.standard_error,
           pairs[i].weight);
  }
  report("gain over one sampler {:.2f}, of {:.0f} pairs; p of the search {:.4f} +- {:.4f}\n", f.gain,
         f.number_of_pairs, f.search_p.value, f.search_p.standard_error);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Which settings could have made the printed pair of columns?", "forensics");
  Report report(app);
  std::string output;
  InputFiles inputs;
  RunOptions run_options;
  long studies = 140;
  long samples = 1000;
  std::string replicated = "data/generated/replicated_study.csv";
  std::string table3 = published("table3_pbox_area.csv");
  std::string table4 = published("table4_iteration_counts.csv");
  std::string pairs_output, summary_output;
  add_output(app, output, "CSV: setting, shift, and of each column log-density, p and its standard error");
  add_output(app, "--pairs-output", pairs_output,
             "CSV: first, second, row, column, log_density, gain, p, p_error, weight");
  add_output(app, "--summary-output", summary_output, "CSV: quantity, value, standard_error");
  add_input(app, "--replicated", replicated, "Studies of the first setting, by replicated_study");
  app.add_option("--studies", studies, "Studies of each other setting")->transform(count(3, 1000000));
  app.add_option("--samples", samples, "N, samples a run")->transform(count(2));
  add_input(app, "--table3", table3, "Table 3 as printed");
  add_input(app, "--table4", table4, "Table 4 as printed");
  inputs.add_observations_to(app);
  run_options.add_to(app, 2);

  return report.run(argc, argv, [&] {
    // 1. The printed columns, and the studies of the first setting.
    const auto observations = read_observations(inputs.observations);
    const auto printed = read_printed_tables(table3, table4);
    const auto columns = replication::printed_columns(printed.areas, printed.counts);
    if (columns.size() != 2) {
      throw io::InputError(table4 + ": expected the columns of two samplers");
    }
    const auto settings = replication::forensic_settings(samples);
    std::vector<std::vector<replication::StudySummary>> of_settings = {read_studies(replicated, printed)};
    std::vector<std::string> names = {settings.front().name};
    auto csv = open_csv(output, {"setting", "shift", "first_log_density", "first_p", "first_p_error",
                                 "second_log_density", "second_p", "second_p_error"});
    auto pairs_csv = open_csv(
        pairs_output, {"first", "second", "row", "column", "log_density", "gain", "p", "p_error", "weight"});
    auto summary_csv = open_csv(summary_output, {"quantity", "value", "standard_error"});

    // 2. Studies of the other settings.
    io::Progress progress("forensics", (settings.size() - 1) * static_cast<std::size_t>(studies),
                          !report.quiet());
    const auto make_problem = [&](const replication::Reading& reading) {
      return interruptible(replication::problem(reading, observations, prior_for(inputs, reading)));
    };
    for (std::uint32_t i = 1; i < settings.size(); ++i) {
      of_settings.push_back(replication::run_setting(
          settings[i], make_problem, i, studies, run_options.study_options(), [&] { progress.advance(); }));
      names.push_back(settings[i].name);
    }

    // 3. The printed columns under each setting and each pair.
    const auto found = replication::compare_settings(of_settings, names, columns);
    report_findings(report, found, names);
    for (const auto& s : found.settings) {
      const auto& a = s.columns[0];
      const auto& b = s.columns[1];
      csv.row(s.name, s.shift, a.log_density, a.p.value, a.p.standard_error, b.log_density, b.p.value,
              b.p.standard_error);
    }
    for (const auto& p : found.pairs) {
      pairs_csv.row(names[p.first], names[p.second], p.first, p.second, p.log_density,
                    p.log_density - found.pairs.front().log_density, p.p.value, p.p.standard_error, p.weight);
    }
    for (const auto& s : replication::search_statistics(found, names, studies)) {
      summary_csv.row(s.quantity, s.value, s.standard_error);
    }
    io::commit_all(csv, pairs_csv, summary_csv);
  });
}
