/// \file
/// The representation of the posterior once it has been found: the last population of TMCMC, or
/// independent draws from a density that was fitted to it.
#pragma once

#include <string_view>
#include <variant>

#include "tmcmc/mixture_fit.hpp"
#include "tmcmc/option.hpp"

namespace tmcmc {

/// The result is the population at beta = 1, as in the paper.
struct NoFinish {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "none";
};

/// The posterior is measured by independent weighted draws, at a total cost of
/// Options::evaluation_budget log-likelihoods:
///
/// 1. Two independent searches by tempered population Monte Carlo (search_posterior()):
///    Options::criterion chooses beta for the draws so far, a mixture of Student t distributions is
///    fitted to them and drawn from, and so on from the prior to beta = 1. With N_eff = f N the
///    population N is a twentieth of the evaluations of a search beyond the first 600, at most 200
///    draws or 40 d, whichever is more; CoV = c is f = 1 / (1 + c^2), the same rule. There is a new
///    fit after each N/2 draws, but after no fewer than min(N, 100).
/// 2. One density q is fitted to the draws of both searches. Defensive shares of the prior, of the
///    tempered fits and of wider components keep the weights bounded where the fit is too narrow.
///    Trial draws, a sixth of the remaining evaluations, show whether q overlaps with the
///    posterior; if not, they are used for another fit.
/// 3. q is frozen, and the remaining evaluations are independent draws from it. With weights w = L
///    p / q the log-evidence is log(mean w). These draws include none that was used for a fit, so
///    that the mean weight is unbiased and its error is that of independent weights (except for the
///    trial draws, which influenced the decision to go on). If the effective number of these draws
///    is below four, the fit has failed: then all draws of searches and fits are used, weighted by
///    the mixture of their densities (WarningKind::low_overlap).
///
/// A mode that both searches have missed leaves no trace. The draws of each search alone are
/// therefore compared with the final draws: if one search missed a part m_1 of the posterior and
/// the other a part m_2, this suggests that both have missed about m_1 m_2, as in capture and
/// recapture (WarningKind::searches_differ). Modes are lost if beta is chosen from few effective
/// draws (WarningKind::few_draws_a_mode). If neither search comes near the posterior, TMCMC with
/// the other options uses the remaining evaluations (WarningKind::search_not_completed).
struct IndependentDraws {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "independent";

  /// Share of the evaluations for the two searches together; they get 1300 evaluations in addition,
  /// but never more than 0.64 of the budget.
  double search_share = 0.28;
  /// Effective share of the trial draws below which the fit is improved.
  double least_effective_share = 0.25;
  /// Share of the draws that come from the prior.
  double prior_share = 0.02;
  /// Share of the draws that come from the searches' fits at beta below 0.3.
  double tempered_share = 0.05;
  /// Share of the draws that come from wider components, see StudentMixture::wide_share; half as
  /// much again in the searches.
  double wide_share = 0.1;
  /// Settings for the fits of the densities.
  MixtureFitOptions fit = {};
};

/// Smallest Options::evaluation_budget allowed for IndependentDraws.
constexpr Index fewest_evaluations_of_independent_draws = 2000;

/// The final step of a run.
using Finish = std::variant<NoFinish, IndependentDraws>;

/// Calls visit(OptionInfo, pointer to the value) for each option of the finish.
template <class AnyFinish, class Visit>
void visit_finish_options(AnyFinish& finish, Visit&& visit) {
  using enum OptionGroup;
  auto* draws = std::get_if<IndependentDraws>(&finish);
  auto* fit = member_of(draws, &IndependentDraws::fit);
  const auto row = [](std::string_view name, OptionRange range, std::string_view help) {
    return OptionInfo{name, beyond_the_paper, range, help, "finish", IndependentDraws::name};
  };
  const OptionRange below_one{.least = 0.0, .most = 1.0, .below_most = true};
  visit({"finish", beyond_the_paper, named(), "What measures the posterior that was found"}, &finish);
  visit(row("search_share", {.least = 0.0, .most = 0.5, .above_least = true},
            "Share of the evaluations for the searches"),
        member_of(draws, &IndependentDraws::search_share));
  visit(row("least_effective_share", below_one, "Effective share of trial draws that a fit needs"),
        member_of(draws, &IndependentDraws::least_effective_share));
  visit(row("prior_share", below_one, "Share of the draws that are from the prior"),
        member_of(draws, &IndependentDraws::prior_share));
  visit(row("tempered_share", below_one, "Share of the draws from fits at a small beta"),
        member_of(draws, &IndependentDraws::tempered_share));
  visit(row("wide_share", {.least = 0.0, .most = 0.5},
            "Share of the draws from wider components; in searches half as much again"),
        member_of(draws, &IndependentDraws::wide_share));
  visit(row("mixture_degrees_of_freedom", whole_from(2, 1000), "Of the fitted Student t distributions; even"),
        member_of(fit, &MixtureFitOptions::degrees_of_freedom));
  visit(row("mixture_components", whole_from(1, 1000), "Most components of a fitted mixture"),
        member_of(fit, &MixtureFitOptions::most_components));
  visit(row("mixture_iterations", whole_from(1, 1e6), "Most iterations of a fit"),
        member_of(fit, &MixtureFitOptions::most_iterations));
  visit(row("mixture_tolerance", positive_number(), "Gain of the mean log-density that ends a fit"),
        member_of(fit, &MixtureFitOptions::tolerance));
  visit(row("mixture_gain", {.least = 0.0, .most = 1e100}, "Least gain of it for more components"),
        member_of(fit, &MixtureFitOptions::gain_of_component));
}

}  // namespace tmcmc
