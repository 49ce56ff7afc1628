#include "estimation/exact_posterior.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <sstream>
#include <vector>

#include "errors/invalid_value.hpp"
#include "estimation/graded_mesh.hpp"
#include "portable_math/elementary.hpp"
#include "portable_math/sums.hpp"

namespace estimation {

namespace {

using portable_math::exp;
using portable_math::log;

template <class Value>
void require_range(const char* field, Value value, Value low, Value high) {
  if (!(value >= low && value <= high)) {
    std::ostringstream range;
    range << "a number from " << low << " to " << high;
    throw errors::InvalidValue(field, value, range.str());
  }
}

void require_tolerance(const std::string& what, double error, double tolerance) {
  if (!(error <= tolerance)) {
    std::ostringstream message;
    message << what << ": the estimated relative error " << error
            << " exceeds relative_tolerance = " << tolerance;
    throw IntegrationError(message.str());
  }
}

struct Minima {
  std::vector<double> places;
  std::vector<double> separators;  // the highest grid points between them
};

/// Local minima of f, ends included: bracketed on a grid of equidistant or geometrically spaced
/// points, and refined.
Minima local_minima(const std::function<double(double)>& f, const Interval& range, int intervals,
                    bool geometric) {
  std::vector<double> x;
  std::vector<double> value;
  const double log_ratio = geometric ? log(range.upper / range.lower) : 0.0;
  for (int i = 0; i <= intervals; ++i) {
    const double fraction = static_cast<double>(i) / intervals;
    const double inside =
        geometric ? range.lower * exp(fraction * log_ratio) : range.lower + fraction * range.width();
    x.push_back(i == 0 ? range.lower : i == intervals ? range.upper : inside);
    value.push_back(f(x.back()));
  }
  Minima minima;
  std::size_t highest = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    highest = value[i] > value[highest] ? i : highest;
    const bool below_left = i == 0 || value[i] < value[i - 1];
    const bool below_right = i + 1 == x.size() || value[i] <= value[i + 1];
    if (!(below_left && below_right)) {
      continue;
    }
    const double left = x[i == 0 ? 0 : i - 1];
    const double right = x[std::min(i + 1, x.size() - 1)];
    const auto [place, refined] =
        boost::math::tools::brent_find_minima(f, left, right, std::numeric_limits<double>::digits / 2);
    if (!minima.places.empty()) {
      minima.separators.push_back(x[highest]);
    }
    minima.places.push_back(refined < value[i] ? place : x[i]);
    highest = i;
  }
  return minima;
}

/// The mesh with the breaks of a prior that lie inside it.
std::vector<double> with_breaks(std::vector<double> mesh, const ParameterPrior* prior) {
  if (prior != nullptr) {
    const double low = mesh.front();
    const double high = mesh.back();
    std::copy_if(prior->breaks.begin(), prior->breaks.end(), std::back_inserter(mesh),
                 [=](double x) { return x > low && x < high; });
    std::sort(mesh.begin(), mesh.end());
    mesh.erase(std::unique(mesh.begin(), mesh.end()), mesh.end());
  }
  return mesh;
}

/// Marginal of the noise level: prior times sigma^-n times sum_k weight_k exp(-S_k / (2 sigma^2)).
TabulatedDensity tabulate_noise(friction::Parameter parameter, std::size_t count, const Interval& range,
                                const std::vector<double>& weights, const std::vector<double>& misfits,
                                const ParameterPrior* prior, const ExactPosteriorOptions& options) {
  const double smallest = *std::min_element(misfits.begin(), misfits.end());
  const auto log_density = [&](double sigma) {
    const double scale = 0.5 / (sigma * sigma);
    const double sum = portable_math::sum_of(
        misfits.size(), [&](std::size_t k) { return weights[k] * exp(scale * (smallest - misfits[k])); });
    const double log_likelihood = log(sum) - static_cast<double>(count) * log(sigma) - scale * smallest;
    return prior == nullptr ? log_likelihood : log_likelihood + prior->log_density(sigma);
  };
  const Minima modes = local_minima([&](double sigma) { return -log_density(sigma); }, range,
                                    std::min(options.scan_intervals, 512), true);
  const auto drop = [&](double from, double to) { return log_density(from) - log_density(to); };
  TabulationOptions tabulation;
  tabulation.max_panels = options.max_panels;
  return {name_of(parameter), log_density,
          with_breaks(graded_mesh(range.lower, range.upper, modes.places, modes.separators, drop), prior),
          tabulation};
}

/// The part of the prior interval of F_mu where the motion is continuous, a few roundings below the
/// limit: the force is divided by the driving force and compared again.
Interval feasible(const Interval& prior, const friction::Likelihood& likelihood) {
  const double limit =
      likelihood.limit_friction_force_n() * (1.0 - 4.0 * std::numeric_limits<double>::epsilon());
  if (!(prior.lower < limit)) {
    std::ostringstream expected;
    expected << "less than " << limit << " N, the limit of continuous motion";
    throw errors::InvalidValue("friction_force.lower", prior.lower, expected.str());
  }
  return {prior.lower, std::min(prior.upper, limit)};
}

}  // namespace

