// Uniform, log-uniform, beta and triangular distributions.
#include <utility>

#include "tmcmc/detail/marginal_family.hpp"

namespace tmcmc {

namespace {

using detail::infinity;
using BetaDistribution = boost::math::beta_distribution<double, detail::Policy>;

struct Uniform final : detail::FamilyOf<Uniform> {
  Uniform(double a, double b) : lower(a), upper(b) {}
  [[nodiscard]] Support support() const override { return {lower, upper}; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    return x >= lower && x <= upper ? 0.0 : -infinity;
  }
  [[nodiscard]] double log_constant() const override { return -portable_math::log(upper - lower); }
  [[nodiscard]] double cdf(double x) const override { return (x - lower) / (upper - lower); }
  [[nodiscard]] double complement(double x) const override { return (upper - x) / (upper - lower); }
  [[nodiscard]] double quantile(double p) const override { return lower + (upper - lower) * p; }
  [[nodiscard]] double complement_quantile(double q) const override { return upper - (upper - lower) * q; }

  double lower;
  double upper;
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const Uniform& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

struct LogUniform final : detail::FamilyOf<LogUniform> {
  LogUniform(double a, double b)
      : lower(a), upper(b), log_ratio(portable_math::log(b) - portable_math::log(a)) {}
  [[nodiscard]] Support support() const override { return {lower, upper}; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    return x >= lower && x <= upper ? -portable_math::log(x) : -infinity;
  }
  [[nodiscard]] double log_constant() const override { return -portable_math::log(log_ratio); }
  [[nodiscard]] double cdf(double x) const override { return portable_math::log(x / lower) / log_ratio; }
  [[nodiscard]] double complement(double x) const override {
    return portable_math::log(upper / x) / log_ratio;
  }
  [[nodiscard]] double quantile(double p) const override { return lower * portable_math::exp(log_ratio * p); }
  [[nodiscard]] double complement_quantile(double q) const override {
    return upper * portable_math::exp(-log_ratio * q);
  }

  double lower;
  double upper;
  double log_ratio;
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const LogUniform& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

struct Beta final : detail::FamilyOf<Beta> {
  Beta(double a, double b, double low, double high)
      : alpha(a), beta(b), lower(low), upper(high), functions(BetaDistribution(a, b), low, high - low) {}
  [[nodiscard]] Support support() const override { return {lower, upper}; }
  [[nodiscard]] bool portable() const override { return false; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    return x > lower && x < upper
               ? (alpha - 1.0) * portable_math::log(x - lower) + (beta - 1.0) * portable_math::log(upper - x)
               : -infinity;
  }
  [[nodiscard]] double log_constant() const override {
    using boost::math::lgamma;
    const detail::Policy policy;
    return lgamma(alpha + beta, policy) - lgamma(alpha, policy) - lgamma(beta, policy) -
           (alpha + beta - 1.0) * portable_math::log(upper - lower);
  }
  [[nodiscard]] double cdf(double x) const override { return functions.cdf(x); }
  [[nodiscard]] double complement(double x) const override { return functions.complement(x); }
  [[nodiscard]] double quantile(double p) const override { return functions.quantile(p); }
  [[nodiscard]] double complement_quantile(double q) const override {
    return functions.complement_quantile(q);
  }

  double alpha;
  double beta;
  double lower;
  double upper;
  detail::BoostFunctions<BetaDistribution> functions;
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const Beta& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

struct Triangular final : detail::FamilyOf<Triangular> {
  Triangular(double a, double m, double b) : lower(a), mode(m), upper(b) {}
  [[nodiscard]] Support support() const override { return {lower, upper}; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    const double below = (x - lower) / (mode - lower);
    const double above = (upper - x) / (upper - mode);
    const double height = x < mode ? below : (x > mode ? above : 1.0);
    return x >= lower && x <= upper ? portable_math::log(height) : -infinity;
  }
  [[nodiscard]] double log_constant() const override { return portable_math::log(2.0 / (upper - lower)); }
  [[nodiscard]] double cdf(double x) const override {
    return x <= mode && mode > lower ? left(x) : 1.0 - right(x);
  }
  [[nodiscard]] double complement(double x) const override {
    return x <= mode && mode > lower ? 1.0 - left(x) : right(x);
  }
  [[nodiscard]] double quantile(double p) const override {
    return p <= mass_left() ? lower + std::sqrt(p * (upper - lower) * (mode - lower)) : from_right(1.0 - p);
  }
  [[nodiscard]] double complement_quantile(double q) const override {
    return 1.0 - q <= mass_left() ? quantile(1.0 - q) : from_right(q);
  }

  double lower;
  double mode;
  double upper;

 private:
  [[nodiscard]] double mass_left() const { return (mode - lower) / (upper - lower); }
  [[nodiscard]] double left(double x) const {
    return (x - lower) / (upper - lower) * ((x - lower) / (mode - lower));
  }
  [[nodiscard]] double right(double x) const {
    return (upper - x) / (upper - lower) * ((upper - x) / (upper - mode));
  }
  [[nodiscard]] double from_right(double q) const {
    return upper - std::sqrt(q * (upper - lower) * (upper - mode));
  }
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const Triangular& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

}  // namespace

Marginal Marginal::uniform(double lower, double upper) {
  for (const auto& [name, bound] : {std::pair("lower", lower), std::pair("upper", upper)}) {
    if (!std::isfinite(bound)) {
      throw errors::InvalidValue(
          name, bound,
          "a finite number: a constant density without bounds has no finite integral, and "
          "without a normalised prior there is no evidence");
    }
  }
  detail::require_interval(lower, upper);
  return {"uniform", {lower, upper}, std::make_shared<Uniform>(lower, upper)};
}

Marginal Marginal::log_uniform(double lower, double upper) {
  if (!(lower > 0.0)) {
    throw errors::InvalidValue(
        "lower", lower,
        "a positive number: from 0 on the density 1/x has no finite integral, and without a "
        "normalised prior there is no evidence");
  }
  detail::require_interval(lower, upper);
  return {"log_uniform", {lower, upper}, std::make_shared<LogUniform>(lower, upper)};
}

Marginal Marginal::beta(double alpha, double beta, double lower, double upper) {
  detail::positive("alpha", alpha);
  detail::positive("beta", beta);
  detail::require_interval(lower, upper);
  return {"beta", {alpha, beta, lower, upper}, std::make_shared<Beta>(alpha, beta, lower, upper)};
}

Marginal Marginal::triangular(double lower, double mode, double upper) {
  detail::require_interval(lower, upper);
  if (!(mode >= lower && mode <= upper)) {
    throw errors::InvalidValue("mode", mode, "a number from lower to upper");
  }
  return {"triangular", {lower, mode, upper}, std::make_shared<Triangular>(lower, mode, upper)};
}

}  // namespace tmcmc
