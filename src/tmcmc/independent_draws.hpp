/// \file
/// A posterior measured by independent draws: a search finds it, a density that was fitted to it is frozen and drawn from.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tmcmc/reference_search.hpp"

namespace tmcmc {

/// How the evaluations are divided, and what is fitted.
struct IndependentDraws {
  Index evaluations = 31000;  ///< log-likelihoods in all, at least 2000; all of them are used
  Criterion criterion = effective_sample_size_rule(0.5);  ///< chooses beta in the searches
  /// Of the evaluations, for two searches; at least 2400, but never more than half of what there is.
  double search_share = 0.32;
  double least_effective_share = 0.25;  ///< of the trial draws; below it the fit is improved
  double prior_share = 0.02;            ///< of the draws: those from the prior
  double tempered_share = 0.1;          ///< of the draws: those from the searches' fits at beta below 0.3
  MixtureFitOptions fit = {};           ///< of the densities
  int threads = 1;                      ///< over the rows of a batch
  Index batch_rows = 2048;              ///< see Options::batch_rows

  /// \throws errors::InvalidValue naming field, value and what was expected.
  void validate() const;
};

/// Signs that the weighted draws should not be believed without a second look.
enum class MeasurementWarningKind {
  search_not_completed,  ///< neither search has come near the posterior: the result is that of a run of TMCMC
  tmcmc,                 ///< of that run
  fits_differ,    ///< the searches have missed different parts of the posterior: both may have missed another
  low_overlap,    ///< fewer than 500 effective draws, or less than a twentieth of the draws
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
  std::array<double, 2> search_beta{};       ///< temperature that each search has reached
  std::array<double, 2> missed_mass{};       ///< posterior mass where each search has hardly drawn
  std::optional<Result> tmcmc;               ///< the run that took over where the searches failed
  Index evaluations = 0;                     ///< log-likelihoods in all
  std::vector<MeasurementWarning> warnings;  ///< empty for a result that looks healthy
};

/// Finds the posterior and measures it by independent draws:
///
/// 1. Two independent searches (search_posterior()): from the prior, the criterion chooses beta for the draws so far, a mixture
///    of Student t distributions is fitted to them and drawn from, and so on to beta = 1. With N_eff = f N the population N is
///    200 draws, or 40 d if that is more; CoV = c is f = 1 / (1 + c^2), the same rule.
/// 2. One density is fitted to the draws of both and frozen. Defensive shares of the prior and of the tempered fits keep the
///    weights bounded where the fit is too narrow. An eighth of the remaining draws tells whether it overlaps with the
///    posterior; if not, they serve another fit.
/// 3. The other draws are independent draws from the frozen density. With weights w = L p / q, log(mean w) is the log-evidence.
///    No draw that a fit has seen is among them, so that the mean weight is unbiased, and its error is that of independent
///    weights (up to the eighth, which the decision to go on has seen).
///
/// Since a mode that both searches have missed leaves no trace, the draws of each alone are compared with the final ones: a part m_1
/// of the posterior missed by one and m_2 by the other suggests that both have missed about m_1 m_2 (as in capture and
/// recapture), with the warning fits_differ. A mode so narrow that no draw has met it stays silent. Where neither search comes
/// to beta = 0.01 (more than 20 dimensions at 31000 evaluations), recommended_options() get the remaining evaluations, with
/// their own warnings besides search_not_completed.
/// \throws errors::InvalidValue for invalid settings; SamplingError as run().
[[nodiscard]] MeasuredPosterior run_with_independent_draws(const Problem& problem,
                                                           const IndependentDraws& settings,
                                                           const StreamKey& key);

/// n equally weighted points, n x d, by residual resampling of the weighted ones (Douc, Cappe and Moulines 2005).
/// \throws errors::InvalidValue for n below 1
[[nodiscard]] Population equally_weighted(const MeasuredPosterior& measured, Index n, const StreamKey& key);

}  // namespace tmcmc
