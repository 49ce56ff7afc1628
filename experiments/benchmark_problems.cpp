// The sampler on problems with known evidence: the paper's setting, better moves, and the
// recommended options, each at the same number of log-likelihoods. Errors of the log-evidence
// against the stated ones, warnings, effective draws, and masses of modes. What to look for: |z|
// above 5 without a warning.
//
// Data: none but the design of Table 1 and the prior of Table 2; the other problems are in closed
// form or by quadrature.

#include "replication/benchmark_problems.hpp"

#include <algorithm>

#include "inputs.hpp"
#include "replication/benchmark_scores.hpp"

using namespace experiments;

namespace {

constexpr std::uint64_t seed_of_rigs = 2026;

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "The paper's sampler, better moves and the recommended options at equal cost on problems with\n"
      "known evidence: friction, Gaussians, bananas, modes, funnel, plateau, spike, corner, frames.",
      "benchmark_problems");
  Report report(app);
  std::string output;
  InputFiles inputs;
  RunOptions run_options;
  run_options.runs = 10;
  std::string only;
  std::string only_sampler;
  long rigs = 20;
  long evaluations = 0;
  long most_evaluations = 100000;
  add_output(app, output, "CSV with one row for each problem, sampler and number of evaluations");
  app.add_option("--problem", only, "Only problems whose name begins so, for example 'banana'")
      ->type_name("TEXT");
  app.add_option("--sampler", only_sampler, "Only this sampler, for example 'better moves'")
      ->type_name("TEXT");
  app.add_option("--rigs", rigs, "Simulated rigs, whose parameters are drawn from the prior")
      ->transform(count(0, 1000));
  app.add_option("--evaluations", evaluations,
                 "Only this number of log-likelihoods, from 2000; 0: 3000, 10000, 31000 and 100000")
      ->transform(count(0, 10000000));
  app.add_option("--most-evaluations", most_evaluations, "Leaves out larger numbers of log-likelihoods")
      ->transform(count(3000, 10000000));
  run_options.add_to(app, 2);
  inputs.add_observations_to(app);
  inputs.add_prior_to(app);

  return report.run(argc, argv, [&] {
    auto problems = replication::closed_form_problems();
    using replication::ReadingName;
    for (const auto name : {ReadingName::as_published, ReadingName::corrected}) {
      const bool is_published = name == ReadingName::as_published;
      const auto reading = replication::reading(name);
      for (auto& p : replication::friction_problems(
               is_published ? "as_published" : "corrected", reading, read_observations(inputs.observations),
               prior_for(inputs, reading), is_published ? static_cast<int>(rigs) : 0, seed_of_rigs)) {
        problems.push_back(std::move(p));
      }
    }
    std::vector<long> budgets{3000, 10000, 31000, 100000};
    if (evaluations > 0) {
      budgets = {evaluations};
    } else {
      budgets.erase(std::upper_bound(budgets.begin(), budgets.end(), most_evaluations), budgets.end());
    }
    using Sampler = replication::BenchmarkSampler;
    std::vector<Sampler> samplers;
    for (const Sampler sampler : {Sampler::published, Sampler::better_moves, Sampler::recommended}) {
      if (only_sampler.empty() || only_sampler == replication::describe(sampler)) {
        samplers.push_back(sampler);
      }
    }
    if (samplers.empty()) {
      throw std::invalid_argument(fmt::format(
          "--sampler: value '{}': expected published, better moves or recommended", only_sampler));
    }
    const auto chosen = [&](const auto& p) { return p.name.starts_with(only); };
    const auto chosen_count = std::count_if(problems.begin(), problems.end(), chosen);
    if (chosen_count == 0) {
      throw std::invalid_argument(fmt::format("--problem: value '{}': expected the name of a problem", only));
    }

    auto csv = open_csv(
        output, {"problem", "kind", "dimensions", "settings_chosen_on_it", "sampler", "evaluations", "runs",
                 "log_evidence", "rms_error", "bias", "rms_z", "worst_z", "worst_z_without_warning", "warned",
                 "effective_draws", "unfinished", "mode_masses_found"});
    report("{} runs of each problem, seed {}\n", run_options.runs, run_options.seed);
    report("{:<24} {:<18} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>7} {:>9} {:>6} {:>6}\n", "", "", "evals",
           "rms", "bias", "rms z", "worst z", "silent z", "warned", "draws", "unfin.", "modes");
    io::Progress progress("benchmark_problems",
                          static_cast<std::size_t>(chosen_count) * budgets.size() * samplers.size() *
                              static_cast<std::size_t>(run_options.runs),
                          !report.quiet());
    const auto options = run_options.study_options();
    for (std::uint32_t index = 0; index < problems.size(); ++index) {
      auto& p = problems[index];
      if (!chosen(p)) {
        continue;
      }
      p.problem = interruptible(std::move(p.problem));
      for (const Sampler sampler : samplers) {
        for (const long budget : budgets) {
          const auto s = replication::score(
              replication::benchmark_runs(p, sampler, budget, index, options, [&] { progress.advance(); }));
          report(
              "{:<24} {:<18} {:>7} {:>9.4f} {:>9.4f} {:>9.2f} {:>9.1f} {:>9.1f} {:>7.3f} {:>9.0f} {:>6.2f} "
              "{:>6}\n",
              p.name, replication::describe(sampler), budget, s.rms_error, s.bias, s.rms_z, s.worst_z,
              s.worst_z_without_warning, s.warned, s.effective_draws, s.unfinished,
              p.mode_masses.empty() ? "" : fmt::format("{:.2f}", s.mode_masses_found));
          csv.row(p.name, p.name.starts_with("rig ") ? "rig" : "problem", p.problem.prior.dimension(),
                  p.tuned_on ? "yes" : "no", replication::describe(sampler), budget, run_options.runs,
                  digits(p.log_evidence), digits(s.rms_error, 6), digits(s.bias, 6), digits(s.rms_z, 6),
                  digits(s.worst_z, 6), digits(s.worst_z_without_warning, 6), s.warned,
                  digits(s.effective_draws, 6), s.unfinished, s.mode_masses_found);
        }
      }
    }
    io::commit_all(csv);
  });
}
