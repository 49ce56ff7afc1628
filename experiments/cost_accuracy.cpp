// What makes the p-boxes smaller, and at what cost: likelihood evaluations of a run against the
// p-box areas (Table 3, Eq. 25), the errors of the posterior means and the error of the
// log-evidence, all measured against the exact posterior. The criterion, the number of samples and
// of steps, scale, resampling and kind of the moves are varied one at a time from the published
// setting (N = 1000, N_eff = N/2, 3 steps); then the moves are improved one by one; then the best
// of these, and the recommended options under either rule (N_eff = N/2 and CoV = 1), are given
// several budgets. Of weighted samples, 1000 are drawn for each run, as many as the paper's runs
// have (multinomial resampling, ten times over: areas are given over these).
//
// Data: Table 1 and the prior of Table 2 as printed in Lye and Marino (ESREL 2023), or the reader's
// own.

#include <algorithm>

#include "inputs.hpp"
#include "replication/accuracy.hpp"
#include "replication/verdict.hpp"

using namespace experiments;

namespace {

/// Median, smallest and largest p-box area of one parameter over the studies.
struct AreaRange {
  double median, lowest, highest;
};

AreaRange range_of(std::vector<double> areas) {
  std::sort(areas.begin(), areas.end());
  return {replication::sample_quantile(areas, 0.5), areas.front(), areas.back()};
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Likelihood evaluations against p-box areas and errors, for settings of the sampler from the\n"
      "published one to the recommended one, all against the exact posterior.",
      "cost_accuracy");
  Report report(app);
  std::string output;
  InputFiles inputs;
  PhysicsOptions physics;
  RunOptions run_options;
  long studies = 4;
  std::string only;
  add_output(app, output,
             "CSV with one row for each setting: evaluations, p-box areas, errors of means and log-evidence");
  app.add_option("--studies", studies, "K, studies of R runs a setting; areas are given over these")
      ->transform(count(1, 1000000));
  app.add_option("--family", only, "Only settings of this family, for example 'better moves'")
      ->type_name("TEXT");
  run_options.add_to(app, 2);
  inputs.add_observations_to(app);
  inputs.add_prior_to(app);
  physics.add_to(app);

  return report.run(argc, argv, [&] {
    const auto reading = physics.reading();
    const auto observations = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, reading);
    const auto problem = interruptible(replication::problem(reading, observations, prior));
    const auto truth = replication::known_posterior(
        exact_posterior_for(inputs, friction::Likelihood(observations, reading.physics), prior));
    auto published = reading.sampler;
    published.infeasible_level = reading.infeasible_log_likelihood;
    const auto settings = replication::configurations(published);
    const auto chosen = [&](const auto& s) { return only.empty() || s.family == only; };
    const auto chosen_count = std::count_if(settings.begin(), settings.end(), chosen);
    if (chosen_count == 0) {
      throw std::invalid_argument("--family: value '" + only + "': expected the family of a setting");
    }

    std::vector<std::string> columns = {"family", "setting", "evaluations", "most_evaluations", "stages"};
    for (const char* quantity :
         {"area_", "area_lowest_", "area_highest_", "bias_sd_", "spread_sd_", "effective_size_"}) {
      for (const auto& name : parameter_columns) {
        columns.push_back(quantity + name);
      }
    }
    columns.insert(columns.end(), {"log_evidence_bias", "log_evidence_rms", "log_mean_weights_rms",
                                   "standard_error_rms", "runs_with_warning"});
    auto csv = open_csv(output, columns);
    report("{} studies of {} runs a setting, seed {}, reading {}; exact log-evidence {:.4f}\n", studies,
           run_options.runs, run_options.seed, physics.reading_name, truth.log_evidence);
    report("{:<20} {:<28} {:>9} {:>7} {:>10} {:>10} {:>8} {:>8} {:>8} {:>8}\n", "", "", "evals", "stages",
           "area F_mu", "area w_n", "sd means", "lnZ bias", "lnZ rms", "s.e.");
    io::Progress progress("cost_accuracy", static_cast<std::size_t>(chosen_count * studies), !report.quiet());
    for (std::uint32_t s = 0; s < settings.size();
         ++s) {  // a setting has its stream, whatever others are run
      if (!chosen(settings[s])) {
        continue;
      }
      std::vector<replication::Run> runs;
      std::vector<std::vector<double>> areas(parameter_columns.size());
      for (long k = 0; k < studies; ++k) {
        auto options = run_options.study_options();
        options.study = static_cast<std::uint32_t>(k);
        auto batch = replication::run_arm(problem, {settings[s].family, settings[s].options}, s, options);
        for (const auto& of_study : replication::paper_sized_areas(batch, s, options)) {
          for (std::size_t p = 0; p < areas.size(); ++p) {
            areas[p].push_back(of_study[static_cast<Eigen::Index>(p)]);
          }
        }
        std::move(batch.begin(), batch.end(), std::back_inserter(runs));
        progress.advance();
      }
      const auto a = replication::accuracy(runs, truth);
      std::vector<double> medians, lowest, highest;
      for (const auto& of_parameter : areas) {
        const auto range = range_of(of_parameter);
        medians.push_back(range.median);
        lowest.push_back(range.lowest);
        highest.push_back(range.highest);
      }
      report("{:<20} {:<28} {:>9.0f} {:>7.1f} {:>10.5f} {:>10.6f} {:>8.4f} {:>8.4f} {:>8.4f} {:>8.4f}\n",
             settings[s].family, settings[s].value, a.evaluations, a.stages, medians[0], medians[1],
             a.mean_spread[0], a.evidence_bias, a.evidence_rms, a.standard_error_rms);
      csv.row(settings[s].family, settings[s].value, a.evaluations, a.most_evaluations, a.stages, medians,
              lowest, highest, tmcmc::as_span(a.mean_bias), tmcmc::as_span(a.mean_spread),
              tmcmc::as_span(a.effective_size), a.evidence_bias, a.evidence_rms, a.weight_evidence_rms,
              a.standard_error_rms, a.warned);
    }
    io::commit_all(csv);
  });
}
