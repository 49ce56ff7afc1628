// What the published script of TMCMC-II does: it solves N_eff = N in place of Eq. 9's N_eff = N/2.
// Only equal weights have N_eff = N, so the step of beta is 0, and the sampler never ends; a cap on
// the stages ends it cleanly. Target fractions close to 1 show how the number of stages grows on
// the way there.
//
// Data: Table 1 and the prior of Table 2 as printed, or the reader's own.

#include "inputs.hpp"
#include "tmcmc/diagnostics.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("Stages of TMCMC-II as its target N_eff / N goes to 1, where it never ends.",
               "endless_criterion");
  Report report(app);
  std::string output;
  ProblemInputs inputs;
  SamplerOptions sampler;
  RunOptions run_options;
  sampler.values["max_stages"] = "200";
  sampler.values["minimum_step"] = "0";  // a step of 0 is what is to be shown
  add_output(app, output, "CSV: target_fraction, stages, beta, smallest_step, stop");
  inputs.add_to(app);
  run_options.add_seed_to(app);
  sampler.add_to(app);

  return report.run(argc, argv, [&] {
    replication::Reading reading = inputs.physics.reading();
    sampler.apply(reading);
    const auto problem = interruptible(
        replication::problem(reading, read_observations(inputs.observations), prior_for(inputs, reading)));
    auto csv = open_csv(output, {"target_fraction", "stages", "beta", "smallest_step", "stop"});
    report("At most {} stages, N = {}\n{:>16} {:>8} {:>10} {:>14}  {}\n", reading.sampler.max_stages,
           reading.sampler.samples, "N_eff target / N", "stages", "beta", "smallest step", "end");
    for (const double fraction : {0.5, 0.75, 0.9, 0.95, 0.99, 0.999, 1.0}) {
      const auto arm = replication::paper_arms(reading, sampler.cov_target, fraction)[1];
      const auto result = tmcmc::run(problem, arm.options, {.seed = run_options.seed, .arm = 1});
      double smallest = 1.0;
      for (const auto& stage : result.stages) {
        smallest = std::min(smallest, stage.step);
      }
      const char* stop = tmcmc::describe(result.stop);
      report("{:>16} {:>8} {:>10.4g} {:>14.3g}  {}\n", fraction, result.stages.size(), result.final.beta,
             smallest, stop);
      csv.row(fraction, result.stages.size(), result.final.beta, smallest, stop);
    }
    io::commit_all(csv);
  });
}
