/// \file
/// A posterior measured by independent draws: TMCMC finds it, a density that was fitted to it is frozen and drawn from.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tmcmc/reference_search.hpp"

namespace tmcmc {

/// How the evaluations are divided, and what is fitted.
struct IndependentDraws {
  Index evaluations = 31000;  ///< log-likelihoods in all, at least 2000; all of them are used
  /// Of the evaluations, for two TMCMC runs; each gets at least 2000, but never more than half of what there is for it.
  double first_pass_share = 0.2;
  /// Of what the runs leave, for the rounds that improve the fits; at least 600 a run, but never more than 0.35 of it.
  double refinement_share = 0.15;
  Index refinement_rounds = 3;  ///< at least 1
  double least_effective_share =
      0.25;                     ///< of the trial draws; below it the fit is improved up to three times more
  double prior_share = 0.02;    ///< of the draws: those from the prior
  double tempered_share = 0.1;  ///< of the draws: those from a fit to the populations at beta nearest to 1/4
  MixtureFitOptions fit = {};   ///< of the densities
  Index steps_per_chain = 15;   ///< of the TMCMC runs, about
  int threads = 1;              ///< over the rows of a batch
  Index batch_rows = 2048;      ///< see Options::batch_rows

  /// \throws errors::InvalidValue naming field, value and what was expected.
  void validate() const;
};

/// Signs that the weighted draws should not be believed without a second look.
enum class MeasurementWarningKind {
  first_pass_not_completed,  ///< a TMCMC run has ended before beta = 1: the fits started from a tempered posterior
  fits_differ,    ///< one fit has missed more than 2 % of the posterior: both may have missed another part
  low_overlap,    ///< effective share of the draws below least_effective_share: the error is a lower bound
  heavy_weights,  ///< k-hat above min(1 - 1 / log10(n), 0.7): the error is a lower bound
};

/// One finding.
struct MeasurementWarning {
  MeasurementWarningKind kind;  ///< for programs
  std::string message;          ///< what was found, against which bound, and what helps
};

/// A posterior as weighted independent draws.
struct MeasuredPosterior {
  Population points;                         ///< n x d
  Eigen::VectorXd log_likelihood;            ///< n
  Eigen::VectorXd weights;                   ///< n, with a mean of 1
  Evidence evidence;                         ///< log of the mean weight, with its error
  double effective_sample_size = 0.0;        ///< (sum w)^2 / sum w^2
  double pareto_shape = 0.0;                 ///< k-hat of the largest weights, see pareto_shape()
  ReferenceDensity reference;                ///< what the draws are from, in unbounded coordinates
  std::array<Result, 2> first_passes;        ///< the TMCMC runs
  std::array<double, 2> missed_mass{};       ///< posterior mass that the fit to each run alone does not cover
  Index evaluations = 0;                     ///< log-likelihoods in all
  std::vector<MeasurementWarning> warnings;  ///< empty for a result that looks healthy
};

/// Finds the posterior by TMCMC and measures it by independent draws:
///
/// 1. Two independent runs of recommended_options() in more and shorter chains. They serve the fits alone.
/// 2. To each a mixture q of Student t distributions in unbounded coordinates is fitted and improved by rounds of population
///    Monte Carlo: draw from q, weigh, fit again (Cappe, Douc, Guillin, Marin and Robert 2008). Defensive shares of the prior
///    and of a fit to the tempered populations keep the weights bounded where a fit is too narrow.
/// 3. One density is fitted to the states of both runs and to the draws of all rounds, and frozen. An eighth of the remaining draws
///    tells whether it overlaps with the posterior; if not, they serve another fit.
/// 4. The other draws are independent draws from the frozen density. With weights w = L p / q, log(mean w) is the log-evidence.
///    No draw that a fit has seen is among them, so that the mean weight is unbiased, and its error is that of independent
///    weights (up to the eighth, which the decision to go on has seen).
///
/// Since a mode that both runs have lost leaves no trace, the fit to each run alone is compared with the final draws: where
/// one has missed a part of the posterior (fits_differ), both may have missed another. A mode that both have lost and that is
/// too narrow for the defensive draws stays silent: more runs of other seeds, or knowledge of the problem, must tell. In many dimensions (20 and more at 31000
/// evaluations) the weights degenerate, with a warning; the evidence of a TMCMC run is then the better one.
/// \throws errors::InvalidValue for invalid settings; SamplingError as run().
[[nodiscard]] MeasuredPosterior run_with_independent_draws(const Problem& problem,
                                                           const IndependentDraws& settings,
                                                           const StreamKey& key);

/// n equally weighted points, n x d, by residual resampling of the weighted ones (Douc, Cappe and Moulines 2005).
/// \throws errors::InvalidValue for n below 1
[[nodiscard]] Population equally_weighted(const MeasuredPosterior& measured, Index n, const StreamKey& key);

}  // namespace tmcmc
