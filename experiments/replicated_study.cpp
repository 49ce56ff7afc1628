// The whole study of the paper (50 runs of TMCMC and of TMCMC-II) many times over: the null
// distribution that every printed number is judged by. Rows are kept as they come: a process that
// was killed goes on where it stopped, and ends with the same bytes. Shards (--first-study)
// concatenate to the file of one process.
//
// Data: Table 1 and the prior of Table 2 as printed, or the reader's own.

#include <algorithm>
#include <cmath>

#include "command_line/build_info.hpp"
#include "inputs.hpp"
#include "io/interrupt.hpp"
#include "io/journal.hpp"

using namespace experiments;

namespace {

/// Median and central 95 % of one column, by sampler.
void report_column(const Report& report, const std::vector<std::string>& rows, std::size_t column,
                   const char* name, const std::vector<replication::Arm>& arms) {
  for (const auto& arm : arms) {
    std::vector<double> values = replication::study_column(rows, arm.name, column);
    std::sort(values.begin(), values.end());
    const auto quantile = [&](double p) {
      return values[static_cast<std::size_t>(std::lround(p * static_cast<double>(values.size() - 1)))];
    };
    report("  {:<28} {:<10} {:>12.5g} {:>12.5g} {:>12.5g}\n", name, arm.name, quantile(0.5), quantile(0.025),
           quantile(0.975));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Repeats the whole study (R runs of each sampler) many times: distributions of the p-box areas,\n"
      "iteration counts and standard errors. Resumes from OUTPUT.journal where it was killed.",
      "replicated_study");
  Report report(app);
  std::string output;
  ProblemInputs inputs;
  SamplerOptions sampler;
  RunOptions run_options;
  long studies = 1000, first_study = 0;
  add_output(
      app, output,
      "CSV with one row for each study and sampler. A shard with --first-study above 0 has no header line");
  app.add_option("--studies", studies, "Number of studies, of both samplers each")
      ->transform(count(1, 100000000));
  app.add_option("--first-study", first_study, "Number of the first study, for sharing the work")
      ->transform(count(0));
  inputs.add_to(app);
  run_options.add_to(app, 2);
  sampler.add_to(app);

  return report.run(argc, argv, [&] {
    replication::Reading reading = inputs.physics.reading();
    sampler.apply(reading);
    const auto observations = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, reading);
    const auto problem = interruptible(replication::problem(reading, observations, prior));
    const auto arms = replication::paper_arms(reading, sampler.cov_target, sampler.ess_fraction);
    auto options = run_options.study_options();

    std::optional<io::OutputFile> stream;
    std::optional<io::Journal> journal;
    std::vector<std::string> rows;
    if (!output.empty()) {
      stream.emplace(output);  // a path that cannot be written is refused before the work
    }
    if (stream && !stream->in_place()) {
      stream.reset();
      journal.emplace(output,
                      fmt::format("replicated_study {} first {} {}", version(), first_study,
                                  replication::study_key(reading, arms, options, observations, prior)));
      rows = journal->rows();
      rows.resize(std::min(rows.size() / arms.size(), static_cast<std::size_t>(studies)) * arms.size());
      journal->truncate(rows.size());
      if (journal->was_damaged()) {
        report("{}: damaged rows are made again\n", journal->path().string());
      }
      if (!rows.empty()) {
        report("{} studies were done before\n", rows.size() / arms.size());
      }
    }
    const auto done = static_cast<long>(rows.size() / arms.size());
    io::Progress progress("replicated_study", static_cast<std::size_t>(studies - done), !report.quiet());
    try {
      for (long k = done; k < studies; ++k) {
        options.study = static_cast<std::uint32_t>(first_study + k);
        std::vector<std::string> added;
        for (const auto& summary : replication::run_study(problem, arms, options)) {
          added.push_back(replication::study_line(summary));
        }
        if (journal) {
          journal->append(added);
        }
        rows.insert(rows.end(), added.begin(), added.end());
        progress.advance();
      }
    } catch (io::Interrupted& interrupted) {
      if (journal) {
        interrupted.kept = fmt::format("{} of {} studies kept in {}, run the same command again to go on",
                                       rows.size() / arms.size(), studies, journal->path().string());
      }
      throw;
    }
    const std::string header = first_study == 0 ? replication::study_header() : "";
    if (journal) {
      journal->finish(header);
    } else if (stream) {
      stream->write(fmt::format("{}{}{}\n", header, header.empty() ? "" : "\n", fmt::join(rows, "\n")));
      stream->commit();
    }
    report("{} studies of {} runs, seed {}, reading {}\n", studies, options.runs, options.seed,
           inputs.physics.reading_name);
    report("  {:<28} {:<10} {:>12} {:>12} {:>12}\n", "", "sampler", "median", "2.5 %", "97.5 %");
    for (const auto& [column, name] : {std::pair{2U, "p-box area, F_mu, N"},
                                       {3U, "p-box area, omega_n, Hz"},
                                       {10U, "standard error, F_mu, N"},
                                       {22U, "log-evidence"}}) {
      report_column(report, rows, column, name, arms);
    }
  });
}
