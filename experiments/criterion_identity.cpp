// The two criteria are one equation: N_eff = N / (1 + CoV^2) (population standard deviation), so that CoV =
// 100 % (Eq. 6) and N_eff = N/2 (Eq. 9) choose the same step. Shown on the populations of whole runs: each
// stage solves both rules, as they are written, on the same samples; and whole runs of both samplers use the
// same random stream. With the N-1 standard deviation of the published scripts CoV = 1 is N_eff = N / (2 -
// 1/N) = 500.25 of 1000.
//
// Data: Table 1 and Table 2 as printed, or the reader's own.

#include <cmath>

#include "inputs.hpp"

using namespace experiments;

namespace {

struct Largest {
  double value = 0.0;
  void add(double x) { value = std::max(value, std::fabs(x)); }
};

}  // namespace

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

    Largest step_difference, identity_error, path_difference, sample_effect;
    tmcmc::Index stages = 0;
    tmcmc::Index equal_paths = 0;
    for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(options.runs); ++r) {
      const tmcmc::StreamKey key{options.seed, 0, 0, r};
      struct Row {
        double beta, step_cov, step_ess, step_sample, ess, cov, ess_sample;
      };
      std::vector<Row> rows;
      const auto both_rules = [&](const tmcmc::State& state) {
        const auto log_likelihood = tmcmc::as_span(state.log_likelihood);
        const double remaining = 1.0 - state.beta;
        const auto by_cov = tmcmc::choose_step(log_likelihood, remaining, arms[0].options.criterion);
        const auto by_ess = tmcmc::choose_step(log_likelihood, remaining, arms[1].options.criterion);
        auto with_sample = arms[0].options.criterion;
        with_sample.deviation = tmcmc::Deviation::sample;
        const auto by_sample = tmcmc::choose_step(log_likelihood, remaining, with_sample);
        rows.push_back({state.beta, by_cov.step, by_ess.step, by_sample.step,
                        tmcmc::effective_sample_size(log_likelihood, by_cov.step),
                        tmcmc::coefficient_of_variation(log_likelihood, by_cov.step),
                        tmcmc::effective_sample_size(log_likelihood, by_sample.step)});
        return by_cov;
      };
      const auto first = tmcmc::run(problem, arms[0].options, key, {}, both_rules);
      const auto second = tmcmc::run(problem, arms[1].options, key);
      const double n = static_cast<double>(reading.sampler.samples);
      Largest path;
      rows.resize(first.stages.size());  // the last one may have chosen a step that was not taken
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& row = rows[i];
        const double identity = n / (1.0 + row.cov * row.cov);
        step_difference.add(row.step_ess / row.step_cov - 1.0);
        identity_error.add(identity / row.ess - 1.0);
        sample_effect.add(row.step_sample / row.step_cov - 1.0);
        const bool both = i < second.stages.size();
        path.add(both ? second.stages[i].beta / first.stages[i].beta - 1.0 : 1.0);
        csv.row(r, i + 1, row.beta, row.step_cov, row.step_ess, row.step_sample, row.ess, row.cov, identity,
                row.ess_sample, first.stages[i].beta,
                both ? second.stages[i].beta : std::numeric_limits<double>::quiet_NaN());
      }
      path_difference.add(path.value);
      equal_paths += path.value < 1e-9 && first.stages.size() == second.stages.size() ? 1 : 0;
      stages += static_cast<tmcmc::Index>(rows.size());
    }
    io::commit_all(csv);
    report("{} stages of {} runs, N = {}\n", stages, options.runs, reading.sampler.samples);
    report("largest relative difference\n");
    report("  of the steps that CoV = {} and N_eff = {} N choose from one population: {:.1e}\n",
           sampler.cov_target, sampler.ess_fraction, step_difference.value);
    report("  of N_eff and N / (1 + CoV^2):                                     {:.1e}\n",
           identity_error.value);
    report("  of the steps with standard deviations of N-1 and of N:            {:.1e}\n",
           sample_effect.value);
    report(
        "whole runs of TMCMC and TMCMC-II on one random stream: {} of {} have the same path of beta, "
        "largest\n"
        "relative difference {:.1e}\n",
        equal_paths, options.runs, path_difference.value);
  });
}
