// A verdict on every printed number and claim of the paper, with its evidence. Each number of
// Tables 3 and 4 gets its place in the distribution that replicated studies give it; each claim a
// statistic. That a number is reproduced and that a claim is supported are two things, and stand in
// two columns.
//
// Data: Tables 3 and 4 and the claims as printed; replicated_study.csv; the exact posterior for C1
// and Table 1 for C7.

#include <boost/algorithm/string/replace.hpp>

#include "inputs.hpp"
#include "replication/claim_tables.hpp"
#include "replication/claims.hpp"

using namespace experiments;

namespace {

const replication::Truth stated;             // Section 3 of the paper
constexpr double alternative_force_n = 1.0;  // a test beside that of the stated force, not reported here

void write_contrast(io::CsvWriter& csv, const char* quantity, const char* statistic,
                    const replication::ContrastVerdict& c) {
  csv.row(quantity, statistic, c.printed, c.interval.low, c.interval.high, c.p.value, c.p.standard_error,
          c.replicated.ratio, c.replicated.interval.low, c.replicated.interval.high, c.replicated.margin);
}

std::string markdown_cell(const std::string& text) {
  return boost::algorithm::replace_all_copy(text, "|", "\\|");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("A verdict on every printed number and claim, with its evidence.", "verdicts");
  Report report(app);
  std::string output;
  ProblemInputs inputs;
  TableOptions table_options;
  RunOptions run_options;
  std::string replicated = "data/generated/replicated_study.csv";
  std::string table3 = published("table3_pbox_area.csv");
  std::string table4 = published("table4_iteration_counts.csv");
  std::string claims = published("claims.csv");
  std::string runs = "data/generated/sampling_study_runs.csv";
  std::string floor = "data/generated/pbox_floor.csv";
  std::string markdown_output, contrasts_output, statistics_output;
  add_output(app, output, "CSV: id, place, claim, number, verdict, evidence");
  add_output(app, "--markdown-output", markdown_output, "The verdicts as a Markdown table");
  add_output(
      app, "--contrasts-output", contrasts_output,
      "CSV of the comparisons of the samplers behind C2 to C5: quantity, statistic, printed, null_low, "
      "null_high, p, ratio, ratio_low, ratio_high, margin");
  add_output(app, "--statistics-output", statistics_output,
             "CSV of the other numbers behind the verdicts: quantity, value, standard_error");
  add_input(app, "--replicated", replicated, "Studies written by replicated_study");
  add_input(app, "--table3", table3, "Table 3 as printed");
  add_input(app, "--table4", table4, "Table 4 as printed");
  add_input(app, "--claims", claims, "Claims: CSV with columns id, place, claim");
  add_input(app, "--runs-input", runs, "Runs of a study, written by sampling_study, for C11");
  add_input(app, "--floor", floor, "Areas of independent draws, written by pbox_floor, for C12");
  inputs.add_to(app);
  table_options.add_to(app);
  run_options.add_seed_to(app);

  return report.run(argc, argv, [&] {
    const auto reading = inputs.physics.reading();
    const auto [ids, places, texts] = replication::read_claims(claims);
    const auto printed = read_printed_tables(table3, table4);
    const auto studies = read_studies(replicated, printed);
    const auto observations = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, reading);
    if (printed.counts.size() != 2 || printed.areas.size() != 4) {
      throw io::InputError(table4 + ": expected the columns of two samplers, and table 3 two rows");
    }
    auto csv = open_csv(output, {"id", "place", "claim", "number", "verdict", "evidence"});
    auto contrasts_csv =
        open_csv(contrasts_output, {"quantity", "statistic", "printed", "null_low", "null_high", "p",
                                    "p_standard_error", "ratio", "ratio_low", "ratio_high", "margin"});
    auto statistics_csv = open_csv(statistics_output, {"quantity", "value", "standard_error"});
    std::optional<io::OutputFile> markdown_file;
    if (!markdown_output.empty()) {
      markdown_file.emplace(markdown_output);
    }

    io::Progress progress("verdicts", 3, !report.quiet());
    const auto columns = replication::printed_columns(printed.areas, printed.counts);
    const auto contrasts =
        replication::contrast_samplers(studies, columns, run_options.seed, table_options.draws);
    progress.advance();
    const auto joint = replication::test_jointly(studies, columns, null_of(studies, printed));
    progress.advance();

    const auto audit = replication::audit(observations, stated, alternative_force_n,
                                          replication::with_exact_rules(reading.physics));

    const friction::Likelihood likelihood(observations, reading.physics);
    const auto exact = exact_posterior_for(inputs, likelihood, prior).marginal(friction::friction_force);
    const replication::ClaimEvidence evidence{
        .studies = studies,
        .printed = columns,
        .contrasts = contrasts,
        .audit = audit,
        .stated = stated,
        .exceedance = exact.exceedance(stated.friction_force_n),
        .iterations_and_error = replication::iterations_and_error(runs, exact.mean()),
        .floor_n = replication::median_of_column(floor, "friction_force_n")};

    std::string markdown = "| | claim | number | verdict on the claim | evidence |\n|---|---|---|---|---|\n";
    for (std::size_t i = 0; i < ids.size(); ++i) {
      const auto judged = replication::judge_claim(ids[i], evidence);
      report("{}  {}\n    number: {}; claim: {}\n    {}\n", ids[i], texts[i], judged.number,
             name_of(judged.claim), judged.evidence);
      markdown += fmt::format("| {} | {} | {} | **{}** | {} |\n", ids[i], markdown_cell(texts[i]),
                              judged.number, name_of(judged.claim), judged.evidence);
      csv.row(ids[i], places[i], texts[i], judged.number, name_of(judged.claim), judged.evidence);
    }
    if (contrasts_csv) {
      write_contrast(*contrasts_csv, "friction_force_n", "ratio of areas", contrasts.friction_force);
      write_contrast(*contrasts_csv, "natural_frequency_hz", "ratio of areas", contrasts.natural_frequency);
      write_contrast(*contrasts_csv, "iterations", "two-sample deviance", contrasts.iterations);
    }
    for (const auto& s :
         replication::claim_statistics(evidence, joint, exact.mean(), exact.standard_deviation())) {
      statistics_csv.row(s.quantity, digits(s.value, 8), digits(s.standard_error, 4));
    }
    if (markdown_file) {
      markdown_file->write(markdown);
    }
    io::commit_all(csv, contrasts_csv, statistics_csv, markdown_file);
  });
}
