// How much the posterior, the evidence, the p-boxes and their cost owe to the prior of the noise
// levels: the uniform box of Table 2 beside log-uniform noise levels between the same bounds and
// half-normal ones, with a standard deviation of half the upper bound; each by the paper's two
// samplers and the recommended one, and each against quadrature.
//
// Data: Table 1 and the prior of Table 2 as printed in Lye and Marino (ESREL 2023), or the reader's
// own.

#include <array>

#include "inputs.hpp"
#include "pbox/pbox.hpp"
#include "replication/exact_runs.hpp"
#include "replication/noise_priors.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("The box of Table 2 beside log-uniform and half-normal noise levels, against quadrature.",
               "prior_sensitivity");
  Report report(app);
  std::string output;
  ProblemInputs inputs;
  RunOptions run_options;
  std::string pbox_output;
  long points = 101;
  add_output(app, output, "CSV: a row for each prior, sampler and parameter");
  add_output(app, "--pbox-output", pbox_output,
             "CSV of exact distribution functions with the p-boxes of the samplers");
  app.add_option("--points", points, "Grid points of each p-box")->transform(count(2, 1000000));
  run_options.add_to(app, 2);
  inputs.add_to(app);

  return report.run(argc, argv, [&] {
    const auto reading = inputs.physics.reading();
    const auto observations = read_observations(inputs.observations);
    const friction::Likelihood likelihood(observations, reading.physics, reading.infeasible_log_likelihood);
    auto arms = replication::paper_arms(reading);
    arms.push_back({"recommended", tmcmc::recommended_options()});
    for (auto& arm : arms) {
      arm.options.infeasible_level = arms.front().options.infeasible_level;
      arm.options.diagnose = true;  // the bridge estimate of the evidence for all
    }
    auto csv =
        open_csv(output, {"prior", "sampler", "parameter", "exact_mean", "exact_sd", "mean",
                          "mean_standard_error", "area", "exact_area", "exact_log_evidence", "log_evidence",
                          "log_evidence_standard_error", "log_evidence_rms", "iterations", "evaluations"});
    auto boxes = open_csv(pbox_output, {"prior", "sampler", "parameter", "x", "cdf", "lower", "upper"});
    report("{:<12} {:<12} {:>26} {:>9} {:>7} {:>7} {:>12} {:>12}\n", "noise levels", "sampler",
           "log-evidence (exact, mean)", "rms error", "stages", "cost", "area F_mu", "area omega_n");
    const auto options = run_options.study_options();
    std::uint32_t number = 0;
    const auto box = prior_for(inputs, reading);
    static_cast<void>(bounds_of(box, "prior_sensitivity"));
    const auto priors = replication::noise_priors(box);
    io::Progress progress("prior_sensitivity", priors.size() * arms.size(), !report.quiet());
    for (const auto& [name, prior] : priors) {
      const auto exact = exact_posterior_for(inputs, likelihood, prior);
      std::array<double, friction::parameter_count> floors{};
      for (std::size_t p = 0; p < floors.size(); ++p) {
        floors[p] = replication::exact_area(exact.marginal(static_cast<friction::Parameter>(p)), options.seed,
                                            number, options.runs, 1000);
      }
      for (const auto& arm : arms) {
        const auto runs = replication::run_arm({likelihood, prior}, arm, number++, options);
        progress.advance();
        const auto areas = replication::pbox_areas(runs, options.threads);
        const double truth = exact.log_evidence();
        const auto evidence = replication::error_over_runs(
            runs, [](const auto& run) { return run.result.evidence.log_evidence; }, truth);
        const double stages = replication::error_over_runs(runs, [](const auto& run) {
                                return static_cast<double>(run.iterations());
                              }).mean;
        const double cost = replication::error_over_runs(runs, [](const auto& run) {
                              return static_cast<double>(run.result.final.evaluations);
                            }).mean;
        report("{:<12} {:<12} {:>13.3f} {:>12.3f} {:>9.3f} {:>7.2f} {:>7.0f} {:>12.5f} {:>12.5f}\n", name,
               arm.name, truth, evidence.mean, evidence.root_mean_square, stages, cost, areas[0], areas[1]);
        for (std::size_t p = 0; p < floors.size(); ++p) {
          const auto j = static_cast<Eigen::Index>(p);
          const auto& marginal = exact.marginal(static_cast<friction::Parameter>(p));
          const auto mean = replication::error_over_runs(runs, [j](const auto& run) { return run.mean[j]; });
          csv.row(name, arm.name, parameter_columns[p], digits(marginal.mean()),
                  digits(marginal.standard_deviation()), mean.mean, mean.standard_error, areas[j], floors[p],
                  digits(truth), evidence.mean, evidence.standard_error, evidence.root_mean_square, stages,
                  cost);
          if (boxes) {
            const auto envelope = pbox::envelope(replication::ecdfs_of(runs, j));
            for (const double x :
                 statistics::evenly_spaced(marginal.quantile(0.0005), marginal.quantile(0.9995), points)) {
              const auto bounds = pbox::evaluate(envelope, x);
              boxes->row(name, arm.name, parameter_columns[p], x, marginal.cdf(x), bounds.lower,
                         bounds.upper);
            }
          }
        }
      }
    }
    io::commit_all(csv, boxes);
  });
}
