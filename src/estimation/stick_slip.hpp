/// \file
/// The posterior of the friction force when responses with stick-slip are computed instead of being
/// given likelihood 0.
#pragma once

#include "estimation/exact_posterior.hpp"
#include "friction/observations.hpp"

namespace estimation {

/// Differences from the posterior in which a friction force beyond the limit of continuous motion
/// is infeasible.
struct StickSlipPosterior {
  /// Posterior probability of a friction force beyond the limit.
  double probability = 0.0;
  /// Estimated quadrature error of probability.
  double probability_error = 0.0;
  /// Mean of F_mu minus the mean without stick-slip, N.
  double mean_shift = 0.0;
  /// Standard deviation of F_mu, N.
  double standard_deviation = 0.0;
  /// log P(D) minus log P(D) without stick-slip.
  double log_evidence_change = 0.0;
};

/// Integrates the marginal of F_mu beyond the limit by adaptive Gauss-Kronrod quadrature between
/// the successive forces at which the motion of one more observation ceases to be continuous;
/// beyond its limit the phase of an observation comes from integration in time
/// (friction::integrate_steady_response). Where F_mu is at least the driving force the mass stays
/// at rest and has no phase, and the likelihood is 0.
/// \param likelihood  likelihood of the same observations with exact physics (friction::Physics
///        with its default rules, any driving force)
/// \param excluded  the posterior under that likelihood on the bounds
[[nodiscard]] StickSlipPosterior posterior_with_stick_slip(const friction::Observations& observations,
                                                           const friction::Likelihood& likelihood,
                                                           const ExactPosterior& excluded,
                                                           const ParameterBounds& bounds);

}  // namespace estimation
