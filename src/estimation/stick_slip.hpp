/// \file
/// The posterior of the friction force if responses with stick-slip are computed, instead of given the likelihood 0.
#pragma once

#include "estimation/exact_posterior.hpp"
#include "friction/observations.hpp"

namespace estimation {

/// What changes against the posterior in which a friction force beyond the limit of continuous motion is infeasible.
struct StickSlipPosterior {
  double probability = 0.0;          ///< of a friction force beyond the limit
  double probability_error = 0.0;    ///< estimated error of the quadrature behind it
  double mean_shift = 0.0;           ///< mean of F_mu minus that without stick-slip, N
  double standard_deviation = 0.0;   ///< of F_mu, N
  double log_evidence_change = 0.0;  ///< log P(D) minus that without stick-slip
};

/// Integrates the marginal of F_mu beyond the limit by adaptive Gauss-Kronrod quadrature between the forces at which the
/// motion of one observation after the other stops; there its phase comes from integration in time
/// (friction::integrate_steady_response). From the driving force on the mass rests, has no phase, and the likelihood is 0.
/// \param likelihood  of the same observations, exact physics (friction::Physics as it is by default, any driving force)
/// \param excluded  the posterior of that likelihood on the bounds
[[nodiscard]] StickSlipPosterior posterior_with_stick_slip(const friction::Observations& observations,
                                                           const friction::Likelihood& likelihood,
                                                           const ExactPosterior& excluded,
                                                           const ParameterBounds& bounds);

}  // namespace estimation
