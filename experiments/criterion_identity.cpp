// The two criteria are one equation: N_eff = N / (1 + CoV^2) (population standard deviation), so
// that CoV = 100 % (Eq. 6) and N_eff = N/2 (Eq. 9) choose the same step. Shown on the populations
// of whole runs: each stage solves both rules, as they are written, on the same samples; and whole
// runs of both samplers use the same random stream. With the N-1 standard deviation of the
// published scripts CoV = 1 is N_eff = N / (2 - 1/N) = 500.25 of 1000.
//
// Data: Table 1 and Table 2 as printed, or the reader's own.

#include "replication/criterion_identity.hpp"

#include "inputs.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("Both criteria on the same populations and the same random stream: steps, N_eff, CoV, beta.",
               "criterion_identity");
  Report report(app);
  std::string output;
  ProblemInputs inputs;
  SamplerOptions sampler;
  RunOptions run_options;
  run_options.runs = 10;
  add_output(app, output, "CSV with one row for each stage of each run of TMCMC, and TMCMC-II beside it");
  inputs.add_to(app);
  run_options.add_to(app);
  sampler.add_to(app);

  return report.run(argc, argv, [&] {
    replication::Reading reading = inputs.physics.reading();
    sampler.apply(reading);
    if (!sampler.given("deviation")) {
      reading.sampler.criterion.deviation =
          tmcmc::Deviation::population;  // the identity; N-1 stands beside it
    }
    const auto problem = interruptible(
        replication::problem(reading, read_observations(inputs.observations), prior_for(inputs, reading)));
    const auto arms = replication::paper_arms(reading, sampler.cov_target, sampler.ess_fraction);
    const auto options = run_options.study_options();
    options.validate();
    auto csv = open_csv(
        output, {"run", "stage", "beta", "step_cov", "step_ess", "step_cov_sample", "effective_sample_size",
                 "coefficient_of_variation", "samples_over_one_plus_cov_squared",
                 "effective_sample_size_sample", "beta_tmcmc", "beta_tmcmc_ii"});

    std::vector<replication::RunUnderBothRules> runs;
    for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(options.runs); ++r) {
      runs.push_back(replication::run_under_both_rules(problem, arms[0].options, arms[1].options,
                                                       {options.seed, 0, 0, r}));
      std::size_t number = 0;
      for (const auto& s : runs.back().stages) {
        csv.row(r, ++number, s.beta, s.step_cov, s.step_ess, s.step_cov_sample, s.effective_sample_size,
                s.coefficient_of_variation, s.samples_over_one_plus_cov_squared,
                s.effective_sample_size_sample, s.beta_tmcmc, s.beta_tmcmc_ii);
      }
    }
    io::commit_all(csv);
    const auto largest = replication::rule_differences(runs);
    report("{} stages of {} runs, N = {}\n", largest.stages, options.runs, reading.sampler.samples);
    report("largest relative difference\n");
    report("  of the steps that CoV = {} and N_eff = {} N choose from one population: {:.1e}\n",
           sampler.cov_target, sampler.ess_fraction, largest.of_steps);
    report("  of N_eff and N / (1 + CoV^2):                                     {:.1e}\n",
           largest.of_identity);
    report("  of the steps with standard deviations of N-1 and of N:            {:.1e}\n",
           largest.of_sample_deviation);
    report(
        "whole runs of TMCMC and TMCMC-II on one random stream: {} of {} have the same path of beta, "
        "largest\n"
        "relative difference {:.1e}\n",
        largest.same_paths, options.runs, largest.of_paths);
  });
}
