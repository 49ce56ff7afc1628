/// \file
/// Population Monte Carlo: a reference density that is drawn from, weighed and fitted again.
#pragma once

#include "tmcmc/importance.hpp"
#include "tmcmc/mixture_fit.hpp"
#include "tmcmc/reference_density.hpp"
#include "tmcmc/sampler.hpp"

namespace tmcmc {

/// Draws from one or several reference densities, in unbounded coordinates.
struct ReferenceDraws {
  Population z;                              ///< n x d
  Eigen::VectorXd log_prior;                 ///< n, log_prior_density(z, prior)
  Eigen::VectorXd log_likelihood;            ///< n
  std::vector<ReferenceDensity> references;  ///< the densities, in the order of their draws
  std::vector<Index> counts;                 ///< draws from each; their sum is n

  /// Adds draws and their log-likelihoods.
  void append(const ReferenceDraws& other);
};

/// n draws from a frozen density.
/// \param stage  see sample(ReferenceDensity)
/// \throws SamplingError for a log-likelihood of NaN or plus infinity
[[nodiscard]] ReferenceDraws draw_and_evaluate(const Problem& problem, const ReferenceDensity& reference,
                                               Index n, const StreamKey& key, std::uint32_t stage,
                                               int threads = 1, Index batch_rows = 2048);

/// log(L p) - log(sum_r n_r q_r / n): the weights of the deterministic mixture of all densities that were drawn from (Owen
/// and Zhou 2000; Cornuet, Marin, Mira and Robert 2012). Where the later densities were fitted to the earlier draws, the
/// mean weight is consistent but not unbiased.
[[nodiscard]] Eigen::VectorXd log_weights(const ReferenceDraws& draws, int threads = 1);

/// The population of a finished run in unbounded coordinates, for a fit. Its states depend on each other: ten of them count
/// as one independent point. Groups are chains.
[[nodiscard]] WeightedPoints fit_points(const Result& result, const Prior& prior);

/// The draws with their weights, for a fit: these sum to the effective size. Where that is below 100, 20 d or half of the
/// draws (the least of them), the weights are raised to the power in (0, 1] at which it is reached.
[[nodiscard]] WeightedPoints fit_points(const ReferenceDraws& draws, int threads = 1);

/// All points of both. Groups stay apart.
[[nodiscard]] WeightedPoints join(const WeightedPoints& a, const WeightedPoints& b);

}  // namespace tmcmc
