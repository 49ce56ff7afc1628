#include "tmcmc/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "portable_math/elementary.hpp"
#include "tmcmc/detail/proposal_fit.hpp"
#include "tmcmc/diagnostics.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

using namespace detail;

namespace {

Index count_above(const Eigen::VectorXd& log_likelihood, double level) {
  return std::count_if(log_likelihood.begin(), log_likelihood.end(),
                       [level](double value) { return value > level; });
}

/// Equal values have to stand side by side.
Index count_distinct(std::span<const Index> grouped) {
  Index distinct = grouped.empty() ? 0 : 1;
  for (std::size_t i = 1; i < grouped.size(); ++i) {
    distinct += grouped[i] != grouped[i - 1] ? 1 : 0;
  }
  return distinct;
}

/// Chains of a stage after the first.
Index chains_of(const Options& options) {
  return options.move == MoveKind::waste_free ? options.chains : options.samples;
}

/// Growth of beta that is assumed after the first stage, for want of an earlier temperature to compare with.
constexpr double first_growth = 2.0;

/// Stages that follow one which goes from `beta` to `next`, if log(beta) goes on growing by as much as in this one.
double stages_after(double beta, double next) {
  const double growth = portable_math::log(beta > 0.0 ? next / beta : first_growth);
  return std::max(std::ceil(-portable_math::log(next) / std::max(growth, 1e-3)), 1.0);
}

/// Metropolis steps of the chains of the stage from `from` to `next`: what the options say, or in the last stage as many
/// as the budget holds. Before the last stage, chains of waste-free share the budget with the stages that are expected to
/// follow, so that the number of stages does not decide whether beta = 1 is reached.
Index steps_of(const Options& options, const State& from, double next) {
  const Index chains = chains_of(options);
  const Index left = options.evaluation_budget - from.evaluations;
  if (next == 1.0 && options.evaluation_budget > 0) {
    return left / chains;
  }
  if (options.move != MoveKind::waste_free) {
    return options.move_steps;
  }
  const Index steps = options.samples / chains - 1;
  if (options.evaluation_budget == 0) {
    return steps;
  }
  const double share = static_cast<double>(left / chains) / (stages_after(from.beta, next) + 1.0);
  return std::clamp(static_cast<Index>(std::min(share, 1e15)), Index{1}, std::max(steps, Index{1}));
}

/// The same if they go on until they have mixed; no more than the budget holds.
Index most_steps_of(const Options& options, const State& from, double next) {
  const Index steps = steps_of(options, from, next);
  if (options.mixing_correlation == 0.0 || (next == 1.0 && options.evaluation_budget > 0)) {
    return steps;
  }
  const Index most = std::max(steps, options.max_move_steps);
  return options.evaluation_budget == 0
             ? most
             : std::min(most, (options.evaluation_budget - from.evaluations) / chains_of(options));
}

bool fits_budget(const Options& options, const State& from, double next) {
  const Index steps = steps_of(options, from, next);
  return options.evaluation_budget == 0 ||
         (steps >= 1 && steps * chains_of(options) <= options.evaluation_budget - from.evaluations);
}

/// Temperature after a step, rounded as the stage has it.
double temperature_after(const State& from, const TemperingStep& transition) {
  return transition.status == TemperingStatus::final_step ? 1.0 : from.beta + transition.step;
}

/// ScaleRule::acceptance_linked; without a random walk in the stage the scale stays.
double linked_scale(const MoveCounts& counts, double scale) {
  return counts.walks > 0 ? 1.0 / 9.0 + 8.0 / 9.0 * static_cast<double>(counts.accepted_walks) /
                                            static_cast<double>(counts.walks)
                          : scale;
}

/// Rows that the chains of the next stage start from. The rows are resampled chain by chain, as they descend from one
/// another: in the order of the steps, systematic resampling would step through the rows at the distance of a multiple of
/// the number of chains and find the same few chains again and again.
void draw_starts(const Options& options, const StreamKey& key, const State& from, Workspace& work) {
  const Index chains = from.genealogy.chains;
  const Index steps = from.points.rows() / chains;
  work.ancestors.resize(static_cast<std::size_t>(chains_of(options)));
  work.by_chain.clear();
  for (Index c = 0; c < chains; ++c) {
    for (Index k = 0; k < steps; ++k) {
      work.by_chain.push_back(work.weights[static_cast<std::size_t>(c + k * chains)]);
    }
  }
  resample(options.resampling, work.by_chain, key, static_cast<std::uint32_t>(from.stage + 1), work.ancestors,
           work.resampling, options.threads);
  for (Index& row : work.ancestors) {
    row = row / steps + row % steps * chains;
  }
}

void record_descent(const Options& options, std::span<const Index> ancestors, const State& from, State& to) {
  to.genealogy.chains = static_cast<Index>(ancestors.size());
  to.genealogy.ancestors.clear();
  if (!options.diagnose) {
    return;
  }
  std::vector<Index> parents(ancestors.begin(), ancestors.end());
  for (Index& parent : parents) {
    parent %= from.genealogy.chains;
  }
  for (const auto& of_parents : from.genealogy.ancestors) {
    auto& of_chains = to.genealogy.ancestors.emplace_back();
    for (const Index parent : parents) {
      of_chains.push_back(of_parents[static_cast<std::size_t>(parent)]);
    }
  }
  to.genealogy.ancestors.push_back(std::move(parents));
}

void require_valid(const Options& options, const StreamKey& key) {
  options.validate();
  if (key.arm >= (1U << 24U)) {
    throw std::invalid_argument("key.arm = " + std::to_string(key.arm) + ": expected a number below 2^24");
  }
}

StepRule criterion_rule(const Options& options) {
  return [&options](const State& state) {
    return choose_step(as_span(state.log_likelihood), 1.0 - state.beta, options.criterion, options.threads);
  };
}

}  // namespace