void ExactPosteriorOptions::validate() const {
  require_range("relative_tolerance", relative_tolerance, 1e-14, 1e-2);
  require_range("scan_intervals", scan_intervals, 16, 1000000);
  require_range("max_panels", max_panels, 16, 1000000);
}

ExactPosterior::ExactPosterior(const friction::Likelihood& likelihood, const ParameterBounds& bounds,
                               const ExactPosteriorOptions& options)
    : likelihood_(likelihood),
      log_prior_density_((options.validate(), estimation::validate(bounds), -estimation::log_volume(bounds))),
      phase_(
          integrate(likelihood, bounds, options, friction::friction_force, friction::phase_noise, nullptr)),
      frequency_(integrate(likelihood, bounds, options, friction::natural_frequency,
                           friction::frequency_ratio_noise, nullptr)) {}

ExactPosterior::ExactPosterior(const friction::Likelihood& likelihood, const ParameterPriors& priors,
                               const ExactPosteriorOptions& options)
    : likelihood_(likelihood),
      log_prior_density_((options.validate(), 0.0)),  // the densities of the priors hold their constants
      phase_(integrate(likelihood, ranges_of(priors), options, friction::friction_force,
                       friction::phase_noise, &priors)),
      frequency_(integrate(likelihood, ranges_of(priors), options, friction::natural_frequency,
                           friction::frequency_ratio_noise, &priors)) {}

ExactPosterior::Pair ExactPosterior::integrate(const friction::Likelihood& likelihood,
                                               const ParameterBounds& bounds,
                                               const ExactPosteriorOptions& options,
                                               friction::Parameter location, friction::Parameter noise,
                                               const ParameterPriors* priors) {
  const std::size_t count = likelihood.observation_count();
  const bool phase = location == friction::friction_force;
  const std::function<double(double)> misfit = [&likelihood, phase](double x) {
    return phase ? likelihood.phase_misfit(x) : likelihood.frequency_misfit(x);
  };
  const Interval noise_range = bounds[static_cast<std::size_t>(noise)];
  const Interval prior_range = bounds[static_cast<std::size_t>(location)];
  const Interval range = phase ? feasible(prior_range, likelihood) : prior_range;

  const Minima minima = local_minima(misfit, range, options.scan_intervals, false);
  double smallest_misfit = std::numeric_limits<double>::infinity();
  for (const double x : minima.places) {
    smallest_misfit = std::min(smallest_misfit, misfit(x));
  }
  const ParameterPrior* location_prior =
      priors == nullptr ? nullptr : &(*priors)[static_cast<std::size_t>(location)];
  const ParameterPrior* noise_prior =
      priors == nullptr ? nullptr : &(*priors)[static_cast<std::size_t>(noise)];
  std::optional<NoiseIntegral> noise_integral;
  if (noise_prior != nullptr) {
    noise_integral.emplace(count, *noise_prior);
  }
  const double sharpest = noise_integral ? noise_integral->smallest_noise(smallest_misfit, 50.0)
                                         : smallest_noise(count, noise_range, smallest_misfit, 50.0);
  const auto location_drop = [&](double from, double to) {
    return 0.5 * (misfit(to) - misfit(from)) / (sharpest * sharpest);
  };
  TabulationOptions tabulation;
  tabulation.max_panels = options.max_panels;
  const TabulatedDensity location_table(
      name_of(location),
      [&](double x) {
        return noise_integral ? (*noise_integral)(misfit(x)) + location_prior->log_density(x)
                              : log_noise_integral(count, noise_range, misfit(x));
      },
      with_breaks(graded_mesh(range.lower, range.upper, minima.places, minima.separators, location_drop),
                  location_prior),
      tabulation);

  std::vector<double> misfits;
  std::vector<double> weights = location_table.weights();
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double x = location_table.nodes()[k];
    misfits.push_back(misfit(x));
    weights[k] *= location_prior == nullptr ? 1.0 : exp(location_prior->log_density(x));
  }
  const TabulatedDensity noise_table =
      tabulate_noise(noise, count, noise_range, weights, misfits, noise_prior, options);

  for (const TabulatedDensity* table : {&location_table, &noise_table}) {
    const auto parameter = table == &location_table ? location : noise;
    require_tolerance(name_of(parameter), table->relative_error(), options.relative_tolerance);
  }
  require_tolerance(
      std::string("the integrals over ") + name_of(location) + " and " + name_of(noise) + " in either order",
      std::fabs(location_table.log_integral() - noise_table.log_integral()), options.relative_tolerance);

  if (noise_prior != nullptr) {
    return {minima.places.size(), location_table, noise_table, std::nullopt, *noise_prior};
  }
  // Between the nodes of a panel the density changes by a few nats, and the misfit by the same
  // number times 2 sigma^2.
  const auto [lowest, highest] = std::minmax_element(misfits.begin(), misfits.end());
  const NoiseConditional conditional(
      count, noise_range, std::max(0.0, *lowest - 12.0 * noise_range.lower * noise_range.lower), *highest);
  return {minima.places.size(), location_table, noise_table, conditional, {}};
}

