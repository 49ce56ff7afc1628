// Which reading of the paper makes the printed numbers? Each difference between text, published
// scripts and mathematics changed alone from `as_published`, and the three presets, with the effect
// on every number of Tables 3 and 4, the distance to the exact posterior, and the joint likelihood
// of both tables.
//
// Data: Tables 1 to 4 as printed. Where the published script takes the frequency ratios of the
// phase model from a column that is not in the paper, that column is drawn at random (r_nom +
// noise), anew in each study.

#include <algorithm>

#include "inputs.hpp"
#include "replication/reading_effects.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("Effect of each reading of the paper on every printed number.", "readings");
  Report report(app);
  std::string output;
  InputFiles inputs;
  RunOptions run_options;
  TableOptions table_options;
  table_options.draws = {.tables = 20000, .resamples = 2};  // the standard error is not reported
  std::string only;
  long studies = 40;
  long samples = 1000;
  std::string table3 = published("table3_pbox_area.csv");
  std::string table4 = published("table4_iteration_counts.csv");
  add_output(app, output, "CSV with one row for each reading and sampler");
  inputs.add_observations_to(app);
  run_options.add_to(app, 2);
  app.add_option("--studies", studies, "Replicated studies a reading")->transform(count(3, 1000000));
  app.add_option("--samples", samples, "N, samples a run")->transform(count(2));
  table_options.add_to(app);
  app.add_option("--only", only, "Only the reading of this name, for example 'as_worded'")->type_name("TEXT");
  add_input(app, "--table3", table3, "Table 3 as printed");
  add_input(app, "--table4", table4, "Table 4 as printed");

  return report.run(argc, argv, [&] {
    const auto observations = read_observations(inputs.observations);
    const auto printed = read_printed_tables(table3, table4);
    auto options = run_options.study_options();
    auto list = replication::reading_variants(samples);
    if (!only.empty()) {
      std::erase_if(list, [&](const auto& v) { return v.name != only; });
    }
    if (list.empty()) {
      throw std::invalid_argument(fmt::format("--only: value '{}': expected the name of a reading", only));
    }
    for (const auto& column : printed.counts) {
      const auto arms = replication::paper_arms(list.front().reading);
      if (std::none_of(arms.begin(), arms.end(),
                       [&](const auto& arm) { return arm.name == column.sampler; })) {
        throw io::InputError(fmt::format("{}: column '{}': expected the samplers that are run here", table4,
                                         io::printable(column.sampler)));
      }
    }
    auto csv = open_csv(
        output, {"reading", "sampler", "area_force_median", "area_force_low", "area_force_high",
                 "area_force_p", "area_frequency_median", "area_frequency_low", "area_frequency_high",
                 "area_frequency_p", "share_up_to_9", "share_10", "share_from_11", "counts_p",
                 "force_error_n", "frequency_error_hz", "log_evidence_error", "log_likelihood_of_tables"});
    report(
        "{} studies of {} runs a reading, seed {}\n{:<22} {:<9} {:>8} {:>16} {:>6} {:>8} {:>17} {:>6} {:>18} "
        "{:>6} {:>9} {:>8}\n",
        studies, options.runs, options.seed, "reading", "sampler", "F area", "95 %", "p", "w area", "95 %",
        "p", "<=9 / 10 / >=11", "p", "F error", "log lik");
    io::Progress progress("readings", list.size() * static_cast<std::size_t>(studies), !report.quiet());
    for (const auto& variant : list) {
      const auto prior = prior_for(inputs, variant.reading);
      const auto arms = replication::paper_arms(variant.reading);
      std::vector<replication::StudySummary> summaries;
      for (long k = 0; k < studies; ++k) {
        options.study = static_cast<std::uint32_t>(k);
        const auto data = variant.random_ratios
                              ? replication::with_random_ratios(observations, options.seed, options.study)
                              : observations;
        const auto study = replication::run_study(
            interruptible(replication::problem(variant.reading, data, prior)), arms, options);
        summaries.insert(summaries.end(), study.begin(), study.end());
        progress.advance();
      }
      const auto exact =
          exact_posterior_for(inputs, friction::Likelihood(observations, variant.reading.physics), prior);
      for (const auto& e :
           replication::effects_of(summaries, printed.areas, printed.counts, table_options.draws)) {
        const double force_error = e.mean_force_n - exact.marginal(friction::friction_force).mean();
        const double frequency_error =
            e.mean_frequency_hz - exact.marginal(friction::natural_frequency).mean();
        report(
            "{:<22} {:<9} {:>8.4f} {:>7.4f}-{:<8.4f} {:>6.3f} {:>8.5f} {:>8.5f}-{:<8.5f} {:>6.3f} {:>5.2f} "
            "{:>5.2f} {:>6.2f} {:>6.3f} {:>+9.5f} {:>8.2f}\n",
            variant.name, e.sampler, e.force.median, e.force.interval.low, e.force.interval.high, e.force.p,
            e.frequency.median, e.frequency.interval.low, e.frequency.interval.high, e.frequency.p,
            e.share_up_to_9, e.share_10, e.share_from_11, e.counts_p, force_error, e.log_likelihood);
        csv.row(variant.name, e.sampler, e.force.median, e.force.interval.low, e.force.interval.high,
                e.force.p, e.frequency.median, e.frequency.interval.low, e.frequency.interval.high,
                e.frequency.p, e.share_up_to_9, e.share_10, e.share_from_11, e.counts_p, force_error,
                frequency_error, e.mean_log_evidence - exact.log_evidence(), e.log_likelihood);
      }
    }
    io::commit_all(csv);
  });
}
