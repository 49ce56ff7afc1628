#include "tmcmc/sampler.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "errors/invalid_value.hpp"
#include "tmcmc/detail/budget.hpp"
#include "tmcmc/detail/finish.hpp"
#include "tmcmc/detail/stage.hpp"
#include "tmcmc/diagnostics.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

namespace {

void require_valid(const Options& options, const StreamKey& key) {
  options.validate();
  if (key.arm >= (1U << 24U)) {
    throw errors::InvalidValue("key.arm", key.arm, "a number below 2^24");
  }
}

bool is_by_independent_draws(const Options& options, const StepRule& rule) {
  if (!std::holds_alternative<IndependentDraws>(options.finish)) {
    return false;
  }
  if (rule) {
    throw errors::InvalidValue("options.finish", "independent", "none with a step rule of one's own");
  }
  return true;
}

TemperingStep next_step(const Options& options, const StepRule& rule, const State& state) {
  return rule ? rule(state)
              : choose_step(as_span(state.log_likelihood), 1.0 - state.beta, options.criterion,
                            options.threads);
}

/// Why a run ends before a step is taken; nothing if it goes on.
/// \throws SamplingError if no step meets the criterion.
std::optional<StopReason> reason_to_stop(const Options& options, const State& state,
                                         const TemperingStep& tempering) {
  if (tempering.status == TemperingStatus::unreachable || tempering.status == TemperingStatus::infeasible) {
    throw SamplingError("stage " + std::to_string(state.stage + 1) +
                        ": no tempering step meets the criterion, since " +
                        std::to_string(count_feasible(as_span(state.log_likelihood))) + " of " +
                        std::to_string(options.samples) + " samples are feasible (see Criterion::counted)");
  }
  if (tempering.status != TemperingStatus::final_step && tempering.step < options.minimum_step) {
    return StopReason::step_too_small;
  }
  if (!detail::fits_budget(options, state, detail::temperature_after(state, tempering))) {
    return StopReason::budget;
  }
  return std::nullopt;
}

}  // namespace

State init(const Problem& problem, const Options& options, const StreamKey& key) {
  require_valid(options, key);
  State state;
  state.points = problem.prior.sample(options.samples, key, options.threads);
  state.log_likelihood.setConstant(options.samples, std::numeric_limits<double>::quiet_NaN());
  for_each_block(options.samples, rows_per_call(options.samples, options.threads, options.batch_rows),
                 options.threads, [&](Index, Index begin, Index end) {
                   problem.log_likelihood(state.points.middleRows(begin, end - begin),
                                          state.log_likelihood.segment(begin, end - begin));
                 });
  state.evaluations = options.samples;
  state.genealogy.chains = options.samples;
  detail::require_valid(state.points, state.log_likelihood);
  if (detail::count_above(state.log_likelihood, options.infeasible_level) == 0) {
    throw InfeasiblePriorError("none of the " + std::to_string(options.samples) +
                               " draws from the prior is feasible: the model excludes every one, or finds it "
                               "less likely than what it excludes");
  }
  return state;
}

NextStage step(const Problem& problem, const Options& options, const StreamKey& key,
               const TemperingStep& tempering, const State& from) {
  require_valid(options, key);
  NextStage next;
  next.record = detail::Stage(problem, options, key).advance(tempering, from, next.state);
  return next;
}

Result resume(const Problem& problem, const Options& options, const StreamKey& key, Progress from,
              const Observer& observer, const StepRule& rule) {
  require_valid(options, key);
  require_valid(from, problem.prior, options);
  if (is_by_independent_draws(options, rule)) {
    return detail::run_independent_draws(problem, options, key, from, observer);
  }
  detail::Stage stage(problem, options, key);
  Result result;
  Progress progress = std::move(from);
  State& state = progress.state;
  State next;
  while (state.beta < 1.0) {
    if (state.stage == options.max_stages) {
      result.stop = StopReason::stage_limit;
      break;
    }
    const TemperingStep tempering = next_step(options, rule, state);
    if (const auto stop = reason_to_stop(options, state, tempering)) {
      result.stop = *stop;
      break;
    }
    progress.stages.push_back(stage.advance(tempering, state, next));
    if (options.diagnose) {
      progress.bridge.add(as_span(state.log_likelihood), as_span(next.log_likelihood), next.genealogy.chains,
                          progress.stages.back().step);
    }
    std::swap(state, next);
    if (observer) {
      observer(progress);
    }
  }
  result.final = std::move(state);
  result.weights.setOnes(result.final.points.rows());
  result.stages = std::move(progress.stages);
  if (options.diagnose) {
    result.evidence = {progress.bridge.log_evidence(),
                       progress.bridge.standard_error(result.final.genealogy)};
    result.diagnostics = diagnose(result, options, problem.prior.names());
  }
  return result;
}

Result run(const Problem& problem, const Options& options, const StreamKey& key, const Observer& observer,
           const StepRule& rule) {
  require_valid(options, key);
  Progress progress;
  if (is_by_independent_draws(options, rule)) {
    return detail::run_independent_draws(problem, options, key, progress, observer);
  }
  progress.state = init(problem, options, key);
  if (observer) {
    observer(progress);
  }
  return resume(problem, options, key, std::move(progress), observer, rule);
}

StepRule fixed_schedule(std::vector<double> betas) {
  if (betas.empty() || betas.back() != 1.0 || !(betas.front() > 0.0) ||
      std::adjacent_find(betas.begin(), betas.end(), [](double a, double b) { return !(a < b); }) !=
          betas.end()) {
    throw errors::InvalidValue("fixed_schedule.betas", "", "ascending positive temperatures that end in 1");
  }
  return [betas = std::move(betas)](const State& state) {
    const double next = *std::upper_bound(betas.begin(), betas.end(), state.beta);
    TemperingStep tempering;
    tempering.step = next - state.beta;
    tempering.status = next == 1.0 ? TemperingStatus::final_step : TemperingStatus::solved;
    tempering.effective_sample_size = effective_sample_size(as_span(state.log_likelihood), tempering.step);
    tempering.coefficient_of_variation =
        coefficient_of_variation(as_span(state.log_likelihood), tempering.step);
    return tempering;
  };
}

}  // namespace tmcmc
