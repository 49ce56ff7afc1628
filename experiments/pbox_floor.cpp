// The floor of the p-box area (Table 3, Eq. 25): what the area would be if the runs were
// independent exact draws from the posterior, K studies of R sets of N draws each. What a sampler's
// area has beyond it measures how its chains mix.
//
// Data: Table 1 and the prior of Table 2 as printed in Lye and Marino (ESREL 2023), or the reader's
// own.

#include "inputs.hpp"
#include "replication/exact_runs.hpp"
#include "statistics/summary.hpp"
#include "tmcmc/parallel.hpp"

using namespace experiments;

namespace {

void write_pboxes(OptionalCsv& csv, const replication::Ecdfs& ecdfs, long points) {
  for (std::size_t p = 0; p < ecdfs.size(); ++p) {
    const auto box = pbox::envelope(ecdfs[p]);
    for (const double x : statistics::evenly_spaced(box.x.front(), box.x.back(), points)) {
      const auto bounds = pbox::evaluate(box, x);
      csv.row("exact draws", parameter_columns[p], x, bounds.lower, bounds.upper);
    }
  }
}

/// Median areas of few studies over a grid of runs and draws per run: the floor grows with the
/// number of runs and falls with the number of draws.
void write_growth(OptionalCsv& csv, const estimation::ExactPosterior& posterior, std::uint64_t seed) {
  for (const long runs : {10, 50, 200}) {
    for (const long samples : {1000, 4000, 16000}) {
      std::vector<replication::Areas> areas;
      for (const std::uint32_t study : {0U, 1U, 2U}) {
        areas.push_back(replication::exact_areas(posterior, seed, study, runs, samples));
      }
      csv.row(runs, samples, replication::area_quantiles(areas, 0.5));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("P-box areas (Eq. 25) of independent exact draws: the floor below any sampler's.",
               "pbox_floor");
  Report report(app);
  std::string output;
  ProblemInputs inputs;
  RunOptions run_options;
  long samples = 1000, studies = 100, points = 401;
  std::string pbox_output, summary_output, growth_output;
  add_output(app, output, "CSV of the areas: study and one column a parameter");
  add_output(app, "--pbox-output", pbox_output,
             "CSV of the p-boxes of study 0, in the columns of fig3_pboxes");
  add_output(app, "--summary-output", summary_output,
             "CSV of the areas' quantiles over the studies: probability and one column a parameter");
  add_output(app, "--growth-output", growth_output,
             "CSV of the median areas of 10 to 200 runs of 1000 to 16000 draws");
  app.add_option("--samples", samples, "N, draws a run")->transform(count(2));
  app.add_option("--studies", studies, "K, studies")->transform(count());
  app.add_option("--points", points, "Grid points of each p-box")->transform(count(2, 1000000));
  run_options.add_to(app);
  inputs.add_to(app);

  return report.run(argc, argv, [&] {
    const auto reading = inputs.physics.reading();
    const auto observations = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, reading);
    const auto options = run_options.study_options();
    const auto posterior =
        exact_posterior_for(inputs, friction::Likelihood(observations, reading.physics), prior);
    std::vector<std::string> columns = {"study"};
    columns.insert(columns.end(), parameter_columns.begin(), parameter_columns.end());
    auto csv = open_csv(output, columns);
    auto pbox_csv = open_csv(pbox_output, {"sampler", "parameter", "x", "lower", "upper"});
    columns.front() = "probability";
    auto summary_csv = open_csv(summary_output, columns);
    columns.erase(columns.begin());
    columns.insert(columns.begin(), {"runs", "samples"});
    auto growth_csv = open_csv(growth_output, columns);
    std::vector<replication::Areas> areas(static_cast<std::size_t>(studies));
    io::Progress progress("pbox_floor", areas.size(), !report.quiet());
    tmcmc::for_each_block(studies, 1, options.threads, [&](auto, auto begin, auto) {
      areas[static_cast<std::size_t>(begin)] = replication::exact_areas(
          posterior, options.seed, static_cast<std::uint32_t>(begin), run_options.runs, samples);
      progress.advance();
    });
    report("P-boxes of {} sets of {} exact draws, {} studies, seed {}, reading {}\n", run_options.runs,
           samples, studies, options.seed, inputs.physics.reading_name);
    report("{:<22} {:>14} {:>14} {:>14}\n", "area", "median", "2.5 %", "97.5 %");
    const auto median = replication::area_quantiles(areas, 0.5),
               low = replication::area_quantiles(areas, 0.025),
               high = replication::area_quantiles(areas, 0.975);
    for (std::size_t p = 0; p < parameter_columns.size(); ++p) {
      report("{:<22} {:>14.6g} {:>14.6g} {:>14.6g}\n", parameter_columns[p], median[p], low[p], high[p]);
    }
    summary_csv.row(0.5, median);
    summary_csv.row(0.025, low);
    summary_csv.row(0.975, high);
    for (std::size_t k = 0; k < areas.size(); ++k) {
      csv.row(k, areas[k]);
    }
    if (pbox_csv) {
      write_pboxes(pbox_csv, replication::exact_runs(posterior, options.seed, 0, run_options.runs, samples),
                   points);
    }
    if (growth_csv) {
      write_growth(growth_csv, posterior, options.seed);
    }
    io::commit_all(csv, pbox_csv, summary_csv, growth_csv);
  });
}
