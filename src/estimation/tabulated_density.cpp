#include "estimation/tabulated_density.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "errors/invalid_value.hpp"
#include "estimation/legendre_rule.hpp"
#include "portable_math/elementary.hpp"

namespace estimation {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest_fall_on_a_panel = 6.0;  // nats; degree 19 resolves e^(3 x) to 1e-15

const LegendreRule rule = make_legendre_rule();

double log_add(double a, double b) {
  const double high = std::max(a, b);
  return high == -infinity ? high
                           : high + portable_math::log(1.0 + portable_math::exp(std::min(a, b) - high));
}

}  // namespace

/// Splits intervals one after the other, from left to right.
struct TabulatedDensity::Refinement {
  TabulatedDensity& table;
  const std::function<double(double)>& log_density;
  const TabulationOptions& options;
  std::vector<Values> values{};
  int examined = 0;

  [[noreturn]] void fail(const std::string& why) const { throw IntegrationError(table.name_ + ": " + why); }

  double log_density_at(double x) const {
    const double value = log_density(x) - table.peak_;
    if (!(value < infinity)) {
      std::ostringstream message;
      message.precision(17);
      message << "the log-density is not a number or infinite at " << x;
      fail(message.str());
    }
    return value;
  }

  /// Small coefficients that no longer decay are rounding in the log-density; halving would not
  /// help.
  static bool is_rounding(const Panel& panel) {
    const auto& c = panel.density;
    const double last = std::fabs(c[19]) + std::fabs(c[18]) + std::fabs(c[17]);
    const double before = std::fabs(c[16]) + std::fabs(c[15]) + std::fabs(c[14]);
    return panel.error < 1e-6 && last > 0.5 * before;
  }

  void refine(double left, double right) {
    if (++examined > 4 * options.max_panels || static_cast<int>(table.panels_.size()) >= options.max_panels) {
      fail("the density could not be resolved with max_panels = " + std::to_string(options.max_panels) +
           " panels");
    }
    Panel panel{};
    panel.left = left;
    panel.right = right;
    const double half_width = 0.5 * (right - left);
    const double middle = left + half_width;
    Values scaled{};
    for (std::size_t i = 0; i < order; ++i) {
      scaled[i] = log_density_at(middle + half_width * rule.node[i]);
    }
    const double at_left = log_density_at(left);
    const double at_right = log_density_at(right);
    const auto [low, high] = std::minmax_element(scaled.begin(), scaled.end());
    panel.log_scale = std::max({*high, at_left, at_right});
    if (panel.log_scale <= -options.cutoff_nats) {
      return;
    }
    const double lowest = std::min({*low, at_left, at_right});
    const bool can_split = middle > left && middle < right;
    if (panel.log_scale - lowest > largest_fall_on_a_panel && can_split) {
      refine(left, middle);
      refine(middle, right);
      return;
    }
    for (double& value : scaled) {
      value = portable_math::exp(value - panel.log_scale);
    }
    for (std::size_t j = 0; j < order; ++j) {
      for (std::size_t i = 0; i < order; ++i) {
        panel.density[j] += rule.to_coefficient[j][i] * scaled[i];
      }
      const double share = panel.density[j] / (2.0 * static_cast<double>(j) + 1.0);
      panel.integral[j + 1] += share;
      panel.integral[j == 0 ? 0 : j - 1] += j == 0 ? share : -share;
    }
    panel.error =
        std::max({std::fabs(panel.density[order - 1]), std::fabs(panel.density[order - 2]),
                  std::fabs(evaluate(panel, -1.0).density - portable_math::exp(at_left - panel.log_scale)),
                  std::fabs(evaluate(panel, 1.0).density - portable_math::exp(at_right - panel.log_scale))});
    if (panel.error > options.target && can_split && !is_rounding(panel)) {
      refine(left, middle);
      refine(middle, right);
      return;
    }
    panel.log_ratio = at_right - at_left;
    panel.total = evaluate(panel, 1.0).integral;
    table.panels_.push_back(panel);
    values.push_back(scaled);
  }
};