Workspace::Workspace(const Problem& problem, const Options& options, const StreamKey& key)
    : mover(problem.log_likelihood, problem.prior, key, options.threads, options.batch_rows) {}

State initial_state(const Problem& problem, const Options& options, const StreamKey& key) {
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
  require_valid(state.points, state.log_likelihood);
  if (count_above(state.log_likelihood, options.infeasible_level) == 0) {
    throw InfeasiblePriorError("none of the " + std::to_string(options.samples) +
                               " draws from the prior is feasible: the model excludes every one, or finds it "
                               "less likely than what it excludes");
  }
  return state;
}

StageRecord advance(const Problem& problem, const Options& options, const StreamKey& key,
                    const TemperingStep& transition, const State& from, State& to, Workspace& work) {
  const Index n = from.points.rows();
  StageRecord record;
  record.stage = from.stage + 1;
  record.beta = temperature_after(from, transition);
  record.step =
      record.beta - from.beta;  // rounded, so that a schedule of the betas repeats the run bit for bit
  record.effective_sample_size = transition.effective_sample_size;
  record.coefficient_of_variation = transition.coefficient_of_variation;
  record.transition_evaluations = transition.evaluations;
  record.feasible = count_above(from.log_likelihood, options.infeasible_level);

  work.weights.resize(static_cast<std::size_t>(n));
  WeightSums sums{static_cast<double>(n), 0.0};
  if (record.step > 0.0) {
    sums = relative_weights(as_span(from.log_likelihood), record.step, work.weights, options.threads);
  } else {
    std::fill(work.weights.begin(), work.weights.end(), 1.0);
  }
  record.log_evidence_increment = sums.log_mean;
  const std::vector<Index>& ancestors = work.ancestors;
  draw_starts(options, key, from, work);
  StageKernels kernels = stage_kernels(problem.prior, options, from, work.weights, sums.sum, ancestors);
  for (MetropolisKernel& kernel : kernels.kernels) {
    kernel.beta = record.beta;
  }
  record.distinct_ancestors = count_distinct(ancestors);
  to.gather(from.points, from.log_likelihood, ancestors, options.threads);
  record_descent(options, ancestors, from, to);

  const StageMoves moves =
      move_population(options, kernels, ancestors, steps_of(options, from, record.beta),
                      most_steps_of(options, from, record.beta), to, work.mover, work.moves);
  const MoveCounts& counts = moves.counts;
  record.acceptance_rate = static_cast<double>(counts.accepted) / static_cast<double>(counts.proposals);
  record.evaluations = counts.evaluations;
  record.redraws = counts.redraws;
  record.equilibrium_t = moves.equilibrium_t;
  record.move_steps = moves.steps;
  record.proposal_scale =
      options.scale_rule == ScaleRule::fixed ? options.proposal_scale : kernels.kernels.front().scale;
  to.proposal_scale = options.scale_rule == ScaleRule::acceptance_linked
                          ? linked_scale(counts, kernels.kernels.front().scale)
                          : record.proposal_scale;
  to.beta = record.beta;
  to.stage = record.stage;
  to.log_evidence = from.log_evidence + record.log_evidence_increment;
  to.evaluations = from.evaluations + counts.evaluations;
  return record;
}

