#include "estimation/parameter_prior.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>

#include "errors/invalid_value.hpp"
#include "portable_math/elementary.hpp"
#include "portable_math/sums.hpp"

namespace estimation {

namespace {

using portable_math::exp;
using portable_math::log;

}  // namespace

ParameterBounds ranges_of(const ParameterPriors& priors) {
  ParameterBounds bounds;
  for (std::size_t p = 0; p < priors.size(); ++p) {
    const auto& breaks = priors[p].breaks;
    if (breaks.size() < 2 ||
        std::adjacent_find(breaks.begin(), breaks.end(), std::greater_equal<>()) != breaks.end()) {
      throw errors::InvalidValue(std::string(name_of(static_cast<friction::Parameter>(p))) + ".breaks",
                                 breaks.size(), "two or more ascending numbers");
    }
    bounds[p] = priors[p].range();
  }
  validate(bounds);
  return bounds;
}

NoiseIntegral::NoiseIntegral(std::size_t count, const ParameterPrior& prior) {
  // In log(sigma) the likelihood is as wide as 1 / sqrt(2 (n - 1)) about its maximum, and falls as
  // sigma^(1-n) above it.
  const double n = static_cast<double>(count);
  const double widest = std::min(0.25, std::max(1.0 / std::sqrt(2.0 * n), 8.0 / n));
  using Rule = boost::math::quadrature::gauss<double, 20>;
  for (std::size_t b = 0; b + 1 < prior.breaks.size(); ++b) {
    const double low = log(prior.breaks[b]);
    const double high = log(prior.breaks[b + 1]);
    const auto panels = static_cast<std::size_t>(std::ceil((high - low) / widest));
    const double half = 0.5 * (high - low) / static_cast<double>(panels);
    for (std::size_t k = 0; k < panels; ++k) {
      const double middle = low + (2.0 * static_cast<double>(k) + 1.0) * half;
      for (std::size_t node = 0; node < Rule::abscissa().size(); ++node) {
        for (const double sign : {-1.0, 1.0}) {
          const double y = middle + sign * half * Rule::abscissa()[node];
          const double sigma = exp(y);
          log_terms_.push_back(log(half * Rule::weights()[node]) + prior.log_density(sigma) - (n - 1.0) * y);
          half_precision_.push_back(0.5 / (sigma * sigma));
        }
      }
    }
  }
}

double NoiseIntegral::operator()(double misfit) const {
  double peak = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < log_terms_.size(); ++k) {
    peak = std::max(peak, log_terms_[k] - misfit * half_precision_[k]);
  }
  if (!(peak > -std::numeric_limits<double>::infinity())) {
    return peak;
  }
  return peak + log(portable_math::sum_of(log_terms_.size(), [&](std::size_t k) {
           return exp(log_terms_[k] - misfit * half_precision_[k] - peak);
         }));
}

double NoiseIntegral::smallest_noise(double misfit, double nats) const {
  double peak = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < log_terms_.size(); ++k) {
    peak = std::max(peak, log_terms_[k] - misfit * half_precision_[k]);
  }
  double largest_precision = 0.0;
  for (std::size_t k = 0; k < log_terms_.size(); ++k) {
    if (log_terms_[k] - misfit * half_precision_[k] >= peak - nats) {
      largest_precision = std::max(largest_precision, half_precision_[k]);
    }
  }
  return std::sqrt(0.5 / largest_precision);
}

}  // namespace estimation
