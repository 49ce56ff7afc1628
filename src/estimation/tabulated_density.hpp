/// \file
/// A one-dimensional density that is costly to evaluate, represented by polynomials on panels:
/// distribution function, quantiles and moments at the cost of evaluating a polynomial.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "estimation/legendre_rule.hpp"

namespace estimation {

/// Thrown if a density could not be integrated to the requested tolerance.
class IntegrationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Accuracy and extent of the table.
struct TabulationOptions {
  /// A panel is split while the estimated error of its polynomial, relative to the largest density
  /// on the panel, exceeds this target. Where rounding in the log-density makes the target
  /// unattainable, the panel is kept with the error it has.
  double target = 1e-12;
  /// Panels on which the density is below e^-cutoff_nats of the largest density are left out.
  double cutoff_nats = 100.0;
  /// Largest number of panels; if more are needed, IntegrationError is thrown.
  int max_panels = 20000;
};

/// Normalised density on an interval, given by its logarithm up to a constant.
///
/// On every panel the density is interpolated at the 20 nodes of the Gauss-Legendre rule
/// (boost::math::quadrature::gauss) and integrated as a Legendre series. Panels are halved until
/// the interpolant agrees with the density at the ends of the panel and its last coefficients
/// vanish, both to TabulationOptions::target, so that tail probabilities have a small relative
/// error too. Masses are stored as logarithms. Const members may be called concurrently.
class TabulatedDensity {
 public:
  /// \param name  name of the variable, for messages
  /// \param log_density  natural logarithm; -inf is allowed, NaN is not
  /// \param mesh  ascending breakpoints, at least two; the mesh must resolve narrow modes
  ///        (graded_mesh)
  /// \throws IntegrationError if the density is 0 at every breakpoint, is NaN or +inf somewhere, or
  ///         needs more than max_panels panels.
  TabulatedDensity(std::string name, const std::function<double(double)>& log_density,
                   const std::vector<double>& mesh, const TabulationOptions& options = {});

  /// In 1/[x]; 0 outside the support.
  [[nodiscard]] double density(double x) const;
  /// P(X <= x).
  [[nodiscard]] double cdf(double x) const;
  /// P(X > x), not by subtraction from 1.
  [[nodiscard]] double exceedance(double x) const;
  /// The x with cdf(x) = p.
  /// \throws errors::InvalidValue unless 0 <= p <= 1.
  [[nodiscard]] double quantile(double p) const;
  /// Mean of the tabulated density.
  [[nodiscard]] double mean() const { return mean_; }
  /// Of that density.
  [[nodiscard]] double standard_deviation() const { return standard_deviation_; }

  /// Logarithm of cdf. This function and the three below work for log-probabilities far below -700.
  [[nodiscard]] double log_cdf(double x) const;
  /// log P(X > x).
  [[nodiscard]] double log_exceedance(double x) const;
  /// log_p <= 0.
  [[nodiscard]] double quantile_of_log_cdf(double log_p) const;
  /// log_q <= 0.
  [[nodiscard]] double quantile_of_log_exceedance(double log_q) const;

  /// Left end of the support, without the part below e^-cutoff_nats.
  [[nodiscard]] double lower() const { return panels_.front().left; }
  /// Right end of the last panel.
  [[nodiscard]] double upper() const { return panels_.back().right; }

  /// Logarithm of the integral of the density as given, before normalisation.
  [[nodiscard]] double log_integral() const { return peak_ + log_total_; }
  /// Estimated error of that integral and of any probability: the sum over the panels of
  /// interpolation error times width, as a fraction of the integral.
  [[nodiscard]] double relative_error() const { return relative_error_; }
  /// Panels kept.
  [[nodiscard]] std::size_t panel_count() const { return panels_.size(); }

  /// Nodes and weights of the composite Gauss rule on the panels, for other integrals over the same
  /// variable.
  [[nodiscard]] const std::vector<double>& nodes() const { return nodes_; }
  /// One per node, in [x].
  [[nodiscard]] const std::vector<double>& weights() const { return weights_; }

 private:
  static constexpr std::size_t order = LegendreRule::order;
  using Values = std::array<double, order>;

  struct Panel {
    double left;
    double right;
    double log_scale;                        // log of the panel's largest density, relative to peak_
    double error;                            // error of the interpolant, relative to that largest density
    double log_ratio;                        // log-density at the right end minus that at the left end
    double total;                            // integral over [-1, 1] at this scale
    std::array<double, order + 1> density;   // Legendre coefficients; the last is 0
    std::array<double, order + 1> integral;  // Legendre coefficients of the integral from -1
  };
  struct Local {
    double density;
    double integral;
  };
  struct Refinement;

  void finish(const std::vector<Values>& values);
  [[nodiscard]] static Local evaluate(const Panel& panel, double xi);
  [[nodiscard]] static double invert(const Panel& panel, double integral);
  [[nodiscard]] std::size_t first_panel_ending_after(double x) const;

  std::string name_;
  // largest log-density at a breakpoint
  double peak_ = 0.0;
  std::vector<Panel> panels_;
  // mass left of each panel, relative to peak_; one entry more than panels
  std::vector<double> log_below_;
  // mass right of each panel
  std::vector<double> log_above_;
  std::vector<double> nodes_;
  std::vector<double> weights_;
  double log_total_ = 0.0;
  double relative_error_ = 0.0;
  double mean_ = 0.0;
  double standard_deviation_ = 0.0;
};

}  // namespace estimation
