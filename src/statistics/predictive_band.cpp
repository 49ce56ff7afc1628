#include "statistics/predictive_band.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "errors/invalid_value.hpp"

namespace statistics {

namespace {

constexpr double normal_quantile_975 = 1.959963984540054;

using Policy = boost::math::policies::policy<boost::math::policies::promote_double<false>>;

/// The mean of normal distributions, one for each draw.
class Mixture {
 public:
  Mixture(std::span<const double> means, std::span<const double> deviations)
      : means_(means), deviations_(deviations) {}

  [[nodiscard]] double below(double y) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < means_.size(); ++i) {
      sum += 0.5 * boost::math::erfc((means_[i] - y) / deviations_[i] * std::sqrt(0.5), Policy());
    }
    return sum / static_cast<double>(means_.size());
  }

  /// \param score  the standard normal quantile of p
  [[nodiscard]] double quantile(double p, double score) const {
    double low = std::numeric_limits<double>::infinity(),
           high = -low;  // the quantiles of the draws enclose it
    for (std::size_t i = 0; i < means_.size(); ++i) {
      const double of_draw = means_[i] + score * deviations_[i];
      low = std::min(low, of_draw);
      high = std::max(high, of_draw);
    }
    const double excess_low = below(low) - p, excess_high = below(high) - p;
    if (!(excess_low < 0.0) || !(excess_high > 0.0)) {  // equal draws, up to rounding
      return excess_low < 0.0 ? high : low;
    }
    std::uintmax_t iterations = 200;
    const auto root = boost::math::tools::toms748_solve(
        [&](double y) { return below(y) - p; }, low, high, excess_low, excess_high,
        [&](double a, double b) { return b - a <= 1e-12 * std::max(high - low, std::fabs(a)); }, iterations);
    return 0.5 * (root.first + root.second);
  }

 private:
  std::span<const double> means_, deviations_;
};

void validate(std::span<const double> outputs, std::span<const double> noise, double observed) {
  if (outputs.empty()) {
    throw errors::InvalidValue("outputs", outputs.size(), "at least one draw of the posterior");
  }
  if (noise.size() != outputs.size()) {
    throw errors::InvalidValue("noise", noise.size(), "one standard deviation for each draw");
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (!std::isfinite(outputs[i])) {
      throw errors::InvalidValue("outputs", outputs[i], "finite numbers");
    }
    if (!(noise[i] > 0.0) || !std::isfinite(noise[i])) {
      throw errors::InvalidValue("noise", noise[i], "positive, finite numbers");
    }
  }
  if (!std::isfinite(observed)) {
    throw errors::InvalidValue("observed", observed, "a finite number");
  }
}

}  // namespace

PredictiveBand predictive_band(std::span<const double> outputs, std::span<const double> noise,
                               double observed) {
  validate(outputs, noise, observed);
  const auto n = static_cast<double>(outputs.size());
  std::vector<double> sorted(outputs.begin(), outputs.end());
  std::sort(sorted.begin(), sorted.end());
  double mean = 0.0, variance = 0.0;
  for (const double output : outputs) {
    mean += output / n;
  }
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    variance += ((outputs[i] - mean) * (outputs[i] - mean) + noise[i] * noise[i]) / n;
  }
  const Mixture measurement(outputs, noise);
  return {.median = sample_quantile(sorted, 0.5),
          .model = {sample_quantile(sorted, 0.025), sample_quantile(sorted, 0.975)},
          .measurement = {measurement.quantile(0.025, -normal_quantile_975),
                          measurement.quantile(0.975, normal_quantile_975)},
          .standard_deviation = std::sqrt(variance),
          .probability_below = measurement.below(observed)};
}

}  // namespace statistics
