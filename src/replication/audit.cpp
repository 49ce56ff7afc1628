#include "replication/audit.hpp"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "estimation/least_squares.hpp"
#include "friction/angle.hpp"
#include "friction/likelihood.hpp"
#include "replication/columns.hpp"

namespace replication {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double confidence = 0.95;

/// P(X > x); NaN stays NaN.
template <class Distribution>
double survival(const Distribution& distribution, double x) {
  if (std::isnan(x)) {
    return x;
  }
  return std::isinf(x) ? 0.0 : cdf(complement(distribution, x));
}

double sum_of_squares(const std::vector<double>& x) {
  return std::inner_product(x.begin(), x.end(), x.begin(), 0.0);
}

/// Misfit of one parameter with its least-squares fit.
struct Block {
  std::function<double(double)> misfit;
  const estimation::BlockFit& fit;
  double n;

  [[nodiscard]] double above_minimum(double x) const {
    const double excess = misfit(x) - fit.sum_of_squares;
    return excess < 0.0 ? 0.0 : excess;  // rounding at the minimum; NaN passes
  }

  [[nodiscard]] bool noise_is_determined() const {
    return fit.fitted_noise == estimation::FittedNoise::determined;
  }

  [[nodiscard]] double unbiased_variance() const {
    return noise_is_determined() ? fit.sum_of_squares / (n - 1.0) : not_a_number;
  }

  [[nodiscard]] PointTest test(double x) const {
    const double variance = fit.noise_given * fit.noise_given;
    PointTest t;
    t.value = x;
    t.chi_squared = misfit(x) / variance;
    t.chi_squared_p = survival(boost::math::chi_squared(n), t.chi_squared);
    t.likelihood_ratio = above_minimum(x) / variance;
    t.likelihood_ratio_p = survival(boost::math::chi_squared(1.0), t.likelihood_ratio);
    t.f_statistic = above_minimum(x) / unbiased_variance();
    t.f_p =
        noise_is_determined() ? survival(boost::math::fisher_f(1.0, n - 1.0), t.f_statistic) : not_a_number;
    return t;
  }

  /// The place between the estimate and a bound at which the misfit first has risen by `rise`; or
  /// the bound.
  [[nodiscard]] double end(double bound, double rise, bool& at_bound) const {
    constexpr int steps = 256;
    const auto excess = [&](double x) { return above_minimum(x) - rise; };
    double inside = fit.estimate;
    at_bound = false;
    for (int i = 1; i <= steps; ++i) {
      const double outside = i == steps ? bound : fit.estimate + (bound - fit.estimate) * i / steps;
      if (excess(outside) > 0.0) {
        std::uintmax_t iterations = 200;
        const auto root =
            boost::math::tools::toms748_solve(excess, std::min(inside, outside), std::max(inside, outside),
                                              boost::math::tools::eps_tolerance<double>(50), iterations);
        return 0.5 * (root.first + root.second);
      }
      inside = outside;
    }
    at_bound = true;
    return bound;
  }

  [[nodiscard]] ConfidenceInterval interval(double rise) const {
    ConfidenceInterval i;
    if (std::isnan(rise)) {
      i.lower = i.upper = not_a_number;
    } else {
      i.lower = end(fit.lower, rise, i.lower_at_bound);
      i.upper = end(fit.upper, rise, i.upper_at_bound);
    }
    return i;
  }

  [[nodiscard]] ParameterAudit audit(const std::vector<double>& values) const {
    ParameterAudit a;
    a.estimate = fit.estimate;
    a.noise_stated = fit.noise_given;
    a.fitted_noise = fit.fitted_noise;
    a.noise_unbiased = std::sqrt(unbiased_variance());
    a.chi_squared = fit.chi_squared;
    a.chi_squared_p = n > 1.0 ? survival(boost::math::chi_squared(n - 1.0), fit.chi_squared) : not_a_number;
    a.noise_known_95 =
        interval(fit.noise_given * fit.noise_given * quantile(boost::math::chi_squared(1.0), confidence));
    a.noise_unknown_95 =
        interval(noise_is_determined()
                     ? unbiased_variance() * quantile(boost::math::fisher_f(1.0, n - 1.0), confidence)
                     : not_a_number);
    for (const double x : values) {
      a.tests.push_back(test(x));
    }
    return a;
  }
};

}  // namespace

Audit audit(const friction::Observations& observations, const Truth& truth, double alternative_n,
            const friction::Physics& physics) {
  estimation::LeastSquaresOptions options;
  options.phase_noise_deg = truth.phase_noise_deg;
  options.frequency_ratio_noise = truth.frequency_ratio_noise;
  const auto fit = estimation::fit_least_squares(observations, physics, options);
  const friction::Likelihood likelihood(observations, physics);
  const std::size_t n = observations.size();

  Audit a;
  for (std::size_t i = 0; i < n; ++i) {
    const auto constants = friction::response_constants(observations.measured_ratio[i], physics);
    const auto residual = [&](double force_n) {
      return friction::angle_residual_deg(observations.phase_deg[i],
                                          friction::phase_deg(constants, force_n / physics.driving_force_n)) /
             truth.phase_noise_deg;
    };
    a.frequency_difference_hz.push_back(observations.driving_frequency_hz[i] -
                                        observations.measured_ratio[i] * truth.natural_frequency_hz);
    a.ratio_residual.push_back((observations.measured_ratio[i] - observations.nominal_ratio[i]) /
                               truth.frequency_ratio_noise);
    a.phase_residual_truth.push_back(residual(truth.friction_force_n));
    a.phase_residual_alternative.push_back(residual(alternative_n));
  }
  const auto count = static_cast<double>(n);
  a.ratio_chi_squared = sum_of_squares(a.ratio_residual);
  a.ratio_chi_squared_p = survival(boost::math::chi_squared(count), a.ratio_chi_squared);
  const Block phase{[&](double x) { return likelihood.phase_misfit(x); }, fit.friction_force, count};
  const Block frequency{[&](double x) { return likelihood.frequency_misfit(x); }, fit.natural_frequency,
                        count};
  a.friction_force = phase.audit({truth.friction_force_n, alternative_n});
  a.natural_frequency = frequency.audit({truth.natural_frequency_hz});
  return a;
}

std::vector<AuditLine> audit_lines(const Audit& audit) {
  const ConfidenceInterval none{.lower = not_a_number, .upper = not_a_number};
  std::vector<AuditLine> lines;
  const auto add = [&](const std::string& parameter, const std::vector<const char*>& hypotheses,
                       const ParameterAudit& a) {
    const PointTest fit{.value = a.estimate,
                        .chi_squared = a.chi_squared,
                        .chi_squared_p = a.chi_squared_p,
                        .likelihood_ratio_p = not_a_number,
                        .f_p = not_a_number};
    lines.push_back({parameter, "least squares", a.noise_stated, a.noise_unbiased, fit, a.noise_known_95,
                     a.noise_unknown_95});
    for (std::size_t i = 0; i < a.tests.size(); ++i) {
      lines.push_back({parameter, hypotheses[i], a.noise_stated, a.noise_unbiased, a.tests[i], none, none});
    }
  };
  add(parameter_columns[friction::friction_force], {"stated truth", "alternative"}, audit.friction_force);
  add(parameter_columns[friction::natural_frequency], {"stated truth"}, audit.natural_frequency);
  return lines;
}

}  // namespace replication
