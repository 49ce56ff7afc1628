// Gumbel and Student t distributions.
#include "tmcmc/detail/marginal_family.hpp"

namespace tmcmc {

namespace {

using StudentDistribution = boost::math::students_t_distribution<double, detail::Policy>;

struct Gumbel final : detail::FamilyOf<Gumbel> {
  Gumbel(double l, double s) : location(l), scale(s) {}
  [[nodiscard]] Support support() const override { return {}; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    const double z = (x - location) / scale;
    return -z - portable_math::exp(-z);
  }
  [[nodiscard]] double log_constant() const override { return -portable_math::log(scale); }
  [[nodiscard]] double cdf(double x) const override { return portable_math::exp(-exceedances(x)); }
  [[nodiscard]] double complement(double x) const override { return -std::expm1(-exceedances(x)); }
  [[nodiscard]] double quantile(double p) const override {
    return location - scale * portable_math::log(-portable_math::log(p));
  }
  [[nodiscard]] double complement_quantile(double q) const override {
    return location - scale * portable_math::log(detail::minus_log_complement(q));
  }

  double location;
  double scale;

 private:
  [[nodiscard]] double exceedances(double x) const { return portable_math::exp(-(x - location) / scale); }
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const Gumbel& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

struct StudentT final : detail::FamilyOf<StudentT> {
  StudentT(double nu, double l, double s)
      : degrees(nu), location(l), scale(s), functions(StudentDistribution(nu), l, s) {}
  [[nodiscard]] Support support() const override { return {}; }
  [[nodiscard]] bool portable() const override { return false; }
  [[nodiscard]] bool has_variance() const override { return degrees > 2.0; }
  [[nodiscard]] PORTABLE_MATH_INLINE double log_kernel(double x) const {
    const double z = (x - location) / scale;
    return -0.5 * (degrees + 1.0) * portable_math::log(1.0 + z * z / degrees);
  }
  [[nodiscard]] double log_constant() const override {
    using boost::math::lgamma;
    const detail::Policy policy;
    return lgamma(0.5 * (degrees + 1.0), policy) - lgamma(0.5 * degrees, policy) -
           0.5 * portable_math::log(degrees * 3.14159265358979323846) - portable_math::log(scale);
  }
  [[nodiscard]] double cdf(double x) const override { return functions.cdf(x); }
  [[nodiscard]] double complement(double x) const override { return functions.complement(x); }
  [[nodiscard]] double quantile(double p) const override { return functions.quantile(p); }
  [[nodiscard]] double complement_quantile(double q) const override {
    return functions.complement_quantile(q);
  }

  double degrees;
  double location;
  double scale;
  detail::BoostFunctions<StudentDistribution> functions;
};

PORTABLE_MATH_MULTIVERSION
void add_kernel(const StudentT& family, const double* x, std::size_t n, double* sum) {
  detail::add_each(family, x, n, sum);
}

}  // namespace

Marginal Marginal::gumbel(double location, double scale) {
  return {"gumbel",
          {location, scale},
          std::make_shared<Gumbel>(detail::finite("location", location), detail::positive("scale", scale))};
}

Marginal Marginal::student_t(double degrees_of_freedom, double location, double scale) {
  return {"student_t",
          {degrees_of_freedom, location, scale},
          std::make_shared<StudentT>(detail::positive("degrees_of_freedom", degrees_of_freedom),
                                     detail::finite("location", location), detail::positive("scale", scale))};
}

}  // namespace tmcmc
