/// \file
/// Interface that a distribution implements to be a Marginal, and checks of arguments.
#pragma once

#include <algorithm>
#include <boost/math/distributions/beta.hpp>
#include <boost/math/distributions/complement.hpp>
#include <boost/math/distributions/gamma.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/policies/policy.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "errors/invalid_value.hpp"
#include "portable_math/multiversion.hpp"
#include "portable_math/normal_quantile.hpp"
#include "tmcmc/detail/infinity.hpp"
#include "tmcmc/marginal.hpp"

namespace tmcmc::detail {

/// Policy of Boost.Math: doubles throughout, and limits instead of exceptions.
using Policy = boost::math::policies::policy<
    boost::math::policies::promote_double<false>,
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
    boost::math::policies::domain_error<boost::math::policies::ignore_error>,
    boost::math::policies::pole_error<boost::math::policies::ignore_error>,
    boost::math::policies::evaluation_error<boost::math::policies::ignore_error>>;

constexpr double log_sqrt_two_pi = 0.91893853320467274178;

/// Phi(z), with a small relative error where it is small.
inline double normal_cdf(double z) {
  return 0.5 * boost::math::erfc(-z * 0.70710678118654752440, Policy());
}

/// -log(1 - p), with a small relative error for small p (Kahan's correction of the rounding of 1 -
/// p).
inline double minus_log_complement(double p) {
  const double q = 1.0 - p;
  return q == 1.0 ? p : -portable_math::log(q) * (p / (1.0 - q));
}

/// The functions of a distribution with given arguments; Marginal documents them.
class MarginalFamily {
 public:
  virtual ~MarginalFamily() = default;

  [[nodiscard]] virtual Support support() const = 0;
  [[nodiscard]] virtual bool portable() const { return true; }
  [[nodiscard]] virtual bool has_variance() const { return true; }
  virtual void add_log_kernel(const double* x, std::size_t n, double* sum) const = 0;
  [[nodiscard]] virtual double log_constant() const = 0;
  /// x inside the support.
  [[nodiscard]] virtual double cdf(double x) const = 0;
  /// x inside the support.
  [[nodiscard]] virtual double complement(double x) const = 0;
  /// p in (0, 1).
  [[nodiscard]] virtual double quantile(double p) const = 0;
  /// x with P(X > x) = q.
  [[nodiscard]] virtual double complement_quantile(double q) const = 0;
  [[nodiscard]] virtual double normal_score(double x) const {
    const double p = cdf(x);
    return p <= 0.5 ? portable_math::normal_quantile(p) : -portable_math::normal_quantile(complement(x));
  }
  /// normal_score() of n points inside the support.
  virtual void normal_scores(const double* x, std::size_t n, double* scores) const {
    for (std::size_t i = 0; i < n; ++i) {
      scores[i] = normal_score(x[i]);
    }
  }
  [[nodiscard]] virtual double from_normal(double z) const {
    return z <= 0.0 ? quantile(normal_cdf(z)) : complement_quantile(normal_cdf(-z));
  }
};

/// A family implemented by a function add_kernel(derived, x, n, sum) next to it, which adds
/// Derived::log_kernel(x[i]) to each sum[i]. The function is a free function so that it can be
/// compiled for each instruction set.
template <class Derived>
class FamilyOf : public MarginalFamily {
 public:
  void add_log_kernel(const double* x, std::size_t n, double* sum) const final {
    add_kernel(static_cast<const Derived&>(*this), x, n, sum);
  }
};

/// The loop of add_kernel(), which is inlined into it; log_kernel() gives minus infinity outside
/// the support.
template <class Derived>
PORTABLE_MATH_INLINE void add_each(const Derived& family, const double* x, std::size_t n, double* sum) {
  const Derived self = family;  // a copy that nothing else points to stays in registers
  for (std::size_t i = 0; i < n; ++i) {
    sum[i] += self.log_kernel(x[i]);
  }
}

/// A distribution of Boost.Math, shifted by `location` and scaled by `scale`.
template <class Distribution>
class BoostFunctions {
 public:
  BoostFunctions(const Distribution& distribution, double location, double scale)
      : distribution_(distribution), location_(location), scale_(scale) {}
  [[nodiscard]] double cdf(double x) const { return boost::math::cdf(distribution_, standard(x)); }
  [[nodiscard]] double complement(double x) const {
    return boost::math::cdf(boost::math::complement(distribution_, standard(x)));
  }
  [[nodiscard]] double quantile(double p) const {
    return location_ + scale_ * boost::math::quantile(distribution_, p);
  }
  [[nodiscard]] double complement_quantile(double q) const {
    return location_ + scale_ * boost::math::quantile(boost::math::complement(distribution_, q));
  }

 private:
  [[nodiscard]] double standard(double x) const { return (x - location_) / scale_; }

  Distribution distribution_;
  double location_;
  double scale_;
};

/// Returns the argument if it is a finite number.
inline double finite(const char* name, double value) {
  if (!std::isfinite(value)) {
    throw errors::InvalidValue(name, value, "a finite number");
  }
  return value;
}

/// Returns the argument if it is finite and positive.
inline double positive(const char* name, double value) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw errors::InvalidValue(name, value, "a positive number");
  }
  return value;
}

/// Refuses an interval that contains no doubles, or whose length overflows.
inline void require_interval(double lower, double upper) {
  finite("lower", lower);
  if (!std::isfinite(upper - lower) || !(std::nextafter(lower, upper) < upper)) {
    throw errors::InvalidValue("upper", upper, "a finite number above lower, with others between them");
  }
}

}  // namespace tmcmc::detail
