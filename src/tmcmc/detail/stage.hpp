/// \file
/// One stage of the sampler: weights, resampling, fitted proposals, moves.
#pragma once

#include <vector>

#include "tmcmc/detail/population_move.hpp"
#include "tmcmc/detail/resample.hpp"
#include "tmcmc/options.hpp"
#include "tmcmc/problem.hpp"
#include "tmcmc/result.hpp"
#include "tmcmc/tempering_step.hpp"

namespace tmcmc::detail {

/// Takes a population from stage to stage, and owns the work space that the stages reuse.
class Stage {
 public:
  /// Stores non-owning views of problem and options; both must outlive this object.
  Stage(const Problem& problem, const Options& options, const StreamKey& key);

  /// One stage. `to` is overwritten; its memory is reused.
  StageRecord advance(const TemperingStep& tempering, const State& from, State& to);

 private:
  WeightSums weigh(const State& from, double step);
  void draw_starts(const State& from);

  const Problem& problem_;
  const Options& options_;
  StreamKey key_;
  Mover mover_;
  // weights of the rows of the population, relative to the largest
  std::vector<double> weights_;
  // the weights in the order of the chains
  std::vector<double> by_chain_;
  // row from which each chain starts
  std::vector<Index> ancestors_;
  ResamplingWorkspace resampling_;
  StageMoveWorkspace moves_;
};

/// Temperature after a step, rounded as in the stage.
[[nodiscard]] double temperature_after(const State& from, const TemperingStep& tempering);

/// Number of log-likelihoods above a level.
[[nodiscard]] Index count_above(const Eigen::VectorXd& log_likelihood, double level);

}  // namespace tmcmc::detail
