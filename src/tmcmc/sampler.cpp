#include "tmcmc/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tmcmc/parallel.hpp"
#include "tmcmc/resampling.hpp"

namespace tmcmc {

namespace {

template <class T>
void require(bool condition, const char* field, T value, const char* expected) {
  if (!condition) {
    throw std::invalid_argument(std::string("options.") + field + " = " + std::to_string(value) +
                                ": expected " + expected);
  }
}

std::vector<Index> chain_lengths(std::span<const Index> ancestors, Index chains) {
  std::vector<Index> lengths(static_cast<std::size_t>(chains));
  for (const Index a : ancestors) {
    ++lengths[static_cast<std::size_t>(a)];
  }
  return lengths;
}

/// Chains of unequal length: ancestors come sorted, so a chain fills consecutive rows, and its k-th state
/// starts from the one in the row before.
MoveCounts grow_chains(const MetropolisKernel& kernel, std::span<const Index> ancestors, State& state,
                       Mover& mover) {
  struct Chain {
    Index row;  // of the next state
    Index left;
  };
  std::vector<Chain> active;
  Index row = 0;
  for (const Index length : chain_lengths(ancestors, state.points.rows())) {
    if (length > 0) {
      active.push_back({row, length});
      row += length;
    }
  }
  MoveCounts counts;
  std::vector<Index> rows;
  while (!active.empty()) {
    rows.clear();
    for (const Chain& chain : active) {
      rows.push_back(chain.row);
    }
    counts += mover.step(kernel, rows, 0, state.points, state.log_likelihood);
    for (Chain& chain : active) {
      --chain.left;
      ++chain.row;
    }
    std::erase_if(active, [](const Chain& chain) { return chain.left == 0; });
    for (const Chain& chain : active) {
      state.points.row(chain.row) = state.points.row(chain.row - 1);
      state.log_likelihood[chain.row] = state.log_likelihood[chain.row - 1];
    }
  }
  return counts;
}

Index count_above(const Eigen::VectorXd& log_likelihood, double level) {
  return std::count_if(log_likelihood.begin(), log_likelihood.end(),
                       [level](double value) { return value > level; });
}

Index count_distinct(std::span<const Index> sorted) {
  Index distinct = sorted.empty() ? 0 : 1;
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    distinct += sorted[i] != sorted[i - 1] ? 1 : 0;
  }
  return distinct;
}

}  // namespace

void Options::validate() const {
  criterion.validate();
  require(samples >= 2, "samples", samples, "at least 2");
  require(move_steps >= 1, "move_steps", move_steps, "at least 1");
  require(proposal_scale > 0.0 && std::isfinite(proposal_scale), "proposal_scale", proposal_scale,
          "a positive number");
  require(max_redraws >= 1, "max_redraws", max_redraws, "at least 1");
  require(max_stages >= 1, "max_stages", max_stages, "at least 1");
  require(minimum_step >= 0.0 && minimum_step < 1.0, "minimum_step", minimum_step, "a number in [0, 1)");
  require(!std::isnan(infeasible_level), "infeasible_level", infeasible_level, "a number or minus infinity");
  require(threads >= 1, "threads", threads, "at least 1");
  require(batch_rows >= 0, "batch_rows", batch_rows, "a number of rows, or 0 for no limit");
}

Workspace::Workspace(const Problem& problem, const Options& options, const StreamKey& key)
    : mover(problem.log_likelihood, problem.prior, key, options.threads, options.batch_rows) {}

State initial_state(const Problem& problem, const Options& options, const StreamKey& key) {
  State state;
  state.points = problem.prior.sample(options.samples, key, options.threads);
  state.log_likelihood.resize(options.samples);
  for_each_block(options.samples, rows_per_call(options.samples, options.threads, options.batch_rows),
                 options.threads, [&](Index, Index begin, Index end) {
                   problem.log_likelihood(state.points.middleRows(begin, end - begin),
                                          state.log_likelihood.segment(begin, end - begin));
                 });
  state.evaluations = options.samples;
  require_valid(state.points, state.log_likelihood);
  if (count_above(state.log_likelihood, options.infeasible_level) == 0) {
    throw InfeasiblePriorError("none of the " + std::to_string(options.samples) +
                               " draws from the prior is feasible: the model excludes every one");
  }
  return state;
}

