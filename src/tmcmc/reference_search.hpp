/// \file
/// Population Monte Carlo: draws from reference densities, their weights, and the search for the posterior by them.
#pragma once

#include "tmcmc/importance.hpp"
#include "tmcmc/mixture_fit.hpp"
#include "tmcmc/reference_density.hpp"
#include "tmcmc/sampler.hpp"

namespace tmcmc {

/// Draws from one or several reference densities q_r = (1 - s_r) f_r + s_r p, in unbounded coordinates, n_r from each. Sums of these
/// densities are kept relative to that of the own density of each draw, where nothing can overflow.
struct ReferenceDraws {
  Population z;                    ///< n x d
  Eigen::VectorXd log_prior;       ///< n, log_prior_density(z, prior)
  Eigen::VectorXd log_likelihood;  ///< n
  Eigen::VectorXd log_own;         ///< n, log-density of the reference density that the draw is from
  Eigen::VectorXd fitted;          ///< n, sum_r n_r (1 - s_r) f_r over that density
  std::vector<ReferenceDensity> references;  ///< q_r, in the order of their draws
  std::vector<Index> counts;                 ///< n_r, those that are excluded among them

  /// sum_r n_r, the evaluations that the draws have cost.
  [[nodiscard]] Index evaluations() const;
  /// Adds the draws that are not excluded, of weight 0; each density is evaluated at the draws of the other side.
  /// \param look  called before each density, if not empty; see Problem::look
  void append(const ReferenceDraws& other, int threads = 1, const std::function<void()>& look = {});
  /// Adds draws from the same single density as these.
  void append_of_same_density(const ReferenceDraws& other);
};

/// n draws from a frozen density.
/// \param stage  see sample(ReferenceDensity)
/// \throws SamplingError for a log-likelihood of NaN or plus infinity
[[nodiscard]] ReferenceDraws draw_and_evaluate(const Problem& problem, const ReferenceDensity& reference,
                                               Index n, const StreamKey& key, std::uint32_t stage,
                                               int threads = 1, Index batch_rows = 2048);

/// log p - log(sum_r n_r q_r / sum_r n_r): with the log-likelihood, times a temperature, it is the logarithm of the weight in the
/// deterministic mixture of all densities that were drawn from (Owen and Zhou 2000; Cornuet, Marin, Mira and Robert 2012). Where the
/// later densities were fitted to the earlier draws, the mean weight is consistent but not unbiased.
[[nodiscard]] Eigen::VectorXd log_prior_weights(const ReferenceDraws& draws);

/// The same of the posterior: log(L p) - log(sum_r n_r q_r / sum_r n_r).
[[nodiscard]] Eigen::VectorXd log_weights(const ReferenceDraws& draws);

/// log(sum_r n_r q_r) at other points: the expected number of the draws per volume.
/// \param log_prior  log_prior_density(z, prior)
/// \param log_own  log-density that these points are drawn from
/// \param look  called before each density, if not empty; see Problem::look
[[nodiscard]] Eigen::VectorXd log_draws_per_volume(const ReferenceDraws& draws, const Population& z,
                                                   const Eigen::VectorXd& log_prior,
                                                   const Eigen::VectorXd& log_own, int threads = 1,
                                                   const std::function<void()>& look = {});

/// The draws with their weights, for a fit: these sum to the effective size. Where that is below `fewest` or half of the
/// feasible draws, the weights are raised to the power in (0, 1] at which it is reached.
[[nodiscard]] WeightedPoints fit_points(const ReferenceDraws& draws, double fewest);

/// Draws weighed for L^beta p in place of the posterior.
struct TemperedPoints {
  WeightedPoints points;               ///< their weights sum to the effective size
  double beta = 0.0;                   ///< 0 where fewer than 10 draws are feasible
  double effective_sample_size = 0.0;  ///< of the weights at beta
};
/// The largest beta in (0, 1] at which the effective size is at least `target` (or half of the feasible draws): the criterion
/// of TMCMC, for the draws of all rounds so far in place of one population.
/// \param near  a beta in (0, 1] from which to look, such as that of the round before
[[nodiscard]] TemperedPoints tempered_points(const ReferenceDraws& draws, double target, double near = 1.0);

/// How a search spends its evaluations.
struct SearchOptions {
  Index evaluations = 5000;    ///< at most
  Index round = 200;           ///< draws of a round, at least
  double target = 100.0;       ///< effective size of the tempered weights that chooses beta
  double most_target = 100.0;  ///< to which it grows where a search ends early
  double enough = 1500.0;      ///< effective size at beta = 1 that ends a search
  double prior_share = 0.02;   ///< of the draws of a round
  double wide_share = 0.15;    ///< of the others, see StudentMixture
  MixtureFitOptions fit = {};  ///< of the densities
  int threads = 1;             ///< over the rows of a batch
  Index batch_rows = 2048;     ///< see Options::batch_rows
};

/// A search that is done.
struct Search {
  ReferenceDraws draws;     ///< of all rounds, the first of them from the prior
  StudentMixture fit;       ///< of the last round
  StudentMixture tempered;  ///< of the last round with beta below 0.3; without components if there was none
  double target = 0.0;      ///< effective size that chose beta in the end
  Index most_modes = 1;     ///< separate modes of the fit of any round, at most
  std::vector<TemperedPoints> rounds;  ///< of the last pass, without their points
  [[nodiscard]] double beta() const {
    return rounds.empty() ? 0.0 : rounds.back().beta;
  }  ///< of the last round
};

/// Tempered population Monte Carlo from the prior (Cappe, Guillin, Marin and Robert 2004; Cornuet, Marin, Mira and Robert
/// 2012): beta is chosen for the draws so far, a mixture is fitted to their weights for L^beta p and drawn from, until beta is 1 and
/// the draws suffice, or the evaluations are spent. The draws of all rounds keep their weights. At beta = 1 a round has half as many
/// draws as there are effective ones.
///
/// The larger the target, the fewer modes are lost on the way, and the more evaluations it takes. So a search that
/// comes to beta = 1 early is repeated from the prior with as large a target as the rest of the evaluations allows.
/// \throws SamplingError as draw_and_evaluate; InfeasiblePriorError if no draw is feasible.
[[nodiscard]] Search search_posterior(const Problem& problem, SearchOptions options, const StreamKey& key);

}  // namespace tmcmc
