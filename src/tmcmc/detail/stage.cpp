#include "tmcmc/detail/stage.hpp"

#include <algorithm>
#include <utility>

#include "tmcmc/detail/budget.hpp"
#include "tmcmc/detail/proposal_fit.hpp"

namespace tmcmc::detail {

namespace {

/// Number of distinct values; equal values must be adjacent.
Index count_distinct(std::span<const Index> grouped) {
  Index distinct = grouped.empty() ? 0 : 1;
  for (std::size_t i = 1; i < grouped.size(); ++i) {
    distinct += grouped[i] != grouped[i - 1] ? 1 : 0;
  }
  return distinct;
}

/// The scale of AcceptanceLinked; if a stage has no random walk the scale does not change.
double linked_scale(const MoveCounts& counts, double scale) {
  return counts.walks > 0 ? 1.0 / 9.0 + 8.0 / 9.0 * static_cast<double>(counts.accepted_walks) /
                                            static_cast<double>(counts.walks)
                          : scale;
}

void record_descent(const Options& options, std::span<const Index> ancestors, const State& from, State& to) {
  to.genealogy.chains = static_cast<Index>(ancestors.size());
  to.genealogy.parents.clear();
  if (options.diagnose) {
    to.genealogy.parents = from.genealogy.parents;
    std::vector<Index>& parents = to.genealogy.parents.emplace_back(ancestors.begin(), ancestors.end());
    for (Index& parent : parents) {
      parent %= from.genealogy.chains;
    }
  }
}

}  // namespace

Index count_above(const Eigen::VectorXd& log_likelihood, double level) {
  return std::count_if(log_likelihood.begin(), log_likelihood.end(),
                       [level](double value) { return value > level; });
}

double temperature_after(const State& from, const TemperingStep& tempering) {
  return tempering.status == TemperingStatus::final_step ? 1.0 : from.beta + tempering.step;
}

Stage::Stage(const Problem& problem, const Options& options, const StreamKey& key)
    : problem_(problem),
      options_(options),
      key_(key),
      mover_(problem.log_likelihood, problem.prior, key, options.threads, options.batch_rows) {}

WeightSums Stage::weigh(const State& from, double step) {
  weights_.resize(static_cast<std::size_t>(from.points.rows()));
  if (step > 0.0) {
    return relative_weights(as_span(from.log_likelihood), step, weights_, options_.threads);
  }
  std::fill(weights_.begin(), weights_.end(), 1.0);
  return {static_cast<double>(from.points.rows()), 0.0};
}

/// The rows are resampled chain by chain, as they descend from one another: in the order of the
/// steps, systematic resampling would step through the rows at the distance of a multiple of the
/// number of chains and find the same few chains again and again.
void Stage::draw_starts(const State& from) {
  const Index chains = from.genealogy.chains;
  const Index steps = from.points.rows() / chains;
  ancestors_.resize(static_cast<std::size_t>(chains_of(options_)));
  by_chain_.clear();
  for (Index c = 0; c < chains; ++c) {
    for (Index k = 0; k < steps; ++k) {
      by_chain_.push_back(weights_[static_cast<std::size_t>(c + k * chains)]);
    }
  }
  resample(options_.resampling, by_chain_, key_, static_cast<std::uint32_t>(from.stage + 1), ancestors_,
           resampling_, options_.threads);
  for (Index& row : ancestors_) {
    row = row / steps + row % steps * chains;
  }
}

StageRecord Stage::advance(const TemperingStep& tempering, const State& from, State& to) {
  StageRecord record;
  record.stage = from.stage + 1;
  record.beta = temperature_after(from, tempering);
  // The step is rounded, so that a schedule of the betas repeats the run bit for bit.
  record.step = record.beta - from.beta;
  record.effective_sample_size = tempering.effective_sample_size;
  record.coefficient_of_variation = tempering.coefficient_of_variation;
  record.transition_evaluations = tempering.evaluations;
  record.feasible = count_above(from.log_likelihood, options_.infeasible_level);

  const WeightSums sums = weigh(from, record.step);
  record.log_evidence_increment = sums.log_mean;
  draw_starts(from);
  record.distinct_ancestors = count_distinct(ancestors_);
  StageKernels kernels = stage_kernels(problem_.prior, options_, from, weights_, sums.sum, ancestors_);
  for (MetropolisKernel& kernel : kernels.kernels) {
    kernel.beta = record.beta;
  }
  to.gather(from.points, from.log_likelihood, ancestors_, options_.threads);
  record_descent(options_, ancestors_, from, to);

  const StageSteps steps = steps_of(options_, from, record.beta);
  const StageMoves moves =
      move_population(options_, kernels, ancestors_, steps.least, steps.most, to, mover_, moves_);
  const MoveCounts& counts = moves.counts;
  record.acceptance_rate = static_cast<double>(counts.accepted) / static_cast<double>(counts.proposals);
  record.evaluations = counts.evaluations;
  record.redraws = counts.redraws;
  record.equilibrium_t = moves.equilibrium_t;
  record.move_steps = moves.steps;
  const double scale = kernels.kernels.front().scale;
  const auto* fixed = std::get_if<FixedScale>(&options_.scale_rule);
  record.proposal_scale = fixed != nullptr ? fixed->scale : scale;

  to.proposal_scale = std::holds_alternative<AcceptanceLinked>(options_.scale_rule)
                          ? linked_scale(counts, scale)
                          : record.proposal_scale;
  to.beta = record.beta;
  to.stage = record.stage;
  to.log_evidence = from.log_evidence + record.log_evidence_increment;
  to.evaluations = from.evaluations + counts.evaluations;
  return record;
}

}  // namespace tmcmc::detail