StageRecord advance(const Problem& problem, const Options& options, const StreamKey& key,
                    const Transition& transition, const State& from, State& to, Workspace& work) {
  const Index n = from.points.rows();
  const Index d = problem.prior.dimension();
  StageRecord record;
  record.stage = from.stage + 1;
  record.beta = transition.status == TransitionStatus::final_step ? 1.0 : from.beta + transition.step;
  record.step = record.beta - from.beta;  // rounded, so that a schedule of the betas repeats the run bit for bit
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
  MetropolisKernel kernel;
  kernel.factor = cholesky_factor(proposal_covariance(
      from.points, work.weights, sums.sum, options.proposal_scale, options.centre, options.threads));
  kernel.beta = record.beta;
  kernel.boundary = options.boundary;
  kernel.max_redraws = options.max_redraws;
  kernel.stage = static_cast<std::uint32_t>(record.stage);

  auto& ancestors = work.ancestors;
  ancestors.resize(static_cast<std::size_t>(n));
  multinomial_ancestors(work.weights, key, kernel.stage, ancestors, work.partial_sums, options.threads);
  record.distinct_ancestors = count_distinct(ancestors);
  to.points.resize(n, d);
  to.log_likelihood.resize(n);
  for_each_block(n, reduction_rows, options.threads, [&](Index, Index begin, Index end) {
    for (Index j = 0; j < d; ++j) {
      for (Index i = begin; i < end; ++i) {
        to.points(i, j) = from.points(ancestors[static_cast<std::size_t>(i)], j);
      }
    }
    for (Index i = begin; i < end; ++i) {
      to.log_likelihood[i] = from.log_likelihood[ancestors[static_cast<std::size_t>(i)]];
    }
  });

  MoveCounts counts;
  if (options.move == MoveKind::growing_chains) {
    counts = grow_chains(kernel, ancestors, to, work.mover);
  } else {
    for (Index k = 0; k < options.move_steps; ++k) {
      counts += work.mover.step(kernel, {}, static_cast<std::uint32_t>(k), to.points, to.log_likelihood);
    }
  }
  record.acceptance_rate = static_cast<double>(counts.accepted) / static_cast<double>(counts.proposals);
  record.evaluations = counts.evaluations;
  record.redraws = counts.redraws;
  to.beta = record.beta;
  to.stage = record.stage;
  to.log_evidence = from.log_evidence + record.log_evidence_increment;
  to.evaluations = from.evaluations + counts.evaluations;
  return record;
}

Result run(const Problem& problem, const Options& options, const StreamKey& key, const StepRule& rule,
           const Observer& observer) {
  options.validate();
  require(key.arm < (1U << 24U), "key.arm", key.arm, "a number below 2^24");
  Workspace work(problem, options, key);
  Result result;
  State state = initial_state(problem, options, key);
  State next;
  while (state.beta < 1.0) {
    if (state.stage == options.max_stages) {
      result.stop = StopReason::stage_limit;
      break;
    }
    const Transition transition = rule(state);
    if (transition.status == TransitionStatus::unreachable ||
        transition.status == TransitionStatus::infeasible) {
      throw SamplingError("stage " + std::to_string(state.stage + 1) +
                          ": no tempering step meets the criterion, since " +
                          std::to_string(count_feasible(as_span(state.log_likelihood))) + " of " +
                          std::to_string(options.samples) + " samples are feasible (see Criterion::counted)");
    }
    if (transition.status != TransitionStatus::final_step && transition.step < options.minimum_step) {
      result.stop = StopReason::step_too_small;
      break;
    }
    result.stages.push_back(advance(problem, options, key, transition, state, next, work));
    std::swap(state, next);
    if (observer) {
      observer(result.stages.back(), state);
    }
  }
  result.final = std::move(state);
  return result;
}

Result run(const Problem& problem, const Options& options, const StreamKey& key, const Observer& observer) {
  return run(
      problem, options, key,
      [&](const State& state) {
        return choose_step(as_span(state.log_likelihood), 1.0 - state.beta, options.criterion,
                           options.threads);
      },
      observer);
}

StepRule fixed_schedule(std::vector<double> betas) {
  if (betas.empty() || betas.back() != 1.0 || !(betas.front() > 0.0) ||
      std::adjacent_find(betas.begin(), betas.end(), [](double a, double b) { return !(a < b); }) !=
          betas.end()) {
    throw std::invalid_argument("fixed_schedule: expected ascending positive temperatures that end in 1");
  }
  return [betas = std::move(betas)](const State& state) {
    const double next = *std::upper_bound(betas.begin(), betas.end(), state.beta);
    Transition transition;
    transition.step = next - state.beta;
    transition.status = next == 1.0 ? TransitionStatus::final_step : TransitionStatus::solved;
    transition.effective_sample_size = effective_sample_size(as_span(state.log_likelihood), transition.step);
    transition.coefficient_of_variation =
        coefficient_of_variation(as_span(state.log_likelihood), transition.step);
    return transition;
  };
}

}  // namespace tmcmc