double ExactPosterior::Pair::noise_quantile(std::size_t count, double misfit, double p) const {
  if (conditional) {
    return conditional->quantile(misfit, p);
  }
  const auto log_density = [&](double sigma) {
    return noise_prior.log_density(sigma) - static_cast<double>(count) * log(sigma) -
           0.5 * misfit / (sigma * sigma);
  };
  const Interval range = noise_prior.range();
  const Minima peaks = local_minima([&](double sigma) { return -log_density(sigma); }, range, 256, true);
  const auto drop = [&](double from, double to) { return log_density(from) - log_density(to); };
  const TabulatedDensity table(
      "noise level given the misfit", log_density,
      with_breaks(graded_mesh(range.lower, range.upper, peaks.places, peaks.separators, drop), &noise_prior));
  return table.quantile(p);
}

double ExactPosterior::log_evidence() const {
  constexpr double log_two_pi = 1.8378770664093453;
  const auto count = static_cast<double>(likelihood_.observation_count());
  return phase_.location.log_integral() + frequency_.location.log_integral() - count * log_two_pi +
         log_prior_density_;
}

double ExactPosterior::relative_error() const {
  double error = 0.0;
  for (const Pair* pair : {&phase_, &frequency_}) {
    error = std::max({error, pair->location.relative_error(), pair->noise.relative_error(),
                      std::fabs(pair->location.log_integral() - pair->noise.log_integral())});
  }
  return error;
}

const TabulatedDensity& ExactPosterior::marginal(friction::Parameter parameter) const {
  switch (parameter) {
    case friction::friction_force:
      return phase_.location;
    case friction::natural_frequency:
      return frequency_.location;
    case friction::phase_noise:
      return phase_.noise;
    case friction::frequency_ratio_noise:
      return frequency_.noise;
    case friction::parameter_count:
      break;
  }
  throw errors::InvalidValue("parameter", static_cast<int>(parameter), "one of the four parameters");
}

std::size_t ExactPosterior::mode_count(friction::Parameter location) const {
  if (location != friction::friction_force && location != friction::natural_frequency) {
    throw errors::InvalidValue("location", name_of(location), "friction_force or natural_frequency");
  }
  return location == friction::friction_force ? phase_.modes : frequency_.modes;
}

std::array<double, friction::parameter_count> ExactPosterior::draw(
    const std::array<double, friction::parameter_count>& uniforms) const {
  std::array<double, friction::parameter_count> point{};
  point[friction::friction_force] = phase_.location.quantile(uniforms[friction::friction_force]);
  point[friction::natural_frequency] = frequency_.location.quantile(uniforms[friction::natural_frequency]);
  point[friction::phase_noise] = phase_.noise_quantile(
      likelihood_.observation_count(), likelihood_.phase_misfit(point[friction::friction_force]),
      uniforms[friction::phase_noise]);
  point[friction::frequency_ratio_noise] = frequency_.noise_quantile(
      likelihood_.observation_count(), likelihood_.frequency_misfit(point[friction::natural_frequency]),
      uniforms[friction::frequency_ratio_noise]);
  return point;
}

}  // namespace estimation
