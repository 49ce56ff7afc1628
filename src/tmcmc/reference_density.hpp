/// \file
/// Density in unbounded coordinates from which a posterior is measured.
#pragma once

#include "tmcmc/student_mixture.hpp"
#include "tmcmc/unbounded_coordinates.hpp"

namespace tmcmc {

/// A fitted mixture with a share of the prior: q = (1 - prior_share) fitted + prior_share prior. Since q is nowhere less
/// than prior_share times the prior, no importance weight L p / q is above L / prior_share, however poor the fit is
/// (defensive mixtures: Hesterberg 1995; Owen and Zhou 2000).
struct ReferenceDensity {
  StudentMixture fitted = {};  ///< its weights sum to 1; not used where prior_share is 1
  double prior_share = 0.02;   ///< in [0, 1]
};

/// log q of each row.
/// \param log_prior  log_prior_density(z, prior)
[[nodiscard]] Eigen::VectorXd log_density(const ReferenceDensity& reference, const Population& z,
                                          const Eigen::VectorXd& log_prior, int threads = 1);

/// n draws, n x d; each part gets its share of them, rounded so that the expected number is exact.
/// \param prior  whose draws make up the share prior_share
/// \param stage  of Purpose::reference; separates draws of one key
[[nodiscard]] Population sample(const ReferenceDensity& reference, const Prior& prior, Index n,
                                const StreamKey& key, std::uint32_t stage, int threads = 1);

}  // namespace tmcmc
