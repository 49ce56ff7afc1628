/// \file
/// Density in unbounded coordinates, from whose draws a posterior is measured.
#pragma once

#include "tmcmc/student_mixture.hpp"
#include "tmcmc/unbounded_coordinates.hpp"

namespace tmcmc {

/// A fitted mixture with a share of the prior: q = (1 - prior_share) fitted + prior_share prior.
/// Since q is nowhere smaller than prior_share times the prior, no importance weight L p / q
/// exceeds L / prior_share, however poor the fit is (defensive mixtures: Hesterberg 1995; Owen and
/// Zhou 2000).
struct ReferenceDensity {
  /// Its weights sum to 1; not used if prior_share is 1.
  StudentMixture fitted = {};
  /// In [0, 1].
  double prior_share = 0.02;
};

/// log q for each row of z.
/// \param log_prior  log_prior_density(z, prior)
[[nodiscard]] Eigen::VectorXd log_density(const ReferenceDensity& reference, const Population& z,
                                          const Eigen::VectorXd& log_prior, int threads = 1);

/// n draws, n x d; each part of the mixture gets its share of them, rounded so that the expected
/// number is exact.
/// \param prior  prior from which the share prior_share of the draws comes
/// \param stage  stage of the random stream of Purpose::reference; separates the draws of one key
[[nodiscard]] Population sample(const ReferenceDensity& reference, const Prior& prior, Index n,
                                const StreamKey& key, std::uint32_t stage, int threads = 1);

}  // namespace tmcmc
