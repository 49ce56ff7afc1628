/// \file
/// Mixture of multivariate Student t distributions: density and draws, the same bits on every machine.
#pragma once

#include <vector>

#include "tmcmc/random.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc {

/// The density
///
///     q(z) = sum_k w_k t(z; m_k, L_k L_k^T, nu),
///     t(z; m, S, nu) = Gamma((nu+d)/2) / (Gamma(nu/2) (nu pi)^(d/2) |S|^(1/2)) (1 + (z-m)^T S^-1 (z-m) / nu)^(-(nu+d)/2).
///
/// Its tails fall off like a power of the distance, so that importance weights of a target with lighter tails are bounded.
struct StudentMixture {
  Eigen::VectorXd weights;               ///< w_k, K of them; their sum need not be 1
  Eigen::MatrixXd means;                 ///< m_k, d x K, one column a component
  std::vector<Eigen::MatrixXd> factors;  ///< L_k, lower triangular with a positive diagonal, d x d each
  int degrees_of_freedom = 8;            ///< nu, even and positive

  /// K, the number of components.
  [[nodiscard]] Index size() const { return weights.size(); }
  /// d, the number of coordinates.
  [[nodiscard]] Index dimension() const { return means.rows(); }
};

/// log q of each row.
/// \param points  n x d
/// \param threads  the result does not depend on it
[[nodiscard]] Eigen::VectorXd log_density(const StudentMixture& mixture, const Population& points,
                                          int threads = 1);

/// n draws, n x d. Component k gets its share n w_k of the draws, rounded so that the expected number is exact (one uniform
/// number for all components): less spread than independent components, and the mean of any function stays unbiased. The
/// draws stand in the order of the components. For even nu, chi^2_nu = -2 log(u_1 u_2 ... u_{nu/2}).
/// \param stage  of Purpose::reference; separates draws of one key
[[nodiscard]] Population sample(const StudentMixture& mixture, Index n, const StreamKey& key,
                                std::uint32_t stage, int threads = 1);

/// share * a + (1 - share) * b. Both must have the same degrees of freedom.
[[nodiscard]] StudentMixture blend(const StudentMixture& a, double share, const StudentMixture& b);

/// Numbers of n draws that go to parts of the given shares: floor of the cumulative share times n plus `uniform`, as in
/// systematic resampling. They sum to n, and their means over `uniform` in (0, 1) are exact.
[[nodiscard]] std::vector<Index> systematic_counts(ConstDoubles shares, Index n, double uniform);

namespace detail {

/// Rows that are worked on at a time: their intermediate results stay in the cache.
constexpr Index mixture_rows = 256;

/// One component ready for use.
struct Component {
  const double* mean;    ///< d
  const double* factor;  ///< d x d, by columns
  double log_constant;   ///< log of its weight times the density at its mean
};

/// The components, with the constants of their densities.
[[nodiscard]] std::vector<Component> components_of(const StudentMixture& mixture);

/// Log-density of the mixture at up to mixture_rows points, with what a fit needs.
/// \param points,stride  first coordinate of the first point; coordinate j stands j * stride further on
/// \param white  work space, d x mixture_rows
/// \param distances  K x mixture_rows, overwritten: |L_k^-1 (z - m_k)|^2
/// \param log_density  of each point, overwritten
/// \param shares  K x mixture_rows, overwritten: of each component in the density; all 0 where that is 0
void mixture_density(const std::vector<Component>& components, Index d, int degrees_of_freedom,
                     const double* points, Index stride, Index rows, double* white, double* distances,
                     double* log_density, double* shares);

}  // namespace detail

}  // namespace tmcmc