Result resume(const Problem& problem, const Options& options, const StreamKey& key, Progress from,
              const StepRule& rule, const Observer& observer) {
  require_valid(options, key);
  require_valid(from, problem.prior, options);
  Workspace work(problem, options, key);
  Result result;
  Progress progress = std::move(from);
  State& state = progress.state;
  State next;
  while (state.beta < 1.0) {
    if (state.stage == options.max_stages) {
      result.stop = StopReason::stage_limit;
      break;
    }
    const TemperingStep transition = rule(state);
    if (transition.status == TemperingStatus::unreachable ||
        transition.status == TemperingStatus::infeasible) {
      throw SamplingError("stage " + std::to_string(state.stage + 1) +
                          ": no tempering step meets the criterion, since " +
                          std::to_string(count_feasible(as_span(state.log_likelihood))) + " of " +
                          std::to_string(options.samples) + " samples are feasible (see Criterion::counted)");
    }
    if (transition.status != TemperingStatus::final_step && transition.step < options.minimum_step) {
      result.stop = StopReason::step_too_small;
      break;
    }
    if (!fits_budget(options, state, temperature_after(state, transition))) {
      result.stop = StopReason::budget;
      break;
    }
    progress.stages.push_back(advance(problem, options, key, transition, state, next, work));
    if (options.diagnose) {
      progress.bridge.add(as_span(state.log_likelihood), as_span(next.log_likelihood),
                          next.genealogy.ancestors.back(), progress.stages.back().step);
    }
    std::swap(state, next);
    if (observer) {
      observer(progress);
    }
  }
  result.final = std::move(state);
  result.stages = std::move(progress.stages);
  if (options.diagnose) {
    result.evidence = {progress.bridge.log_evidence(), progress.bridge.standard_error()};
    result.diagnostics = diagnose(result, options, problem.prior.names());
  }
  return result;
}

Result resume(const Problem& problem, const Options& options, const StreamKey& key, Progress from,
              const Observer& observer) {
  return resume(problem, options, key, std::move(from), criterion_rule(options), observer);
}

Result run(const Problem& problem, const Options& options, const StreamKey& key, const StepRule& rule,
           const Observer& observer) {
  require_valid(options, key);
  Progress progress;
  progress.state = initial_state(problem, options, key);
  if (observer) {
    observer(progress);
  }
  return resume(problem, options, key, std::move(progress), rule, observer);
}

Result run(const Problem& problem, const Options& options, const StreamKey& key, const Observer& observer) {
  return run(problem, options, key, criterion_rule(options), observer);
}

StepRule fixed_schedule(std::vector<double> betas) {
  if (betas.empty() || betas.back() != 1.0 || !(betas.front() > 0.0) ||
      std::adjacent_find(betas.begin(), betas.end(), [](double a, double b) { return !(a < b); }) !=
          betas.end()) {
    throw std::invalid_argument("fixed_schedule: expected ascending positive temperatures that end in 1");
  }
  return [betas = std::move(betas)](const State& state) {
    const double next = *std::upper_bound(betas.begin(), betas.end(), state.beta);
    TemperingStep transition;
    transition.step = next - state.beta;
    transition.status = next == 1.0 ? TemperingStatus::final_step : TemperingStatus::solved;
    transition.effective_sample_size = effective_sample_size(as_span(state.log_likelihood), transition.step);
    transition.coefficient_of_variation =
        coefficient_of_variation(as_span(state.log_likelihood), transition.step);
    return transition;
  };
}

}  // namespace tmcmc
