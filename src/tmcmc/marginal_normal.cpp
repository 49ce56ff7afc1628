// Normal, truncated normal, half-normal and log-normal distributions.
#include "tmcmc/detail/marginal_family.hpp"

namespace tmcmc {

namespace {

using detail::infinity;
using detail::normal_cdf;
using portable_math::normal_quantile;

struct Normal;
struct LogNormal;
void scores_of(const Normal& family, const double* x, std::size_t n, double* scores);
void scores_of(const LogNormal& family, const double* x, std::size_t n, double* scores);

struct Normal final : detail::FamilyOf<Normal> {
  Normal(double m, double s) : mean(m), sd(s) {}
  [[nodiscard]] Support support() const override { return {}; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    const double z = (x - mean) / sd;
    return -0.5 * (z * z);
  }
  [[nodiscard]] double log_constant() const override {
    return -portable_math::log(sd) - detail::log_sqrt_two_pi;
  }
  [[nodiscard]] double cdf(double x) const override { return normal_cdf(normal_score(x)); }
  [[nodiscard]] double complement(double x) const override { return normal_cdf(-normal_score(x)); }
  [[nodiscard]] double quantile(double p) const override { return from_normal(normal_quantile(p)); }
  [[nodiscard]] double complement_quantile(double q) const override {
    return from_normal(-normal_quantile(q));
  }
  [[nodiscard]] double normal_score(double x) const override { return (x - mean) / sd; }
  void normal_scores(const double* x, std::size_t n, double* scores) const override {
    scores_of(*this, x, n, scores);
  }
  [[nodiscard]] double from_normal(double z) const override { return mean + sd * z; }

  double mean;
  double sd;
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const Normal& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

/// Where the interval lies to the right of the mean, everything is computed for -X, so that
/// differences are between small numbers.
struct TruncatedNormal final : detail::FamilyOf<TruncatedNormal> {
  TruncatedNormal(double m, double s, Support cut)
      : sign(cut.lower > m ? -1.0 : 1.0), mean(m), sd(s), interval(cut) {
    const double a = (cut.lower - m) / s;
    const double b = (cut.upper - m) / s;
    below = normal_cdf(sign > 0.0 ? a : -b);
    mass = normal_cdf(sign > 0.0 ? b : -a) - below;
  }
  [[nodiscard]] Support support() const override { return interval; }
  [[nodiscard]] bool portable() const override { return false; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    const double z = (x - mean) / sd;
    return x >= interval.lower && x <= interval.upper ? -0.5 * (z * z) : -infinity;
  }
  [[nodiscard]] double log_constant() const override {
    return -portable_math::log(sd) - detail::log_sqrt_two_pi - portable_math::log(mass);
  }
  [[nodiscard]] double cdf(double x) const override { return sign > 0.0 ? left(x) : right(x); }
  [[nodiscard]] double complement(double x) const override { return sign > 0.0 ? right(x) : left(x); }
  [[nodiscard]] double quantile(double p) const override { return sign > 0.0 ? from_left(p) : from_right(p); }
  [[nodiscard]] double complement_quantile(double q) const override {
    return sign > 0.0 ? from_right(q) : from_left(q);
  }

  double sign;
  double mean;
  double sd;
  Support interval;
  double below;
  double mass;

 private:
  [[nodiscard]] double left(double x) const {
    return std::clamp((normal_cdf(sign * (x - mean) / sd) - below) / mass, 0.0, 1.0);
  }
  [[nodiscard]] double right(double x) const {
    return std::clamp((below + mass - normal_cdf(sign * (x - mean) / sd)) / mass, 0.0, 1.0);
  }
  [[nodiscard]] double from_left(double p) const { return at(below + p * mass); }
  [[nodiscard]] double from_right(double q) const { return at(below + (1.0 - q) * mass); }
  [[nodiscard]] double at(double p) const {
    return std::clamp(mean + sign * sd * normal_quantile(p), interval.lower, interval.upper);
  }
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const TruncatedNormal& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

struct HalfNormal final : detail::FamilyOf<HalfNormal> {
  explicit HalfNormal(double s) : sd(s) {}
  [[nodiscard]] Support support() const override { return {0.0, infinity}; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    const double z = x / sd;
    return x >= 0.0 ? -0.5 * (z * z) : -infinity;
  }
  [[nodiscard]] double log_constant() const override {
    return portable_math::log(2.0) - portable_math::log(sd) - detail::log_sqrt_two_pi;
  }
  [[nodiscard]] double cdf(double x) const override {
    return boost::math::erf(x / sd * 0.70710678118654752440, detail::Policy());
  }
  [[nodiscard]] double complement(double x) const override { return 2.0 * normal_cdf(-x / sd); }
  [[nodiscard]] double quantile(double p) const override {
    return p <= 0.8 ? sd * portable_math::detail::central_normal_quantile(0.5 * p)
                    : complement_quantile(1.0 - p);
  }
  [[nodiscard]] double complement_quantile(double q) const override { return -sd * normal_quantile(0.5 * q); }

