/// \file
/// Choice of the tempering step: the coefficient-of-variation rule of TMCMC (Eq. 6) and the
/// effective-sample-size rule of TMCMC-II (Eq. 9), each solved as written. With the population
/// standard deviation N_eff = N / (1 + CoV^2), so that CoV = 1 and N_eff = N/2 are the same
/// equation.
#pragma once

#include <string_view>
#include <variant>

#include "tmcmc/log_weights.hpp"
#include "tmcmc/option.hpp"

namespace tmcmc {

/// Rule: the coefficient of variation of the weights is `target` (Eq. 6).
struct CoefficientOfVariation {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "coefficient-of-variation";

  /// Target; 1 is 100 %.
  double target = 1.0;
};

/// Rule: the effective sample size of the weights is this fraction of the samples counted (Eq. 9).
struct EffectiveSampleSize {
  /// Name on the command line and in checkpoints.
  static constexpr std::string_view name = "effective-sample-size";

  /// Fraction of N, in (0, 1].
  double fraction = 0.5;
};

/// A rule for the tempering step, as a value.
struct Criterion {
  /// The rule: Eq. 6 or Eq. 9.
  std::variant<CoefficientOfVariation, EffectiveSampleSize> rule;
  /// Deviation used in the coefficient of variation, which the record of a stage holds under either
  /// rule.
  Deviation deviation = Deviation::population;
  /// The samples to which the criterion applies.
  Counted counted = Counted::feasible;
};

/// The rule CoV = target (Eq. 6).
[[nodiscard]] Criterion coefficient_of_variation_rule(double target = 1.0);
/// The rule N_eff = fraction of the samples counted (Eq. 9).
[[nodiscard]] Criterion effective_sample_size_rule(double fraction = 0.5);

/// Calls visit(OptionInfo, pointer to the value) for each option of the criterion.
template <class AnyCriterion, class Visit>
void visit_criterion_options(AnyCriterion& criterion, Visit&& visit) {
  using enum OptionGroup;
  auto& rule = criterion.rule;
  visit({"criterion", computation, named(), "Which number of the weights the tempering step is chosen by"},
        &rule);
  visit({"cov_target", paper, positive_number(), "Criterion of TMCMC (Eq. 6)", "criterion",
         CoefficientOfVariation::name},
        member_of(std::get_if<CoefficientOfVariation>(&rule), &CoefficientOfVariation::target));
  visit({"ess_fraction",
         paper,
         {.least = 0.0, .most = 1.0, .above_least = true},
         "Criterion of TMCMC-II as a fraction of N (Eq. 9)",
         "criterion",
         EffectiveSampleSize::name},
        member_of(std::get_if<EffectiveSampleSize>(&rule), &EffectiveSampleSize::fraction));
  visit({"deviation", paper, named(), "Standard deviation in the CoV (Eq. 6): N or N-1"},
        &criterion.deviation);
  visit({"counted", paper, named(), "Samples that the criterion counts"}, &criterion.counted);
}

/// How the search for a step ended.
enum class TemperingStatus {
  /// The remaining step already meets the criterion.
  final_step,
  /// A root was found.
  solved,
  /// Only a step of 0 meets the criterion (N_eff = N), or no step of at least 1e-300 does.
  zero_step,
  /// No positive step meets the criterion: too few samples are feasible.
  unreachable,
  /// Every log-likelihood is minus infinity.
  infeasible
};

/// A step of beta with the results of the search.
struct TemperingStep {
  /// Step dbeta.
  double step = 0.0;
  /// How the search ended.
  TemperingStatus status = TemperingStatus::solved;
  /// Effective sample size at the step; 0 if no step was found.
  double effective_sample_size = 0.0;
  /// Coefficient of variation at the step, with the criterion's deviation and count.
  double coefficient_of_variation = 0.0;
  /// Lower end of the final bracket of the root.
  double bracket_low = 0.0;
  /// Upper end of the bracket; both ends are 0 if there was no search.
  double bracket_high = 0.0;
  /// Number of evaluations of all weights.
  int evaluations = 0;
};

/// The largest step in (0, remaining] that satisfies the criterion: `remaining` itself if it does,
/// otherwise the root, bracketed from the spread of the log-likelihoods and solved in log(step) by
/// Algorithm 748 (Alfeld, Potra and Shi 1995) to 1e-13 relative. Steps down to 1e-300 are resolved.
/// \param log_likelihood  free of NaN and plus infinity
/// \param remaining  1 - beta, positive
/// \param threads  number of threads; the result does not depend on it
[[nodiscard]] TemperingStep choose_step(ConstDoubles log_likelihood, double remaining,
                                        const Criterion& criterion, int threads = 1);

}  // namespace tmcmc
