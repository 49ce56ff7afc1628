/// \file
/// Population Monte Carlo: draws from reference densities, their weights, and the search for the
/// posterior with them.
#pragma once

#include "tmcmc/importance.hpp"
#include "tmcmc/mixture_fit.hpp"
#include "tmcmc/reference_density.hpp"
#include "tmcmc/sampler.hpp"

namespace tmcmc {

/// Draws from one or several reference densities q_r = (1 - s_r) f_r + s_r p, in unbounded
/// coordinates, n_r draws from each. Sums of these densities are stored relative to the density
/// from which the draw came, so that nothing can overflow.
struct ReferenceDraws {
  /// n x d.
  Population z;
  /// n, log_prior_density(z, prior).
  Eigen::VectorXd log_prior;
  /// n.
  Eigen::VectorXd log_likelihood;
  /// n, log-density of the draw under its own reference density.
  Eigen::VectorXd log_own;
  /// n, sum_r n_r (1 - s_r) f_r divided by that density.
  Eigen::VectorXd fitted;
  /// q_r, in the order of their draws.
  std::vector<ReferenceDensity> references;
  /// n_r, including excluded draws.
  std::vector<Index> counts;

  /// sum_r n_r, the number of evaluations that the draws have cost.
  [[nodiscard]] Index evaluations() const;
  /// Adds the draws that are not excluded (excluded draws have weight 0); each density is evaluated
  /// at the draws of the other side.
  /// \param look  called before each density, if not empty; see Problem::look
  void append(const ReferenceDraws& other, int threads = 1, const std::function<void()>& look = {});
  /// Adds draws from the one density from which these draws also come.
  void append_of_same_density(const ReferenceDraws& other);
};

/// n evaluated draws from a frozen density.
/// \param stage  see sample(ReferenceDensity)
/// \throws SamplingError if a log-likelihood is NaN or plus infinity
[[nodiscard]] ReferenceDraws draw_and_evaluate(const Problem& problem, const ReferenceDensity& reference,
                                               Index n, const StreamKey& key, std::uint32_t stage,
                                               int threads = 1, Index batch_rows = 2048);

/// log p - log(sum_r n_r q_r / sum_r n_r). Added to the log-likelihood times a temperature, this is
/// the logarithm of the weight in the deterministic mixture of all densities from which draws were
/// made (Owen and Zhou 2000; Cornuet, Marin, Mira and Robert 2012). Since later densities were
/// fitted to earlier draws, the mean weight is consistent but not unbiased.
[[nodiscard]] Eigen::VectorXd log_prior_weights(const ReferenceDraws& draws);

/// Log-weights for the posterior: log(L p) - log(sum_r n_r q_r / sum_r n_r).
[[nodiscard]] Eigen::VectorXd log_weights(const ReferenceDraws& draws);

/// log(sum_r n_r q_r) at other points: the logarithm of the expected number of draws per volume.
/// \param log_prior  log_prior_density(z, prior)
/// \param log_own  log-density from which these points are drawn
/// \param look  called before each density, if not empty; see Problem::look
[[nodiscard]] Eigen::VectorXd log_draws_per_volume(const ReferenceDraws& draws, const Population& z,
                                                   const Eigen::VectorXd& log_prior,
                                                   const Eigen::VectorXd& log_own, int threads = 1,
                                                   const std::function<void()>& look = {});

/// The draws with their weights, for a fit; the weights sum to the effective size. If the effective
/// size is below `fewest` or half of the feasible draws, the weights are raised to the power in (0,
/// 1] at which it is reached.
[[nodiscard]] WeightedPoints fit_points(const ReferenceDraws& draws, double fewest);

/// Draws weighted for L^beta p instead of the posterior.
struct TemperedPoints {
  /// Points whose weights sum to the effective size.
  WeightedPoints points;
  /// 0 if fewer than 10 draws are feasible.
  double beta = 0.0;
  /// Effective size of the weights at beta.
  double effective_sample_size = 0.0;
};
/// The largest beta in (0, 1] at which the effective size is at least `target` (or half of the
/// feasible draws): the criterion of TMCMC, applied to the draws of all rounds so far instead of
/// one population.
/// \param near  a beta in (0, 1] from which the search starts, such as that of the preceding round
[[nodiscard]] TemperedPoints tempered_points(const ReferenceDraws& draws, double target, double near = 1.0);

/// Settings for the evaluations of a search.
struct SearchOptions {
  /// Largest number of evaluations.
  Index evaluations = 5000;
  /// Smallest number of draws of a round.
  Index round = 200;
  /// Effective size of the tempered weights that chooses beta.
  double target = 100.0;
  /// Largest target, if a search ends early.
  double most_target = 100.0;
  /// Effective size at beta = 1 that ends a search.
  double enough = 1500.0;
  /// Share of prior draws in a round.
  double prior_share = 0.02;
  /// Share of wide draws among the others, see StudentMixture.
  double wide_share = 0.15;
  /// Settings for the fits of the densities.
  MixtureFitOptions fit = {};
  /// Threads over the rows of a batch.
  int threads = 1;
  /// See Options::batch_rows.
  Index batch_rows = 2048;
};

/// A completed search.
struct Search {
  /// Draws of all rounds, the first of them from the prior.
  ReferenceDraws draws;
  /// Fit of the last round.
  StudentMixture fit;
  /// Fit of the last round with beta below 0.3; no components if there was none.
  StudentMixture tempered;
  /// Effective size used to choose beta in the last pass.
  double target = 0.0;
  /// Largest number of separate modes of the fit of any round.
  Index most_modes = 1;
  /// Rounds of the last pass, without their points.
  std::vector<TemperedPoints> rounds;
  [[nodiscard]] double beta() const {
    return rounds.empty() ? 0.0 : rounds.back().beta;
    /// Of the last round.
  }
};

/// Tempered population Monte Carlo from the prior (Cappe, Guillin, Marin and Robert 2004; Cornuet,
/// Marin, Mira and Robert 2012): beta is chosen for the draws so far, a mixture is fitted to their
/// weights for L^beta p and drawn from, until beta is 1 and there are enough draws, or the
/// evaluations are used up. The draws of all rounds keep their weights. At beta = 1 a round makes
/// half as many draws as there are effective draws.
///
/// The larger the target, the fewer modes are lost on the way, and the more evaluations are needed.
/// A search that reaches beta = 1 early is therefore repeated from the prior with a target as large
/// as the remaining evaluations allow.
/// \throws SamplingError as draw_and_evaluate; InfeasiblePriorError if no draw is feasible.
[[nodiscard]] Search search_posterior(const Problem& problem, SearchOptions options, const StreamKey& key);

}  // namespace tmcmc
