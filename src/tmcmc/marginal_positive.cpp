// Exponential, gamma, inverse gamma and Weibull distributions.
#include "tmcmc/detail/marginal_family.hpp"

namespace tmcmc {

namespace {

using detail::infinity;
using GammaDistribution = boost::math::gamma_distribution<double, detail::Policy>;

double log_gamma(double x) {
  return boost::math::lgamma(x, detail::Policy());
}

/// Weibull distribution; the exponential distribution has shape 1.
struct Weibull final : detail::FamilyOf<Weibull> {
  Weibull(double k, double s) : shape(k), scale(s) {}
  [[nodiscard]] Support support() const override { return {0.0, infinity}; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    if (shape == 1.0) {  // exponential
      return x >= 0.0 ? -(x / scale) : -infinity;
    }
    const double log_ratio = portable_math::log(x > 0.0 ? x / scale : 1.0);
    return x > 0.0 ? (shape - 1.0) * log_ratio - portable_math::exp(shape * log_ratio) : -infinity;
  }
  [[nodiscard]] double log_constant() const override { return portable_math::log(shape / scale); }
  [[nodiscard]] double cdf(double x) const override { return -std::expm1(-hazard(x)); }
  [[nodiscard]] double complement(double x) const override { return portable_math::exp(-hazard(x)); }
  [[nodiscard]] double quantile(double p) const override { return at(detail::minus_log_complement(p)); }
  [[nodiscard]] double complement_quantile(double q) const override { return at(-portable_math::log(q)); }

  double shape;
  double scale;

 private:
  [[nodiscard]] double hazard(double x) const {
    return shape == 1.0 ? x / scale : portable_math::exp(shape * portable_math::log(x / scale));
  }
  [[nodiscard]] double at(double h) const {
    return scale * (shape == 1.0 ? h : portable_math::exp(portable_math::log(h) / shape));
  }
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const Weibull& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

struct Gamma final : detail::FamilyOf<Gamma> {
  Gamma(double k, double r) : shape(k), rate(r), functions(GammaDistribution(k), 0.0, 1.0 / r) {}
  [[nodiscard]] Support support() const override { return {0.0, infinity}; }
  [[nodiscard]] bool portable() const override { return false; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    return x > 0.0 ? (shape - 1.0) * portable_math::log(x) - rate * x : -infinity;
  }
  [[nodiscard]] double log_constant() const override {
    return shape * portable_math::log(rate) - log_gamma(shape);
  }
  [[nodiscard]] double cdf(double x) const override { return functions.cdf(x); }
  [[nodiscard]] double complement(double x) const override { return functions.complement(x); }
  [[nodiscard]] double quantile(double p) const override { return functions.quantile(p); }
  [[nodiscard]] double complement_quantile(double q) const override {
    return functions.complement_quantile(q);
  }

  double shape;
  double rate;
  detail::BoostFunctions<GammaDistribution> functions;
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const Gamma& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

struct InverseGamma final : detail::FamilyOf<InverseGamma> {
  InverseGamma(double k, double s) : shape(k), scale(s), functions(GammaDistribution(k), 0.0, 1.0 / s) {}
  [[nodiscard]] Support support() const override { return {0.0, infinity}; }
  [[nodiscard]] bool portable() const override { return false; }
  [[nodiscard]] bool has_variance() const override { return shape > 2.0; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    return x > 0.0 ? -(shape + 1.0) * portable_math::log(x) - scale / x : -infinity;
  }
  [[nodiscard]] double log_constant() const override {
    return shape * portable_math::log(scale) - log_gamma(shape);
  }
  [[nodiscard]] double cdf(double x) const override { return functions.complement(1.0 / x); }
  [[nodiscard]] double complement(double x) const override { return functions.cdf(1.0 / x); }
  [[nodiscard]] double quantile(double p) const override { return 1.0 / functions.complement_quantile(p); }
  [[nodiscard]] double complement_quantile(double q) const override { return 1.0 / functions.quantile(q); }

  double shape;
  double scale;
  detail::BoostFunctions<GammaDistribution> functions;
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const InverseGamma& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

}  // namespace

Marginal Marginal::exponential(double rate) {
  return {"exponential", {rate}, std::make_shared<Weibull>(1.0, 1.0 / detail::positive("rate", rate))};
}

Marginal Marginal::weibull(double shape, double scale) {
  return {"weibull",
          {shape, scale},
          std::make_shared<Weibull>(detail::positive("shape", shape), detail::positive("scale", scale))};
}

Marginal Marginal::gamma(double shape, double rate) {
  return {"gamma",
          {shape, rate},
          std::make_shared<Gamma>(detail::positive("shape", shape), detail::positive("rate", rate))};
}

Marginal Marginal::inverse_gamma(double shape, double scale) {
  return {"inverse_gamma",
          {shape, scale},
          std::make_shared<InverseGamma>(detail::positive("shape", shape), detail::positive("scale", scale))};
}

}  // namespace tmcmc
