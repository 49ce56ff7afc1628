// The recommended setting of the sampler on problems with known answers: error of the log-evidence against its own standard
// error, Kolmogorov distance of the pooled samples from the exact marginals, and mass of the modes where there are two.
//
// Data: none; the problems are in closed form, but for the two-storey shear frame of the TMCMC literature (quadrature).

#include "replication/benchmark_problems.hpp"

#include <algorithm>
#include <cmath>

#include "command_line.hpp"

using namespace experiments;

namespace {

/// Largest distance between the samples' empirical distribution and a distribution function.
double kolmogorov(std::vector<double> x, const std::function<double(double)>& cdf) {
  std::sort(x.begin(), x.end());
  const double n = static_cast<double>(x.size());
  double distance = 0.0;
  constexpr std::size_t places = 400;  // the distance is looked for at so many quantiles of the samples
  for (std::size_t k = 0; k < places; ++k) {
    const std::size_t i = (2 * k + 1) * x.size() / (2 * places);
    distance = std::max(distance, std::fabs(cdf(x[i]) - (static_cast<double>(i) + 0.5) / n));
  }
  return distance;
}

}  // namespace

int main(int argc, char** argv) {
  Program program(
      "benchmark_problems",
      "The recommended setting on problems with known evidence and marginals: Gaussians in 2, 10 and\n"
      "50 dimensions, two normals, a banana, a posterior in a corner of its box, a two-storey frame.");
  RunOptions run_options;
  run_options.runs = 20;
  std::string only;
  program.add_output("CSV with one row a problem: errors of the log-evidence, distances, masses of modes");
  program.add_text("--problem", only, "TEXT", "Only the problem of this name, for example 'banana'");
  run_options.add_to(program);

  return program.run(argc, argv, [&] {
    auto csv = open_csv(program.output(),
                        {"problem", "dimensions", "evaluations", "stages", "log_evidence", "mean_error",
                         "rms_error", "rms_standard_error", "within_2_standard_errors", "largest_distance",
                         "first_mode_mass", "mean_mass_found", "sd_of_mass_found"});
    program.report("{} runs of each problem, seed {}\n", run_options.runs, run_options.seed);
    program.report("{:<24} {:>8} {:>7} {:>9} {:>8} {:>8} {:>8} {:>9} {:>16}\n", "", "evals", "stages", "ln Z",
                   "error", "rms", "s.e.", "distance", "mass of mode 1");
    const auto problems = replication::benchmark_problems();
    const auto chosen = [&](const auto& p) { return only.empty() || p.name == only; };
    if (std::none_of(problems.begin(), problems.end(), chosen)) {
      throw std::invalid_argument(fmt::format("--problem: value '{}': expected the name of a problem", only));
    }
    io::Progress progress("benchmark_problems", problems.size() * static_cast<std::size_t>(run_options.runs),
                          !program.quiet());
    for (std::uint32_t index = 0; index < problems.size(); ++index) {
      const auto& p = problems[index];
      if (!chosen(p)) {
        continue;
      }
      const auto runs = replication::run_arm(p.problem, {p.name, p.options}, index,
                                             run_options.study_options(), [&] { progress.advance(); });
      std::vector<double> errors, standard_errors, masses;
      double inside = 0.0, evaluations = 0.0, stages = 0.0;
      const double count = static_cast<double>(runs.size());
      for (const auto& run : runs) {
        const auto& evidence = run.result.evidence;
        errors.push_back(evidence.log_evidence - p.log_evidence);
        standard_errors.push_back(evidence.standard_error);
        inside += std::fabs(errors.back()) <= 2.0 * evidence.standard_error ? 1.0 / count : 0.0;
        evaluations += static_cast<double>(run.result.final.evaluations) / count;
        stages += static_cast<double>(run.iterations()) / count;
        const auto& points = run.result.final.points;
        double in_mode = 0.0;
        for (Eigen::Index i = 0; p.in_first_mode && i < points.rows(); ++i) {
          in_mode += p.in_first_mode(points.row(i)) ? 1.0 / static_cast<double>(points.rows()) : 0.0;
        }
        masses.push_back(p.in_first_mode ? in_mode : 1.0);
      }
      double distance = 0.0;
      for (Eigen::Index j = 0; j < p.problem.prior.dimension(); ++j) {
        std::vector<double> pooled;
        for (const auto& run : runs) {
          const auto column = run.result.final.points.col(j);
          pooled.insert(pooled.end(), column.begin(), column.end());
        }
        distance =
            std::max(distance, kolmogorov(std::move(pooled), [&](double x) { return p.marginal_cdf(j, x); }));
      }
      const auto mean_error = replication::moments(errors).mean;
      const auto mass = replication::moments(masses);
      program.report("{:<24} {:>8.0f} {:>7.1f} {:>9.3f} {:>8.3f} {:>8.3f} {:>8.3f} {:>9.4f} {:>16}\n", p.name,
                     evaluations, stages, p.log_evidence, mean_error, statistics::root_mean_square(errors),
                     statistics::root_mean_square(standard_errors), distance,
                     p.in_first_mode ? fmt::format("{:.3f} +- {:.3f}, {:.3f}", mass.mean,
                                                   mass.standard_deviation, p.first_mode_mass)
                                     : "");
      if (csv) {
        csv->row(p.name, p.problem.prior.dimension(), evaluations, stages, digits(p.log_evidence), mean_error,
                 statistics::root_mean_square(errors), statistics::root_mean_square(standard_errors), inside,
                 digits(distance, 4), digits(p.first_mode_mass, 6), mass.mean, mass.standard_deviation);
      }
    }
    io::commit_all(csv);
  });
}
