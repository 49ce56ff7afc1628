#include "replication/criterion_identity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tmcmc/log_weights.hpp"
#include "tmcmc/sampler.hpp"
#include "tmcmc/tempering_step.hpp"

namespace replication {

namespace {

/// The result of each rule for a population; beta after the stage is not known yet.
/// \param step_cov  the step that the criterion `cov` chooses
StageUnderBothRules stage_of(const tmcmc::State& state, double step_cov, const tmcmc::Criterion& cov,
                             const tmcmc::Criterion& ess) {
  const auto log_likelihood = tmcmc::as_span(state.log_likelihood);
  const auto step = [&](const tmcmc::Criterion& criterion) {
    return tmcmc::choose_step(log_likelihood, 1.0 - state.beta, criterion).step;
  };
  auto sample = cov;
  sample.deviation = tmcmc::Deviation::sample;
  StageUnderBothRules stage{
      .beta = state.beta, .step_cov = step_cov, .step_ess = step(ess), .step_cov_sample = step(sample)};
  stage.effective_sample_size = tmcmc::effective_sample_size(log_likelihood, stage.step_cov);
  stage.coefficient_of_variation = tmcmc::coefficient_of_variation(log_likelihood, stage.step_cov);
  stage.samples_over_one_plus_cov_squared =
      static_cast<double>(log_likelihood.size()) /
      (1.0 + stage.coefficient_of_variation * stage.coefficient_of_variation);
  stage.effective_sample_size_sample = tmcmc::effective_sample_size(log_likelihood, stage.step_cov_sample);
  return stage;
}

void raise(double& largest, double difference) {
  largest = std::max(largest, std::fabs(difference));
}

}  // namespace

RunUnderBothRules run_under_both_rules(const tmcmc::Problem& problem, const tmcmc::Options& by_cov,
                                       const tmcmc::Options& by_ess, const tmcmc::StreamKey& key) {
  constexpr double rounding = 1e-9;
  RunUnderBothRules run;
  const auto both_rules = [&](const tmcmc::State& state) {
    auto chosen =
        tmcmc::choose_step(tmcmc::as_span(state.log_likelihood), 1.0 - state.beta, by_cov.criterion);
    run.stages.push_back(stage_of(state, chosen.step, by_cov.criterion, by_ess.criterion));
    return chosen;
  };
  const auto first = tmcmc::run(problem, by_cov, key, {}, both_rules).stages;
  const auto second = tmcmc::run(problem, by_ess, key).stages;
  run.stages.resize(first.size());  // the last one may have chosen a step that was not taken
  for (std::size_t i = 0; i < first.size(); ++i) {
    const bool both = i < second.size();
    run.stages[i].beta_tmcmc = first[i].beta;
    run.stages[i].beta_tmcmc_ii = both ? second[i].beta : std::numeric_limits<double>::quiet_NaN();
    raise(run.path_difference, both ? second[i].beta / first[i].beta - 1.0 : 1.0);
  }
  run.is_same_path = run.path_difference < rounding && first.size() == second.size();
  return run;
}

RuleDifferences rule_differences(std::span<const RunUnderBothRules> runs) {
  RuleDifferences largest;
  for (const auto& run : runs) {
    for (const auto& stage : run.stages) {
      raise(largest.of_steps, stage.step_ess / stage.step_cov - 1.0);
      raise(largest.of_identity, stage.samples_over_one_plus_cov_squared / stage.effective_sample_size - 1.0);
      raise(largest.of_sample_deviation, stage.step_cov_sample / stage.step_cov - 1.0);
    }
    raise(largest.of_paths, run.path_difference);
    largest.stages += run.stages.size();
    largest.same_paths += run.is_same_path ? 1 : 0;
  }
  return largest;
}

}  // namespace replication
