/// \file
/// Mixture of multivariate Student t distributions: density and draws, bit-identical on every
/// machine.
#pragma once

#include <vector>

#include "tmcmc/random.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// A mixture with the density
///
///     q(z) = sum_k w_k t(z; m_k, L_k L_k^T, nu),
///     t(z; m, S, nu) = Gamma((nu+d)/2) / (Gamma(nu/2) (nu pi)^(d/2) |S|^(1/2)) (1 + (z-m)^T S^-1 (z-m) / nu)^(-(nu+d)/2).
///
/// Its tails decay like a power of the distance, so that importance weights of a target with
/// lighter tails are bounded. If the tails are still too light in one direction, such as that of a
/// parameter which the data bound only from one side, a share v of each component may be wider:
/// t(z; m, S, nu) becomes (1 - v) t(z; m, S, nu) + v t(z; m, c^2 S, nu), c = min(2, 2^(4/d)), so
/// that a component takes up to 16 times its volume.
struct StudentMixture {
  /// w_k, K of them; their sum need not be 1.
  Eigen::VectorXd weights;
  /// m_k, d x K, one column per component.
  Eigen::MatrixXd means;
  /// L_k, lower triangular with a positive diagonal, d x d each.
  std::vector<Eigen::MatrixXd> factors;
  /// nu, even and positive.
  int degrees_of_freedom = 8;
  /// v, from 0 to less than 1.
  double wide_share = 0.0;

  /// K, the number of components.
  [[nodiscard]] Index size() const { return weights.size(); }
  /// d, the number of coordinates.
  [[nodiscard]] Index dimension() const { return means.rows(); }
  /// c, the factor by which the wider share is wider.
  [[nodiscard]] double wider() const;
};

/// log q for each row of points.
/// \param points  n x d
/// \param threads  number of threads; the result does not depend on it
[[nodiscard]] Eigen::VectorXd log_density(const StudentMixture& mixture, const Population& points,
                                          int threads = 1);

/// n draws, n x d. Component k gets its share n w_k of the draws, and its wider part the share v of
/// these, rounded so that the expected number is exact (one uniform number for all components): the
/// variance is smaller than with components drawn independently, and the mean of any function stays
/// unbiased. The draws are in the order of the components. For even nu, chi^2_nu = -2 log(u_1 u_2
/// ... u_{nu/2}).
/// \param stage  stage of the random stream of Purpose::reference; separates the draws of one key
[[nodiscard]] Population sample(const StudentMixture& mixture, Index n, const StreamKey& key,
                                std::uint32_t stage, int threads = 1);

/// The mixture share * a + (1 - share) * b. Both must have the same degrees of freedom; the wide
/// share of a applies to all components.
[[nodiscard]] StudentMixture blend(const StudentMixture& a, double share, const StudentMixture& b);

/// Numbers of draws, out of n, for parts with the given shares: floor of the cumulative share times
/// n plus `uniform`, as in systematic resampling. They sum to n, and their means over `uniform` in
/// (0, 1) are exact.
[[nodiscard]] std::vector<Index> systematic_counts(ConstDoubles shares, Index n, double uniform);

/// total += factor q(z) / exp(log_scale), one row per point: sums of densities relative to the
/// density from which the points were drawn.
/// \param log_factor  log of the factor
/// \param log_scale  one per row
void add_relative_density(const StudentMixture& mixture, double log_factor, const Population& points,
                          const Eigen::VectorXd& log_scale, Eigen::VectorXd& total, int threads = 1);

}  // namespace tmcmc
