/// \file
/// Metropolis proposals, 64 chains at a time.
#pragma once

#include <array>
#include <vector>

#include "tmcmc/prior.hpp"
#include "tmcmc/proposal_options.hpp"

namespace tmcmc::detail {

/// Treatment of a proposal outside the support of the prior.
enum class Boundary {
  /// The proposal is rejected and the chain stays.
  reject,
  /// The proposal is drawn again, as in RedrawnWalk.
  redraw
};

/// The Metropolis kernel of one stage. With u the coordinates, L = factor_unit * factor the
/// Cholesky factor of their covariance Sigma, and S a set of whitened coordinates, a proposal is
///
///     random walk:  u' = u + scale * factor * z_S
///     independent:  u' = u + L (z_S - y_S),  y = L^-1 (u - centre),
///
/// where z is standard normal. The independent proposal draws the whitened coordinates in S anew
/// from the normal distribution that was fitted to the population; its acceptance ratio is
/// multiplied by exp((|z_S|^2
/// - |y_S|^2) / 2).
struct MetropolisKernel {
  /// Lower triangular factor, d x d.
  Eigen::MatrixXd factor;
  /// factor times this number is the Cholesky factor of the covariance itself.
  double factor_unit = 1.0;
  /// Mean of the population in the same coordinates; needed if independent_fraction > 0.
  Eigen::VectorXd centre;
  /// Temperature of the target, L^beta times the prior.
  double beta = 1.0;
  /// Scale of a random walk.
  double scale = 1.0;
  /// Whether to divide scale by the square root of the number of coordinates in S.
  bool divide_by_sqrt_size = false;
  /// Probability that a proposal is independent.
  double independent_fraction = 0.0;
  /// Whether S consists of one coordinate chosen at random, and each other coordinate with a
  /// probability that is itself drawn from 1, 1/2, 1/4, ... down to 1/d; otherwise S consists of
  /// all coordinates.
  bool random_subsets = false;
  /// See Coordinates.
  Coordinates coordinates = Coordinates::natural;
  /// See Boundary; redraw requires plain().
  Boundary boundary = Boundary::reject;
  /// See RedrawnWalk.
  Index max_redraws = 100000;
  /// Stage of the random stream.
  std::uint32_t stage = 0;

  /// Whether the kernel is a random walk in all natural coordinates, as in the paper.
  [[nodiscard]] bool plain() const {
    return independent_fraction == 0.0 && !random_subsets && coordinates == Coordinates::natural;
  }
};

/// Proposals for up to 64 chains at a time, with their work space.
class ProposalLanes {
 public:
  /// Largest number of chains that a call serves.
  static constexpr std::size_t lanes = 64;
  /// One number per chain.
  using Lanes = std::array<double, lanes>;
  /// Row of the population that holds each chain.
  using RowIds = std::array<std::uint64_t, lanes>;

  /// \param dimension  d, the number of parameters
  explicit ProposalLanes(Index dimension);
  ProposalLanes(const ProposalLanes&) = delete;
  ProposalLanes& operator=(const ProposalLanes&) = delete;

  /// Draws the random numbers for the proposals of `count` rows, and the log-uniforms of the
  /// acceptance if log_uniforms is given.
  void draw(const StreamKey& key, const DrawId& id, const MetropolisKernel& kernel, const RowIds& rows,
            std::size_t count, Lanes* log_uniforms);

  /// Makes the proposals from the rows of `points`.
  /// \param log_prior  Prior::log_kernel() of the rows of `points` by their number; NaN where it is
  ///        still to be computed, and the computed value is stored there. Not used with a box
  void propose(const MetropolisKernel& kernel, const Prior& prior, const Population& points,
               const RowIds& rows, std::size_t count, Eigen::VectorXd& log_prior);

  /// Marks the proposals at which the prior has a density, adds the ratio of the prior densities to
  /// log_correction(), and returns the number of marked proposals.
  /// \throws SamplingError if a user-defined prior gives NaN, or no density at a point that it has
  ///         drawn
  std::size_t check(const Prior& prior, std::size_t count);

  /// Whether check() has found a prior density at the proposal of a chain.
  [[nodiscard]] bool inside(std::size_t lane) const { return inside_[lane] != 0.0; }
  /// Proposed parameter j, one lane per chain.
  [[nodiscard]] const Lanes& parameter(Index j) const { return x_[static_cast<std::size_t>(j)]; }
  /// 1 for independent proposals.
  [[nodiscard]] const Lanes& independent() const { return independent_; }
  /// Prior::log_kernel() of the proposals that check() has found inside; not with a box.
  [[nodiscard]] const Lanes& log_prior() const { return proposed_log_prior_; }
  /// Logarithm of the factor by which the ratio of the likelihoods is multiplied: the Jacobian and
  /// the ratios of prior and proposal densities.
  [[nodiscard]] const Lanes& log_correction() const { return log_correction_; }

 private:
  using WordLanes = std::array<std::uint64_t, lanes>;

  void draw_choices(const StreamKey& key, const DrawId& id, const MetropolisKernel& kernel,
                    const RowIds& rows, std::size_t count);
  void shift(const MetropolisKernel& kernel);
  void add_prior_ratio(const Prior& prior, std::size_t count);

  Index dimension_;
  std::array<WordLanes, 4> words_{};
  // standard normals
  std::vector<Lanes> z_;
  // proposals
  std::vector<Lanes> x_;
  // whitened coordinates
  std::vector<Lanes> y_;
  // 1 for coordinates in S
  std::vector<Lanes> chosen_;
  // columns of x_
  std::vector<const double*> columns_;
  // log_kernel() at the current states
  Lanes log_prior_{};
  Lanes proposed_log_prior_{};
  Lanes independent_{};
  Lanes walk_scale_{};
  Lanes inside_{};
  Lanes log_correction_{};
};

}  // namespace tmcmc::detail
