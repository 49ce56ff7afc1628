#include "replication/benchmark_scores.hpp"

#include <algorithm>
#include <cmath>

#include "errors/invalid_value.hpp"
#include "tmcmc/parallel.hpp"
#include "tmcmc/sampler.hpp"

namespace replication {

namespace {

double worst_mode_mass(const BenchmarkProblem& problem, const tmcmc::Population& points,
                       const Eigen::VectorXd& weights) {
  std::vector<double> masses(problem.mode_masses.size(), 0.0);
  for (tmcmc::Index i = 0; !masses.empty() && i < points.rows(); ++i) {
    masses[problem.mode_of(points.row(i))] += weights[i] / static_cast<double>(points.rows());
  }
  double worst = 0.0;
  for (std::size_t k = 0; k < masses.size(); ++k) {
    worst = std::max(worst, std::fabs(masses[k] - problem.mode_masses[k]));
  }
  return worst;
}

tmcmc::Options options_of(const BenchmarkProblem& problem, BenchmarkSampler sampler,
                          tmcmc::Index evaluations) {
  tmcmc::Options options;
  if (sampler == BenchmarkSampler::published) {
    options.samples = std::max<tmcmc::Index>(evaluations / 31, 2);
    options.criterion = tmcmc::effective_sample_size_rule(0.5);
    options.evaluation_budget = evaluations;
  } else {
    options = tmcmc::recommended_moves(evaluations);
  }
  if (sampler == BenchmarkSampler::recommended) {
    options.finish = tmcmc::IndependentDraws{};
  }
  options.infeasible_level = problem.infeasible_level;
  return options;
}

BenchmarkRun one_run(const BenchmarkProblem& problem, BenchmarkSampler sampler, tmcmc::Index evaluations,
                     const tmcmc::StreamKey& key) {
  BenchmarkRun run;
  try {
    const auto result = tmcmc::run(problem.problem, options_of(problem, sampler, evaluations), key);
    run.error = result.evidence.log_evidence - problem.log_evidence;
    run.standard_error = result.evidence.standard_error;
    run.effective_draws = result.measurement ? result.measurement->effective_sample_size
                                             : result.diagnostics.effective_sample_size.minCoeff();
    run.warned = !result.diagnostics.warnings.empty();
    run.finished = result.stop == tmcmc::StopReason::completed;
    run.worst_mode_mass = worst_mode_mass(problem, result.final.points, result.weights);
  } catch (const tmcmc::SamplingError&) {
    run.finished = false;
    run.warned = true;
  }
  return run;
}

}  // namespace

const char* describe(BenchmarkSampler sampler) {
  switch (sampler) {
    case BenchmarkSampler::published:
      return "published";
    case BenchmarkSampler::better_moves:
      return "better moves";
    case BenchmarkSampler::recommended:
      return "recommended";
  }
  return "";
}

std::vector<BenchmarkRun> benchmark_runs(const BenchmarkProblem& problem, BenchmarkSampler sampler,
                                         tmcmc::Index evaluations, std::uint32_t arm,
                                         const StudyOptions& options, const RunObserver& observer) {
  options.validate();
  std::vector<BenchmarkRun> runs(static_cast<std::size_t>(options.runs));
  tmcmc::for_each_block(
      options.runs, 1, options.threads, [&](tmcmc::Index, tmcmc::Index begin, tmcmc::Index end) {
        for (tmcmc::Index i = begin; i < end; ++i) {
          runs[static_cast<std::size_t>(i)] = one_run(problem, sampler, evaluations,
                                                      {.seed = options.seed,
                                                       .study = options.study,
                                                       .arm = arm,
                                                       .run = static_cast<std::uint32_t>(i)});
          if (observer) {
            observer();
          }
        }
      });
  return runs;
}

BenchmarkScore score(const std::vector<BenchmarkRun>& runs) {
  if (runs.empty()) {
    throw errors::InvalidValue("runs", "", "at least one");
  }
  BenchmarkScore s;
  const auto count = static_cast<double>(runs.size());
  double finished = 0.0;
  for (const BenchmarkRun& run : runs) {
    s.warned += run.warned ? 1.0 : 0.0;
    if (!run.finished) {
      s.unfinished += 1.0;
      continue;
    }
    finished += 1.0;
    const double z = run.error / run.standard_error;
    s.rms_error += run.error * run.error;
    s.bias += run.error;
    s.rms_z += z * z;
    s.worst_z = std::max(s.worst_z, std::fabs(z));
    s.worst_z_without_warning =
        run.warned ? s.worst_z_without_warning : std::max(s.worst_z_without_warning, std::fabs(z));
    s.effective_draws += run.effective_draws;
    s.mode_masses_found += run.worst_mode_mass <= 0.05 ? 1.0 : 0.0;
  }
  s.warned /= count;
  s.unfinished /= count;
  s.rms_error = std::sqrt(s.rms_error / finished);
  s.bias /= finished;
  s.rms_z = std::sqrt(s.rms_z / finished);
  s.effective_draws /= finished;
  s.mode_masses_found /= finished;
  return s;
}

}  // namespace replication
