/// \file
/// Choice of the tempering step: the coefficient-of-variation rule of TMCMC (Eq. 6) and the
/// effective-sample-size rule of TMCMC-II (Eq. 9), each solved as it is written. With the population standard
/// deviation N_eff = N / (1 + CoV^2), so that CoV = 1 and N_eff = N/2 are the same equation.
#pragma once

#include <string>

#include "tmcmc/log_weights.hpp"

namespace tmcmc {

/// Which number of the weights a step is chosen by.
enum class CriterionKind { coefficient_of_variation, effective_sample_size };

/// A rule for the tempering step, as a value.
struct Criterion {
  CriterionKind kind = CriterionKind::coefficient_of_variation;  ///< Eq. 6 or Eq. 9
  double target = 1.0;  ///< CoV (Eq. 6: 1), or N_eff as a fraction of the samples counted (Eq. 9: 1/2)
  Deviation deviation = Deviation::population;  ///< for the coefficient of variation
  Counted counted = Counted::feasible;          ///< the samples that the criterion is about

  /// \throws std::invalid_argument unless target is positive, and at most 1 for the effective sample size.
  void validate() const;
};

/// CoV = target (Eq. 6).
[[nodiscard]] Criterion coefficient_of_variation_rule(double target = 1.0);
/// N_eff = fraction of the samples counted (Eq. 9).
[[nodiscard]] Criterion effective_sample_size_rule(double fraction = 0.5);

/// How the search for a step ended.
enum class TemperingStatus {
  final_step,   ///< the remaining step already meets the criterion
  solved,       ///< root found
  zero_step,    ///< only a step of 0 meets the criterion (N_eff = N), or none of 1e-300 and more
  unreachable,  ///< no positive step meets it: too few samples are feasible
  infeasible    ///< every log-likelihood is minus infinity
};

/// A step of beta with what the search found on the way.
struct TemperingStep {
  double step = 0.0;                                 ///< dbeta
  TemperingStatus status = TemperingStatus::solved;  ///< how the search ended
  double effective_sample_size = 0.0;                ///< at the step; 0 where no step was found
  double coefficient_of_variation = 0.0;  ///< at the step, with the criterion's deviation and count
  double bracket_low = 0.0;               ///< final bracket of the root
  double bracket_high = 0.0;              ///< the larger end; both 0 where there was no search
  int evaluations = 0;                    ///< evaluations of all weights
};

/// The largest step in (0, remaining] that keeps the criterion: `remaining` itself if it does, else the root,
/// bracketed from the spread of the log-likelihoods and solved in log(step) by Algorithm 748 (Alfeld, Potra
/// and Shi 1995) to 1e-13 relative. Steps down to 1e-300 are resolved.
/// \param log_likelihood  free of NaN and plus infinity
/// \param remaining  1 - beta, positive
/// \param threads  the result does not depend on it
[[nodiscard]] TemperingStep choose_step(ConstDoubles log_likelihood, double remaining,
                                        const Criterion& criterion, int threads = 1);

}  // namespace tmcmc
