/// \file
/// Prior distribution of one parameter.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tmcmc {

namespace detail {
class MarginalFamily;
}

/// The interval outside which a density is zero.
struct Support {
  /// Minus infinity if there is no lower bound.
  double lower = -std::numeric_limits<double>::infinity();
  /// Infinity if there is no upper bound.
  double upper = std::numeric_limits<double>::infinity();
};

/// A continuous distribution on the real line, as an immutable value: its name, its arguments and
/// its support. Each static function makes one distribution; distributions() lists them with the
/// names of their arguments, for files and messages.
///
/// The quantiles of the uniform, log-uniform, normal, half-normal, log-normal, exponential,
/// Weibull, Gumbel and triangular distributions are bit-identical on every machine (portable()).
/// The quantiles of the truncated normal, gamma, inverse gamma, beta and Student t distributions
/// come from Boost.Math, whose last bits depend on the C library: they agree to about 1e-14,
/// relative.
/// \throws errors::InvalidValue from each of the static functions, with the argument as field, if
///         the argument is not finite or not in the range that the function's comment states
///         (arguments named sd, rate, shape, scale or sigma must be positive).
class Marginal {
 public:
  /// Density 1 / (upper - lower) on [lower, upper]; lower < upper, with doubles between them.
  [[nodiscard]] static Marginal uniform(double lower, double upper);
  /// Density proportional to 1 / x on [lower, upper]; 0 < lower < upper.
  [[nodiscard]] static Marginal log_uniform(double lower, double upper);
  /// The normal distribution with this mean and standard deviation.
  [[nodiscard]] static Marginal normal(double mean, double sd);
  /// The normal distribution with parameters mean and sd, truncated to [lower, upper] and
  /// normalised there; either bound may be infinite.
  [[nodiscard]] static Marginal truncated_normal(double mean, double sd, double lower, double upper);
  /// |X| with X normal of mean zero and standard deviation sd.
  [[nodiscard]] static Marginal half_normal(double sd);
  /// exp(X) with X normal of mean mu and standard deviation sigma.
  [[nodiscard]] static Marginal log_normal(double mu, double sigma);
  /// The log-normal distribution that itself has this mean (positive) and standard deviation.
  [[nodiscard]] static Marginal log_normal_of_mean(double mean, double sd);
  /// The log-normal distribution with this median (positive) and coefficient of variation, sd /
  /// mean.
  [[nodiscard]] static Marginal log_normal_of_median(double median, double cov);
  /// Density rate exp(-rate x) for x >= 0.
  [[nodiscard]] static Marginal exponential(double rate);
  /// Density proportional to x^(shape - 1) exp(-rate x) for x > 0.
  [[nodiscard]] static Marginal gamma(double shape, double rate);
  /// 1 / X with X distributed as gamma(shape, rate = scale): density proportional to x^(-shape - 1)
  /// exp(-scale / x).
  [[nodiscard]] static Marginal inverse_gamma(double shape, double scale);
  /// Density proportional to (x - lower)^(alpha - 1) (upper - x)^(beta - 1) on (lower, upper);
  /// alpha and beta positive.
  [[nodiscard]] static Marginal beta(double alpha, double beta, double lower = 0.0, double upper = 1.0);
  /// P(X > x) = exp(-(x / scale)^shape) for x >= 0.
  [[nodiscard]] static Marginal weibull(double shape, double scale);
  /// The distribution of largest values: P(X <= x) = exp(-exp(-(x - location) / scale)).
  [[nodiscard]] static Marginal gumbel(double location, double scale);
  /// location + scale T with T of Student's t distribution; degrees_of_freedom positive.
  [[nodiscard]] static Marginal student_t(double degrees_of_freedom, double location, double scale);
  /// Density that rises linearly from lower to mode and falls to upper; lower <= mode <= upper,
  /// lower < upper.
  [[nodiscard]] static Marginal triangular(double lower, double mode, double upper);

  /// Name of the distribution, as in distributions().
  [[nodiscard]] std::string_view distribution() const { return name_; }
  /// The arguments of the static function, in its order.
  [[nodiscard]] const std::vector<double>& arguments() const { return arguments_; }
  /// Name and arguments, such as "normal(3, 0.5)"; digits that read back as the same doubles.
  [[nodiscard]] std::string text() const;

  /// The interval on which the density is positive.
  [[nodiscard]] const Support& support() const { return support_; }
  /// Whether draws are bit-identical on every machine.
  [[nodiscard]] bool portable() const;
  /// Whether the variance is finite.
  [[nodiscard]] bool has_variance() const;

  /// Logarithm of the normalised density; minus infinity outside the support.
  [[nodiscard]] double log_density(double x) const;
  /// P(X <= x).
  [[nodiscard]] double cdf(double x) const;
  /// P(X > x), exact up to rounding where it is small.
  [[nodiscard]] double complement(double x) const;
  /// x with P(X <= x) = p, p in [0, 1].
  [[nodiscard]] double quantile(double p) const;
  /// Phi^-1(F(x)), where F is the distribution function of the marginal and Phi that of the
  /// standard normal distribution.
  [[nodiscard]] double normal_score(double x) const;
  /// normal_score() of n points; infinite on a bound and NaN outside the support.
  void normal_scores(const double* x, std::size_t n, double* scores) const;
  /// F^-1(Phi(z)), the inverse of normal_score().
  [[nodiscard]] double from_normal(double z) const;

  /// sum[i] += log f(x[i]) - log_constant(), i < n: the part of the log-density that depends on x,
  /// bit-identical on every machine.
  void add_log_kernel(const double* x, std::size_t n, double* sum) const;
  /// The constant part of the log-density, which add_log_kernel() leaves out.
  [[nodiscard]] double log_constant() const;

 private:
  Marginal(std::string_view name, std::vector<double> arguments,
           std::shared_ptr<const detail::MarginalFamily> family);

  // a literal
  std::string_view name_;
  std::vector<double> arguments_;
  Support support_;
  std::shared_ptr<const detail::MarginalFamily> family_;
};

}  // namespace tmcmc
