// Does the sampler sample the posterior? Simulation-based calibration (Talts et al. 2018) of the
// published setting, of better moves and of the recommended options, every run counted, also those
// that warn: parameters from the prior (Table 2), observations from the model at these (the design
// of Table 1), rank of the truth among posterior draws. Uniform ranks: calibrated. The published
// setting (N = 1000, N_eff = N/2, 3 steps of scale 0.2) and the others get the same 31 000
// evaluations and the same simulated observations.
//
// Data: design of Table 1 and prior of Table 2 as printed in Lye and Marino (ESREL 2023), or the
// reader's own.

#include "replication/calibration.hpp"

#include "inputs.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app(
      "Simulation-based calibration of the published setting, of better moves and of the recommended "
      "options.",
      "calibration");
  Report report(app);
  std::string output;
  ProblemInputs inputs;
  RunOptions run_options;
  replication::CalibrationOptions options;
  std::string ranks_output;
  add_output(app, output,
             "CSV with one row for each sampler and parameter: chi^2 of the ranks, p-values, coverage");
  add_output(app, "--ranks-output", ranks_output, "CSV of the rank histograms with their 99 % bands");
  app.add_option("--runs", options.replications, "Simulated data sets")->transform(count());
  app.add_option("--draws", options.draws, "Posterior draws that the truth is ranked among")
      ->transform(count(1, 1000000));
  app.add_option("--bins", options.bins, "Bins of the rank histograms; a divisor of draws + 1")
      ->transform(count(2, 1000000));
  run_options.add_seed_to(app);
  run_options.add_threads_to(app);
  inputs.add_to(app);

  return report.run(argc, argv, [&] {
    const auto reading = inputs.physics.reading();
    const auto observations = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, reading);
    options.seed = run_options.seed;
    options.threads = run_options.study_options().threads;
    std::vector<replication::Arm> arms = {{"published", replication::paper_arms(reading).back().options},
                                          {"better moves", tmcmc::recommended_moves()},
                                          {"recommended", tmcmc::recommended_options()}};
    for (auto& arm : arms) {
      arm.options.infeasible_level = reading.infeasible_log_likelihood;
      arm.options.diagnose = true;
    }

    auto csv = open_csv(output, {"sampler", "parameter", "chi_squared", "coverage_50", "coverage_90",
                                 "p_chi_squared", "p_coverage_50", "p_coverage_90", "smallest_p_holm",
                                 "calibrated", "replications", "unfinished", "warned"});
    auto ranks_csv = open_csv(ranks_output, {"sampler", "parameter", "place", "count", "expected", "band_low",
                                             "band_high", "edge", "ecdf_difference", "ecdf_band"});
    report("{} simulated data sets, {} draws each, seed {}, reading {}\n", options.replications,
           options.draws, options.seed, inputs.physics.reading_name);
    report("{:<12} {:<22} {:>7} {:>8} {:>8} {:>9} {:>9} {:>9}\n", "", "", "chi^2", "50 %", "90 %", "p(chi^2)",
           "p(50 %)", "p(90 %)");
    io::Progress progress("calibration", arms.size() * static_cast<std::size_t>(options.replications),
                          !report.quiet());
    std::uint32_t arm_index = 0;
    for (const auto& arm : arms) {
      const auto result = replication::calibrate(observations, reading, prior, arm, arm_index++, options,
                                                 [&] { progress.advance(); });
      const auto judged = replication::judge_calibration(result, options);
      const char* verdict = judged.is_calibrated ? "yes" : "no";
      for (std::size_t j = 0; j < judged.histograms.size(); ++j) {
        const auto& h = judged.histograms[j];
        report("{:<12} {:<22} {:>7.1f} {:>8.3f} {:>8.3f} {:>9.2g} {:>9.2g} {:>9.2g}\n", arm.name,
               parameter_columns[j], h.chi_squared, h.coverage_50, h.coverage_90, h.p_chi_squared,
               h.p_coverage_50, h.p_coverage_90);
        csv.row(arm.name, parameter_columns[j], h.chi_squared, h.coverage_50, h.coverage_90,
                digits(h.p_chi_squared, 4), digits(h.p_coverage_50, 4), digits(h.p_coverage_90, 4),
                digits(judged.smallest_p, 4), verdict, options.replications, result.unfinished,
                result.warned);
        for (const auto& bin : replication::rank_bins(h)) {
          ranks_csv.row(arm.name, parameter_columns[j], bin.place, bin.count, bin.expected, bin.band_low,
                        bin.band_high, bin.edge, bin.ecdf_difference, bin.ecdf_band);
        }
      }
      report(
          "{:<12} smallest p after Holm {:.2g}: calibrated {}; {} of {} runs ended before beta = 1, {} "
          "warned, all counted\n",
          arm.name, judged.smallest_p, verdict, result.unfinished, options.replications, result.warned);
    }
    io::commit_all(csv, ranks_csv);
  });
}
