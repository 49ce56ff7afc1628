/// \file
/// Density in unbounded coordinates from which a posterior is measured, and the way between them and the prior box.
#pragma once

#include "tmcmc/prior.hpp"
#include "tmcmc/student_mixture.hpp"

namespace tmcmc {

/// Density of the coordinates z_j = log((x_j - lower_j) / (upper_j - x_j)) under the uniform prior:
/// log p(z) = -sum_j (|z_j| + 2 log(1 + exp(-|z_j|))), a product of standard logistic densities.
/// \param z  n x d
[[nodiscard]] Eigen::VectorXd log_prior_density(const Population& z, int threads = 1);

/// The parameters x of coordinates z, n x d: the inverse of to_unbounded(). What would round to a bound of the box becomes the
/// double next to it.
[[nodiscard]] Population from_unbounded(const Population& z, const BoxPrior& prior);

/// A fitted mixture with a share of the prior: q = (1 - prior_share) fitted + prior_share prior. Since q is nowhere less
/// than prior_share times the prior, no importance weight L p / q is above L / prior_share, however poor the fit is
/// (defensive mixtures: Hesterberg 1995; Owen and Zhou 2000).
struct ReferenceDensity {
  StudentMixture fitted;      ///< its weights sum to 1
  double prior_share = 0.02;  ///< in [0, 1)
};

/// log q of each row.
/// \param log_prior  log_prior_density(z)
[[nodiscard]] Eigen::VectorXd log_density(const ReferenceDensity& reference, const Population& z,
                                          const Eigen::VectorXd& log_prior, int threads = 1);

/// n draws, n x d; each part gets its share of them, rounded so that the expected number is exact.
/// \param stage  of Purpose::reference; separates draws of one key
[[nodiscard]] Population sample(const ReferenceDensity& reference, Index n, const StreamKey& key,
                                std::uint32_t stage, int threads = 1);

}  // namespace tmcmc
