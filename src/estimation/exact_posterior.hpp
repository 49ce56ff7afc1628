/// \file
/// The posterior of Eq. 24 under independent priors, by quadrature: evidence, marginals and
/// independent draws without a Markov chain.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "estimation/noise_conditional.hpp"
#include "estimation/parameter_prior.hpp"
#include "estimation/tabulated_density.hpp"
#include "friction/likelihood.hpp"

namespace estimation {

/// Tolerance and limits of the quadrature behind ExactPosterior.
struct ExactPosteriorOptions {
  /// Largest estimated error of the evidence and of any marginal probability, as a fraction of the
  /// evidence; from 1e-14 to 1e-2. It is a requirement, not a goal: the panels are refined to 1e-12
  /// whatever its value. The attainable error is limited by rounding in misfit / sigma^2: about
  /// 1e-13 for Table 1 and 1e-9 for 2000 observations with noise of 1e-3 deg.
  double relative_tolerance = 1e-8;
  /// Number of intervals that are scanned for local minima of the misfit before the minima are
  /// refined; from 16 to 1e6.
  int scan_intervals = 1024;
  /// Largest number of panels of one marginal; from 16 to 1e6.
  int max_panels = 4000;

  /// \throws errors::InvalidValue if a field is out of its range.
  void validate() const;
};

/// Exact posterior of (F_mu, omega_n, sigma_phase, sigma_r). It is a product of two densities of a
/// location x (F_mu or omega_n) and a noise level sigma (sigma_phase or sigma_r), each proportional
/// to
///
///     prior(x) prior(sigma) sigma^-n exp(-S(x) / (2 sigma^2)),
///
/// where S is Likelihood::phase_misfit (where the motion is continuous) or
/// Likelihood::frequency_misfit. The marginal of x is the integral over sigma at given S
/// (log_noise_integral); the marginal of sigma is the sum over the quadrature nodes in x. Each
/// marginal is tabulated (TabulatedDensity) on panels that are graded towards every local minimum
/// of S, and the two must integrate to the same evidence.
///
/// Infeasible friction forces have likelihood 0: a penalty of -1e10 instead would add less than any
/// double. Results do not depend on the C library, except through sqrt, which IEEE 754 specifies
/// exactly. Const members may be called concurrently.
class ExactPosterior {
 public:
  /// Time: about 1e4 evaluations of the misfit.
  /// \throws errors::InvalidValue for invalid bounds or options, and for the field
  ///         friction_force.lower if no friction force inside the bounds is feasible, so that the
  ///         evidence is 0; IntegrationError, naming the parameter, if relative_tolerance is not
  ///         met.
  ExactPosterior(const friction::Likelihood& likelihood, const ParameterBounds& bounds,
                 const ExactPosteriorOptions& options = {});

  /// As the constructor above, under independent priors that are not uniform. A prior correlation
  /// between (F_mu, sigma_phase) and (omega_n, sigma_r) is not supported: the posterior would no
  /// longer factorise into two densities of two parameters each.
  /// \throws as above; errors::InvalidValue for priors that ranges_of() refuses
  ExactPosterior(const friction::Likelihood& likelihood, const ParameterPriors& priors,
                 const ExactPosteriorOptions& options = {});

  /// log P(D): the likelihood averaged over the normalised prior.
  [[nodiscard]] double log_evidence() const;

  /// Estimated relative error of the evidence and of marginal probabilities, below
  /// relative_tolerance.
  [[nodiscard]] double relative_error() const;

  /// Marginal posterior, in the unit of the parameter.
  [[nodiscard]] const TabulatedDensity& marginal(friction::Parameter parameter) const;

  /// Number of local minima of the misfit in F_mu or omega_n within the bounds, ends included.
  /// \throws errors::InvalidValue for a noise level.
  [[nodiscard]] std::size_t mode_count(friction::Parameter location) const;

  /// The point of the posterior that corresponds to four independent uniform numbers in (0, 1), in
  /// the order of friction::Parameter: F_mu and omega_n by the inverse of their marginal
  /// distribution functions, sigma_phase and sigma_r by the inverse of the conditional ones.
  /// Independent uniform numbers give independent exact draws. The inverses are solved, not
  /// interpolated: their error in probability is below 1e-12 beyond relative_error(). Time: about 2
  /// us and one evaluation of each misfit; under priors that are not uniform about a millisecond,
  /// since the conditional density of a noise level is tabulated for each draw.
  [[nodiscard]] std::array<double, friction::parameter_count> draw(
      const std::array<double, friction::parameter_count>& uniforms) const;

 private:
  struct Pair {
    std::size_t modes;
    TabulatedDensity location;
    TabulatedDensity noise;
    std::optional<NoiseConditional> conditional;  // for uniform priors
    ParameterPrior noise_prior = {};              // for other priors

    [[nodiscard]] double noise_quantile(std::size_t count, double misfit, double p) const;
  };

  [[nodiscard]] static Pair integrate(const friction::Likelihood& likelihood, const ParameterBounds& bounds,
                                      const ExactPosteriorOptions& options, friction::Parameter location,
                                      friction::Parameter noise, const ParameterPriors* priors);

  friction::Likelihood likelihood_;
  double log_prior_density_;
  Pair phase_;
  Pair frequency_;
};

}  // namespace estimation
