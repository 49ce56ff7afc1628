#include "estimation/noise_conditional.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <functional>
#include <limits>

#include "estimation/graded_mesh.hpp"
#include "portable_math/elementary.hpp"

namespace estimation {

namespace {

using portable_math::exp;
using portable_math::log;

/// log of sigma^(1-n) exp(-S / (2 sigma^2)) in y = log(sigma), for which it is a density.
struct LogNoise {
  double power;  // n - 1
  double half_misfit;

  LogNoise(std::size_t count, double misfit)
      : power(static_cast<double>(count) - 1.0), half_misfit(0.5 * misfit) {}

  [[nodiscard]] double exponent(double y) const { return half_misfit * exp(-2.0 * y); }
  [[nodiscard]] double operator()(double y) const { return -power * y - exponent(y); }

  [[nodiscard]] double mode(double low, double high) const {
    if (power == 0.0) {
      return high;
    }
    return half_misfit > 0.0 ? std::clamp(0.5 * log(2.0 * half_misfit / power), low, high) : low;
  }
};

/// The place between mode and end at which f has fallen by nats below its value at the mode, or
/// end; f falls monotonically.
double fallen_by(double nats, double mode, double end, const std::function<double(double)>& f) {
  const double threshold = f(mode) - nats;
  if (f(end) >= threshold) {
    return end;
  }
  double inside = mode;
  double outside = end;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (f(middle) >= threshold ? inside : outside) = middle;
  }
  return outside;
}

/// Below this misfit exp(-S / (2 sigma^2)) equals 1 up to rounding on the whole interval.
double misfit_floor(const Interval& noise) {
  return 2e-18 * noise.lower * noise.lower;
}

}  // namespace

double log_noise_integral(std::size_t count, const Interval& noise, double misfit) {
  constexpr double negligible_nats = 45.0;
  const LogNoise f(count, misfit);
  const double low = log(noise.lower);
  const double high = log(noise.upper);
  const double mode = f.mode(low, high);
  const double peak = f(mode);
  double sum = 0.0;
  for (const double end : {low, high}) {
    const double direction = end < mode ? -1.0 : 1.0;
    const double widest = end < mode ? 1.0 : 2.0;
    double y = mode;
    while ((end - y) * direction > 0.0 && peak - f(y) < negligible_nats) {
      const double exponent = f.exponent(y);
      const double slope = std::fabs(2.0 * exponent - f.power);
      const double width = std::min(widest, 4.0 / (slope + 2.0 * std::sqrt(exponent) + 1e-300));
      const double next = (end - y) * direction <= width ? end : y + direction * width;
      if (std::fabs(next - y) <
          1e-13 * std::fabs(y)) {  // an exponential edge narrower than the grid of doubles
        sum += 1.0 / slope;
        break;
      }
      sum +=
          std::fabs(next - y) * 0.5 * boost::math::quadrature::gauss<double, 20>::integrate([&](double xi) {
            return exp(f(0.5 * (y + next) + 0.5 * (next - y) * xi) - peak);
          });
      y = next;
    }
  }
  return peak + log(sum);
}

double smallest_noise(std::size_t count, const Interval& noise, double misfit, double nats) {
  const LogNoise f(count, misfit);
  const double low = log(noise.lower);
  return std::max(noise.lower, exp(fallen_by(nats, f.mode(low, log(noise.upper)), low, f)));
}

NoiseConditional::NoiseConditional(std::size_t count, const Interval& noise, double smallest_misfit,
                                   double largest_misfit)
    : noise_(noise), table_(make_table(count, noise, smallest_misfit, largest_misfit)) {}

TabulatedDensity NoiseConditional::make_table(std::size_t count, const Interval& noise,
                                              double smallest_misfit, double largest_misfit) {
  constexpr double needed_nats = 100.0;
  const double power = 0.5 * (static_cast<double>(count) - 1.0);
  const auto log_density = [power](double y) { return power * y - exp(y); };
  const double floor = misfit_floor(noise);
  const auto range = [&](double misfit) {
    const double s = 0.5 * std::max(misfit, floor);
    const double low = log(s / (noise.upper * noise.upper));
    const double high = log(s / (noise.lower * noise.lower));
    const double mode = power > 0.0 ? std::clamp(log(power), low, high) : low;
    return Interval{fallen_by(needed_nats, mode, low, log_density),
                    fallen_by(needed_nats, mode, high, log_density)};
  };
  const double lower = range(smallest_misfit).lower;
  const double upper = range(largest_misfit).upper;
  const double mode = power > 0.0 ? std::clamp(log(power), lower, upper) : lower;
  TabulationOptions options;
  options.cutoff_nats = std::numeric_limits<double>::infinity();
  const auto drop = [&](double from, double to) { return log_density(from) - log_density(to); };
  return {"noise level given the misfit", log_density, graded_mesh(lower, upper, {mode}, {}, drop), options};
}

double NoiseConditional::quantile(double misfit, double p) const {
  const double s = 0.5 * std::max(misfit, misfit_floor(noise_));
  const double low = log(s / (noise_.upper * noise_.upper));
  const double high = log(s / (noise_.lower * noise_.lower));
  // sigma grows as y = log(t) falls; the smaller of the two tails is used, since it keeps its
  // digits.
  const double above_low = table_.log_exceedance(low);
  const double below_high = table_.log_cdf(high);
  double y = 0.0;
  if (above_low < below_high) {
    const double rest = exp(table_.log_exceedance(high) - above_low);
    y = table_.quantile_of_log_exceedance(above_low + log(rest + p * (1.0 - rest)));
  } else {
    const double rest = exp(table_.log_cdf(low) - below_high);
    y = table_.quantile_of_log_cdf(below_high + log(rest + (1.0 - p) * (1.0 - rest)));
  }
  return std::clamp(std::sqrt(s) * exp(-0.5 * y), noise_.lower, noise_.upper);
}

}  // namespace estimation