TabulatedDensity::TabulatedDensity(std::string name, const std::function<double(double)>& log_density,
                                   const std::vector<double>& mesh, const TabulationOptions& options)
    : name_(std::move(name)), peak_(-infinity) {
  for (const double x : mesh) {
    peak_ = std::max(peak_, log_density(x));
  }
  Refinement refinement{*this, log_density, options};
  if (mesh.size() < 2 || !(std::fabs(peak_) < infinity)) {
    refinement.fail("the density is not positive and finite at any breakpoint");
  }
  for (std::size_t i = 1; i < mesh.size(); ++i) {
    refinement.refine(mesh[i - 1], mesh[i]);
  }
  finish(refinement.values);
}

void TabulatedDensity::finish(const std::vector<Values>& values) {
  const std::size_t count = panels_.size();
  std::vector<double> masses;
  double error = 0.0;
  double total = 0.0;
  double first_moment = 0.0;
  const double reference = panels_[count / 2].left;
  log_below_.assign(count + 1, -infinity);
  log_above_.assign(count + 1, -infinity);
  for (std::size_t i = 0; i < count; ++i) {
    const Panel& panel = panels_[i];
    const double half_width = 0.5 * (panel.right - panel.left);
    const double scale = half_width * portable_math::exp(panel.log_scale);
    error += 2.0 * scale * panel.error;
    for (std::size_t j = 0; j < order; ++j) {
      nodes_.push_back(panel.left + half_width + half_width * rule.node[j]);
      weights_.push_back(half_width * rule.weight[j]);
      masses.push_back(scale * rule.weight[j] * values[i][j]);
      total += masses.back();
      first_moment += masses.back() * (nodes_.back() - reference);
    }
    log_below_[i + 1] =
        log_add(log_below_[i], panel.log_scale + portable_math::log(half_width * panel.total));
  }
  for (std::size_t i = count; i-- > 0;) {
    const Panel& panel = panels_[i];
    const double mass = 0.5 * (panel.right - panel.left) * panel.total;
    log_above_[i] = log_add(log_above_[i + 1], panel.log_scale + portable_math::log(mass));
  }
  log_total_ = log_below_[count];
  relative_error_ = error / total;
  mean_ = reference + first_moment / total;
  double second_moment = 0.0;
  for (std::size_t k = 0; k < masses.size(); ++k) {
    second_moment += masses[k] * (nodes_[k] - mean_) * (nodes_[k] - mean_);
  }
  standard_deviation_ = std::sqrt(second_moment / total);
}

TabulatedDensity::Local TabulatedDensity::evaluate(const Panel& panel, double xi) {
  Local sum{0.0, 0.0};
  double previous = 0.0;
  double legendre = 1.0;
  for (std::size_t j = 0; j <= order; ++j) {
    sum.density += panel.density[j] * legendre;
    sum.integral += panel.integral[j] * legendre;
    const double next = (rule.up[j] * xi) * legendre - rule.down[j] * previous;
    previous = legendre;
    legendre = next;
  }
  return sum;
}

double TabulatedDensity::invert(const Panel& panel, double integral) {
  double low = -1.0;
  double high = 1.0;
  const double fraction = std::clamp(integral / panel.total, 0.0, 1.0);
  // Start as if the density were exponential.
  const double growth = portable_math::exp(panel.log_ratio) - 1.0;
  double xi = std::fabs(panel.log_ratio) < 1e-3
                  ? 2.0 * fraction - 1.0
                  : 2.0 * portable_math::log(1.0 + growth * fraction) / panel.log_ratio - 1.0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    xi = xi >= low && xi <= high ? xi : 0.5 * (low + high);
    const Local at = evaluate(panel, xi);
    (at.integral < integral ? low : high) = xi;
    const double step = (integral - at.integral) / at.density;
    // Newton's error after this step is about its square.
    if (std::fabs(step) <= 1e-8 || high - low <= 1e-15) {
      return std::clamp(xi + step, -1.0, 1.0);
    }
    xi += step;
  }
  return xi;
}

