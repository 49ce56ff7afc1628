#include "tmcmc/detail/population_move.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "portable_math/sums.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc::detail {

namespace {

/// One step of all walkers, with the adaptation of the scale to its acceptance.
MoveCounts step_and_adapt(const ScaleRule& rule, StageKernels& stage, Index step, Walkers& walkers,
                          Mover& mover) {
  MoveCounts counts;
  for (std::size_t k = 0; k < stage.kernels.size(); ++k) {
    const bool all = stage.rows.empty();
    if (all || !stage.rows[k].empty()) {
      counts += mover.step(stage.kernels[k], all ? std::span<const Index>() : stage.rows[k],
                           static_cast<std::uint32_t>(step), walkers.points, walkers.log_likelihood);
    }
  }
  const auto* target = std::get_if<TargetAcceptance>(&rule);
  if (target != nullptr && counts.walks > 0) {
    const double acceptance = static_cast<double>(counts.accepted_walks) / static_cast<double>(counts.walks);
    for (MetropolisKernel& kernel : stage.kernels) {
      kernel.scale *=
          portable_math::exp((acceptance - target->acceptance) / std::sqrt(static_cast<double>(step + 1)));
    }
  }
  return counts;
}

std::vector<Index> chain_lengths(std::span<const Index> sorted_ancestors) {
  std::vector<Index> lengths;
  for (std::size_t i = 0; i < sorted_ancestors.size(); ++i) {
    if (i == 0 || sorted_ancestors[i] != sorted_ancestors[i - 1]) {
      lengths.push_back(0);
    }
    ++lengths.back();
  }
  return lengths;
}

/// Chains of unequal length: the ancestors are sorted, so a chain fills consecutive rows, and its
/// k-th state starts from the state in the row before.
StageMoves grow_chains(const MetropolisKernel& kernel, std::span<const Index> ancestors, Walkers& walkers,
                       Mover& mover) {
  struct Chain {
    Index row;  // of the next state
    Index left;
  };
  std::vector<Chain> active;
  Index row = 0;
  for (const Index length : chain_lengths(ancestors)) {
    active.push_back({row, length});
    row += length;
  }
  StageMoves result;
  std::vector<Index> rows;
  for (; !active.empty(); ++result.steps) {
    rows.clear();
    for (const Chain& chain : active) {
      rows.push_back(chain.row);
    }
    result.counts += mover.step(kernel, rows, 0, walkers.points, walkers.log_likelihood);
    for (Chain& chain : active) {
      --chain.left;
      ++chain.row;
    }
    std::erase_if(active, [](const Chain& chain) { return chain.left == 0; });
    for (const Chain& chain : active) {
      walkers.points.row(chain.row) = walkers.points.row(chain.row - 1);
      walkers.log_likelihood[chain.row] = walkers.log_likelihood[chain.row - 1];
    }
  }
  return result;
}

StageMoves keep_last_states(const ScaleRule& rule, double mixing_correlation, StageKernels& kernels,
                            Index steps, Index most_steps, Walkers& walkers, Mover& mover,
                            Population& starts) {
  StageMoves result;
  if (most_steps > steps) {
    starts = walkers.points;
  }
  const auto go_on = [&] {
    return result.steps < most_steps && largest_correlation(starts, walkers.points) > mixing_correlation;
  };
  while (result.steps < steps || go_on()) {
    result.counts += step_and_adapt(rule, kernels, result.steps++, walkers, mover);
  }
  return result;
}

StageMoves keep_all_states(const ScaleRule& rule, StageKernels& kernels, Index steps, Walkers& walkers,
                           Mover& mover, Walkers& chains) {
  StageMoves result;
  std::swap(chains, walkers);
  const Index m = chains.points.rows();
  walkers.points.resize(m * (steps + 1), chains.points.cols());
  walkers.log_likelihood.resize(m * (steps + 1));
  const auto keep = [&] {
    walkers.points.middleRows(m * result.steps, m) = chains.points;
    walkers.log_likelihood.segment(m * result.steps, m) = chains.log_likelihood;
  };
  keep();
  while (result.steps < steps) {
    result.counts += step_and_adapt(rule, kernels, result.steps++, chains, mover);
    keep();
  }
  result.equilibrium_t = equilibrium_t(walkers.log_likelihood, m);
  return result;
}

}  // namespace

StageMoves move_population(const Options& options, StageKernels& kernels, std::span<const Index> ancestors,
                           Index steps, Index most_steps, Walkers& walkers, Mover& mover,
                           StageMoveWorkspace& work) {
  if (std::holds_alternative<GrowingChains>(options.move)) {
    return grow_chains(kernels.kernels.front(), ancestors, walkers, mover);
  }
  if (std::holds_alternative<WasteFree>(options.move)) {
    return keep_all_states(options.scale_rule, kernels, steps, walkers, mover, work.chains);
  }
  return keep_last_states(options.scale_rule, std::get<ResampleMove>(options.move).mixing_correlation,
                          kernels, steps, most_steps, walkers, mover, work.starts);
}

double equilibrium_t(const Eigen::VectorXd& log_likelihood, Index chains) {
  const Index states = chains > 0 ? log_likelihood.size() / chains : 0;
  const Index third = std::max(states / 3, Index{1});
  if (states < 2 || chains < 3) {
    return 0.0;
  }
  double sum = 0.0;
  double squares = 0.0;
  for (Index c = 0; c < chains; ++c) {
    double drift = 0.0;
    for (Index k = 0; k < third; ++k) {
      drift += log_likelihood[(states - 1 - k) * chains + c] - log_likelihood[k * chains + c];
    }
    drift /= static_cast<double>(third);
    sum += drift;
    squares += drift * drift;
  }
  const double m = static_cast<double>(chains);
  const double variance = (squares - sum * sum / m) / (m - 1.0);
  return variance > 0.0 ? sum / std::sqrt(m * variance) : 0.0;
}

double largest_correlation(const Population& a, const Population& b) {
  const auto n = static_cast<std::size_t>(a.rows());
  const double size = static_cast<double>(n);
  double largest = 0.0;
  for (Index j = 0; j < a.cols(); ++j) {
    const double* x = a.col(j).data();
    const double* y = b.col(j).data();
    const double mean_x = portable_math::sum_of(n, [=](std::size_t i) { return x[i]; }) / size;
    const double mean_y = portable_math::sum_of(n, [=](std::size_t i) { return y[i]; }) / size;
    const double xx =
        portable_math::sum_of(n, [=](std::size_t i) { return (x[i] - mean_x) * (x[i] - mean_x); });
    const double yy =
        portable_math::sum_of(n, [=](std::size_t i) { return (y[i] - mean_y) * (y[i] - mean_y); });
    const double xy =
        portable_math::sum_of(n, [=](std::size_t i) { return (x[i] - mean_x) * (y[i] - mean_y); });
    if (xx > 0.0 && yy > 0.0) {
      largest = std::max(largest, std::fabs(xy) / std::sqrt(xx * yy));
    }
  }
  return largest;
}

}  // namespace tmcmc::detail
