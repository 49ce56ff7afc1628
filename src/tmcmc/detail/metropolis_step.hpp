/// \file
/// Metropolis steps on rows of a population, tempered at beta.
#pragma once

#include <memory>
#include <vector>

#include "tmcmc/detail/metropolis_proposal.hpp"

namespace tmcmc::detail {

/// Counts of Metropolis steps, summed over rows and steps.
struct MoveCounts {
  /// Proposals made, one per row and step; redrawn ones count once.
  Index proposals = 0;
  /// Proposals accepted.
  Index accepted = 0;
  /// Number of proposals by a random walk, without independent ones.
  Index walks = 0;
  /// Number of accepted proposals among `walks`.
  Index accepted_walks = 0;
  /// Log-likelihoods evaluated; proposals outside the prior's support need none.
  Index evaluations = 0;
  /// Number of proposals drawn again (Boundary::redraw).
  Index redraws = 0;

  /// Adds field by field.
  MoveCounts& operator+=(const MoveCounts& other);
};

/// Performs Metropolis steps; owns the work space, which is reused from step to step.
class Mover {
 public:
  /// \param threads  number of threads over blocks of rows
  /// \param batch_rows  largest number of rows in a call of the log-likelihood; 0: one call per
  ///        thread and step
  Mover(const LogLikelihood& log_likelihood, const Prior& prior, const StreamKey& key, int threads,
        Index batch_rows);
  ~Mover();
  Mover(const Mover&) = delete;
  Mover& operator=(const Mover&) = delete;

  /// One Metropolis step of the chains in the given rows, in place: a proposal theta' of the kernel
  /// is accepted with probability min(1, (L(theta') / L(theta))^beta c), where c is the ratio of
  /// the prior densities times the correction for coordinates and proposal densities. The draws
  /// depend only on key, stage, row and `draw`.
  /// \param rows  rows to move, each at most once; empty: all rows
  /// \throws SamplingError if a log-likelihood is NaN or plus infinity, or if max_redraws is
  ///         exceeded.
  MoveCounts step(const MetropolisKernel& kernel, std::span<const Index> rows, std::uint32_t draw,
                  Population& points, Eigen::VectorXd& log_likelihood);

 private:
  struct Block;
  MoveCounts step_block(const MetropolisKernel& kernel, const Index* rows, Index begin, Index end,
                        std::uint32_t draw, Population& points, Eigen::VectorXd& log_likelihood,
                        Block& block);
  void forget_moved_rows(const Index* rows, Index begin, Index end, const Population& points);

  const LogLikelihood& log_likelihood_;
  const Prior& prior_;
  StreamKey key_;
  int threads_;
  Index batch_rows_;
  // points to which log_prior_ belongs, by row
  Population known_points_;
  // Prior::log_kernel() of these points; NaN if not known
  Eigen::VectorXd log_prior_;
  std::vector<std::unique_ptr<Block>> blocks_;
};

/// \throws SamplingError naming the first point whose log-likelihood is NaN or plus infinity.
void require_valid(const Eigen::Ref<const Eigen::MatrixXd>& points,
                   const Eigen::Ref<const Eigen::VectorXd>& log_likelihood);

}  // namespace tmcmc::detail