std::size_t TabulatedDensity::first_panel_ending_after(double x) const {
  const auto found = std::upper_bound(panels_.begin(), panels_.end(), x,
                                      [](double value, const Panel& panel) { return value < panel.right; });
  return static_cast<std::size_t>(found - panels_.begin());
}

double TabulatedDensity::density(double x) const {
  const std::size_t i = std::min(first_panel_ending_after(x), panels_.size() - 1);
  const Panel& panel = panels_[i];
  if (!(x >= panel.left && x <= panel.right)) {
    return 0.0;
  }
  const double half_width = 0.5 * (panel.right - panel.left);
  const Local at = evaluate(panel, (x - panel.left) / half_width - 1.0);
  return std::max(at.density, 0.0) * portable_math::exp(panel.log_scale - log_total_);
}

double TabulatedDensity::log_cdf(double x) const {
  const std::size_t i = first_panel_ending_after(x);
  if (i == panels_.size() || x <= panels_[i].left) {
    return log_below_[i] - log_total_;
  }
  const double half_width = 0.5 * (panels_[i].right - panels_[i].left);
  const Local at = evaluate(panels_[i], (x - panels_[i].left) / half_width - 1.0);
  const double mass = half_width * std::max(at.integral, 0.0);
  return log_add(log_below_[i], panels_[i].log_scale + portable_math::log(mass)) - log_total_;
}

double TabulatedDensity::log_exceedance(double x) const {
  const std::size_t i = first_panel_ending_after(x);
  if (i == panels_.size() || x <= panels_[i].left) {
    return log_above_[i] - log_total_;
  }
  const double half_width = 0.5 * (panels_[i].right - panels_[i].left);
  const Local at = evaluate(panels_[i], (x - panels_[i].left) / half_width - 1.0);
  const double mass = half_width * std::max(panels_[i].total - at.integral, 0.0);
  return log_add(log_above_[i + 1], panels_[i].log_scale + portable_math::log(mass)) - log_total_;
}

double TabulatedDensity::cdf(double x) const {
  return std::min(1.0, portable_math::exp(log_cdf(x)));
}

double TabulatedDensity::exceedance(double x) const {
  return std::min(1.0, portable_math::exp(log_exceedance(x)));
}

double TabulatedDensity::quantile_of_log_cdf(double log_p) const {
  const double log_mass = log_p + log_total_;
  const auto found = std::lower_bound(log_below_.begin() + 1, log_below_.end(), log_mass);
  const std::size_t i = std::min(static_cast<std::size_t>(found - log_below_.begin()), panels_.size()) - 1;
  const Panel& panel = panels_[i];
  const double half_width = 0.5 * (panel.right - panel.left);
  const double mass =
      portable_math::exp(log_mass - panel.log_scale) - portable_math::exp(log_below_[i] - panel.log_scale);
  return panel.left + half_width * (1.0 + invert(panel, mass / half_width));
}

double TabulatedDensity::quantile_of_log_exceedance(double log_q) const {
  const double log_mass = log_q + log_total_;
  const auto found = std::lower_bound(log_above_.begin(), log_above_.end() - 1, log_mass, std::greater<>());
  const std::size_t i =
      std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(found - log_above_.begin(), 1)),
               panels_.size()) -
      1;
  const Panel& panel = panels_[i];
  const double half_width = 0.5 * (panel.right - panel.left);
  const double mass = portable_math::exp(log_mass - panel.log_scale) -
                      portable_math::exp(log_above_[i + 1] - panel.log_scale);
  return panel.left + half_width * (1.0 + invert(panel, panel.total - mass / half_width));
}

double TabulatedDensity::quantile(double p) const {
  if (!(p >= 0.0 && p <= 1.0)) {
    throw errors::InvalidValue("p of " + name_, p, "a number from 0 to 1");
  }
  return p < 0.5 ? quantile_of_log_cdf(portable_math::log(p))
                 : quantile_of_log_exceedance(portable_math::log(1.0 - p));
}

}  // namespace estimation