  double sd;
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const HalfNormal& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

struct LogNormal final : detail::FamilyOf<LogNormal> {
  LogNormal(double m, double s) : mu(m), sigma(s) {}
  [[nodiscard]] Support support() const override { return {0.0, infinity}; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    const double log_x = portable_math::log(x > 0.0 ? x : 1.0);
    const double z = (log_x - mu) / sigma;
    return x > 0.0 ? -log_x - 0.5 * (z * z) : -infinity;
  }
  [[nodiscard]] double log_constant() const override {
    return -portable_math::log(sigma) - detail::log_sqrt_two_pi;
  }
  [[nodiscard]] double cdf(double x) const override { return normal_cdf(normal_score(x)); }
  [[nodiscard]] double complement(double x) const override { return normal_cdf(-normal_score(x)); }
  [[nodiscard]] double quantile(double p) const override { return from_normal(normal_quantile(p)); }
  [[nodiscard]] double complement_quantile(double q) const override {
    return from_normal(-normal_quantile(q));
  }
  [[nodiscard]] double normal_score(double x) const override { return (portable_math::log(x) - mu) / sigma; }
  void normal_scores(const double* x, std::size_t n, double* scores) const override {
    scores_of(*this, x, n, scores);
  }
  [[nodiscard]] double from_normal(double z) const override { return portable_math::exp(mu + sigma * z); }

  double mu;
  double sigma;
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const LogNormal& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

PORTABLE_MATH_MULTIVERSION
void scores_of(const Normal& family, const double* x, std::size_t n, double* scores) {
  const double mean = family.mean;
  const double sd = family.sd;
  for (std::size_t i = 0; i < n; ++i) {
    scores[i] = (x[i] - mean) / sd;
  }
}

PORTABLE_MATH_MULTIVERSION
void scores_of(const LogNormal& family, const double* x, std::size_t n, double* scores) {
  const double mu = family.mu;
  const double sigma = family.sigma;
  for (std::size_t i = 0; i < n; ++i) {
    scores[i] = (portable_math::log(x[i]) - mu) / sigma;
  }
}

/// sigma of the log-normal distribution with this coefficient of variation.
double sigma_of(double cov) {
  return std::sqrt(cov < 1e-4 ? cov * cov : portable_math::log(1.0 + cov * cov));
}

}  // namespace

Marginal Marginal::normal(double mean, double sd) {
  return {"normal",
          {mean, sd},
          std::make_shared<Normal>(detail::finite("mean", mean), detail::positive("sd", sd))};
}

Marginal Marginal::truncated_normal(double mean, double sd, double lower, double upper) {
  detail::finite("mean", mean);
  detail::positive("sd", sd);
  if (!(lower < infinity)) {
    throw errors::InvalidValue("lower", lower, "a number, or minus infinity");
  }
  if (!(std::nextafter(lower, upper) < upper)) {
    throw errors::InvalidValue("upper", upper, "a number above lower, or infinity");
  }
  auto family = std::make_shared<TruncatedNormal>(mean, sd, Support{lower, upper});
  if (!(family->mass > 1e-290)) {
    throw errors::InvalidValue(lower > mean ? "lower" : "upper", lower > mean ? lower : upper,
                               "an interval that is less than some 36 standard deviations away from the "
                               "mean, with probability in it");
  }
  return {"truncated_normal", {mean, sd, lower, upper}, std::move(family)};
}

Marginal Marginal::half_normal(double sd) {
  return {"half_normal", {sd}, std::make_shared<HalfNormal>(detail::positive("sd", sd))};
}

Marginal Marginal::log_normal(double mu, double sigma) {
  return {"log_normal",
          {mu, sigma},
          std::make_shared<LogNormal>(detail::finite("mu", mu), detail::positive("sigma", sigma))};
}

Marginal Marginal::log_normal_of_mean(double mean, double sd) {
  const double sigma = sigma_of(detail::positive("sd", sd) / detail::positive("mean", mean));
  return log_normal(portable_math::log(mean) - 0.5 * sigma * sigma, sigma);
}

Marginal Marginal::log_normal_of_median(double median, double cov) {
  return log_normal(portable_math::log(detail::positive("median", median)),
                    sigma_of(detail::positive("cov", cov)));
}

}  // namespace tmcmc
