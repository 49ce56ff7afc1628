// The sampling study behind Tables 3 and 4 and Figures 3 to 5: R runs (50) of TMCMC and of TMCMC-II
// with N samples (1000) each, for the posterior of friction force, natural frequency and the two
// noise levels (Eqs. 1-9, 24).
//
// Data: Table 1 and the prior of Table 2 as printed in Lye and Marino (ESREL 2023), or the reader's
// own.

#include "inputs.hpp"

using namespace experiments;

namespace {

/// Reports the diagnostics of the runs (--diagnose).
void report_diagnoses(const Report& report, const std::vector<replication::Run>& runs) {
  const auto d = replication::diagnoses_of(runs);
  report("  bridge log-evidence {:.3f} (sd over runs {:.3f}), standard error of a run {:.3f}\n",
         d.log_evidence.mean, d.log_evidence.standard_deviation, d.standard_error);
  report("  smallest effective sample size of a parameter and run: {:.0f}\n", d.smallest_effective_size);
  report("  runs with warnings:");
  for (const auto& [kind, count] : d.warned) {
    report("  {}: {}", kind, count);
  }
  report("{}\n", d.warned.empty() ? "  none" : "");
}

void report_arm(const Report& report, const replication::Arm& arm, const std::vector<replication::Run>& runs,
                int threads) {
  const Eigen::VectorXd areas = replication::pbox_areas(runs, threads);
  std::vector<double> evidence;
  tmcmc::Index evaluations = 0;
  for (const auto& run : runs) {
    evidence.push_back(run.result.final.log_evidence);
    evaluations += run.result.final.evaluations;
  }
  const auto log_evidence = replication::moments(evidence);
  report("\n{}: log-evidence {:.3f} (sd over runs {:.3f}), {:.0f} likelihood evaluations a run\n", arm.name,
         log_evidence.mean, log_evidence.standard_deviation,
         static_cast<double>(evaluations) / static_cast<double>(runs.size()));
  report("  {:<22} {:>12} {:>12} {:>14} {:>14}\n", "", "mean", "sd of means", "posterior sd", "p-box area");
  for (std::size_t j = 0; j < parameter_columns.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    std::vector<double> means, sds;
    for (const auto& run : runs) {
      means.push_back(run.mean[column]);
      sds.push_back(run.standard_deviation[column]);
    }
    const auto m = replication::moments(means);
    report("  {:<22} {:>12.5f} {:>12.5f} {:>14.5f} {:>14.6f}\n", parameter_columns[j], m.mean,
           m.standard_deviation, replication::moments(sds).mean, areas[column]);
  }
  report("  iterations:");
  for (const auto& [iterations, count] : replication::iteration_counts(runs)) {
    report("  {} in {} runs", iterations, count);
  }
  report("\n");
  if (arm.options.diagnose) {
    report_diagnoses(report, runs);
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Runs TMCMC (CoV = 100 %, Eq. 6) and TMCMC-II (N_eff = N/2, Eq. 9) on the friction benchmark.\n"
      "Source of Tables 3-5 and Figures 3-5.",
      "sampling_study");
  Report report(app);
  std::string output;
  ProblemInputs inputs;
  SamplerOptions sampler;
  RunOptions run_options;
  std::string runs_output, stages_output;
  add_output(app, output,
             "CSV of all posterior samples: sampler, run, the four parameters, and weight with --finish "
             "independent");
  add_output(app, "--runs-output", runs_output,
             "CSV with one row for each run: iterations, log-evidence, moments");
  add_output(app, "--stages-output", stages_output, "CSV with one row for each stage of each run");
  inputs.add_to(app);
  run_options.add_to(app);
  sampler.add_to(app);

  return report.run(argc, argv, [&] {
    replication::Reading reading = inputs.physics.reading();
    sampler.apply(reading);
    const auto observations = read_observations(inputs.observations);
    const auto problem =
        interruptible(replication::problem(reading, observations, prior_for(inputs, reading)));
    const auto arms = replication::paper_arms(reading, sampler.cov_target, sampler.ess_fraction);
    const auto options = run_options.study_options();

    const bool is_weighted = std::holds_alternative<tmcmc::IndependentDraws>(reading.sampler.finish);
    auto samples_csv = open_csv(output, replication::sample_columns(is_weighted));
    auto runs_csv = open_csv(runs_output, replication::run_columns(sampler.diagnose));
    auto stages_csv = open_csv(stages_output, replication::stage_columns());

    report("{} runs of each sampler, N = {}, seed {}, reading {}, {} observations\n", options.runs,
           reading.sampler.samples, options.seed, inputs.physics.reading_name, observations.size());
    io::Progress progress("sampling_study", arms.size() * static_cast<std::size_t>(options.runs),
                          !report.quiet());
    std::vector<std::vector<replication::Run>> results;
    for (std::uint32_t a = 0; a < arms.size(); ++a) {
      results.push_back(replication::run_arm(problem, arms[a], a, options, [&] { progress.advance(); }));
    }
    for (std::size_t a = 0; a < arms.size(); ++a) {
      for (std::size_t i = 0; i < results[a].size(); ++i) {
        if (samples_csv) {
          replication::write_samples(*samples_csv, arms[a].name, i, results[a][i], is_weighted);
        }
        if (runs_csv) {
          replication::write_run(*runs_csv, arms[a].name, i, results[a][i], sampler.diagnose);
        }
        if (stages_csv) {
          replication::write_stages(*stages_csv, arms[a].name, i, results[a][i]);
        }
      }
      report_arm(report, arms[a], results[a], options.threads);
    }
    io::commit_all(samples_csv, runs_csv, stages_csv);
  });
}
