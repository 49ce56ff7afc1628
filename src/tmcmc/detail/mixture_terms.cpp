#include "tmcmc/detail/mixture_terms.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "portable_math/elementary.hpp"
#include "portable_math/multiversion.hpp"

namespace tmcmc::detail {

namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();
constexpr int usual_degrees_of_freedom = 8;

/// log Gamma(twice / 2), by the recurrence from Gamma(1) = 1 or Gamma(1/2) = sqrt(pi).
double log_gamma_of_half(Index twice) {
  double value = twice % 2 == 0 ? 0.0 : 0.5 * portable_math::log(std::numbers::pi);
  for (Index k = twice % 2 == 0 ? 2 : 1; k < twice; k += 2) {
    value += portable_math::log(0.5 * static_cast<double>(k));
  }
  return value;
}

/// The components, with the constants of their densities.
std::vector<Component> components_of(const StudentMixture& mixture) {
  const Index d = mixture.dimension();
  const Index nu = mixture.degrees_of_freedom;
  const double common =
      log_gamma_of_half(nu + d) - log_gamma_of_half(nu) -
      0.5 * static_cast<double>(d) * portable_math::log(static_cast<double>(nu) * std::numbers::pi);
  std::vector<Component> components;
  for (Index k = 0; k < mixture.size(); ++k) {
    const Eigen::MatrixXd& factor = mixture.factors[static_cast<std::size_t>(k)];
    double constant = common + portable_math::log(mixture.weights[k]);
    for (Index j = 0; j < d; ++j) {
      constant -= portable_math::log(factor(j, j));
    }
    components.push_back({mixture.means.col(k).data(), factor.data(), constant});
  }
  return components;
}

/// base^exponent by repeated squaring.
template <int exponent>
PORTABLE_MATH_INLINE double power(double base) {
  if constexpr (exponent == 1) {
    return base;
  } else {
    const double half = power<exponent / 2>(base);
    return exponent % 2 == 0 ? half * half : half * half * base;
  }
}

/// term = factor (1 + distance / 8)^(-(8 + d) / 2) for so few coordinates that those of a point stay in registers, with
/// distance = |L^-1 (z - m)|^2 by forward substitution; sum += term.
template <int d>
PORTABLE_MATH_INLINE void terms_of_few(const double* __restrict points, Index stride, Index rows,
                                       const Component& component, double factor,
                                       double* __restrict distances, double* __restrict terms,
                                       double* __restrict sum) {
  const double* mean = component.mean;
  const double* lower = component.factor;
  double inverse[d];
  for (int j = 0; j < d; ++j) {
    inverse[j] = 1.0 / lower[j + j * d];
  }
  for (Index i = 0; i < rows; ++i) {
    double white[d];
    double distance = 0.0;
#pragma GCC unroll 8
    for (int j = 0; j < d; ++j) {
      double y = points[i + j * stride] - mean[j];
#pragma GCC unroll 8
      for (int l = 0; l < j; ++l) {
        y -= lower[j + l * d] * white[l];
      }
      white[j] = y * inverse[j];
      distance += white[j] * white[j];
    }
    distances[i] = distance;
    const double base = 1.0 / (1.0 + distance * (1.0 / usual_degrees_of_freedom));
    const double term =
        (d % 2 == 0 ? factor : factor * std::sqrt(base)) * power<(usual_degrees_of_freedom + d) / 2>(base);
    terms[i] = term;
    sum[i] += term;
  }
}

/// distances = |L^-1 (z - m)|^2 for any number of coordinates.
/// \param white  work space, d x mixture_rows
PORTABLE_MATH_MULTIVERSION
void squared_distances(const double* points, Index stride, Index rows, Index d, const double* mean,
                       const double* factor, double* white, double* distances) {
  for (Index i = 0; i < rows; ++i) {
    distances[i] = 0.0;
  }
  for (Index j = 0; j < d; ++j) {
    double* y = white + j * mixture_rows;
    const double* z = points + j * stride;
    const double centre = mean[j];
    for (Index i = 0; i < rows; ++i) {
      y[i] = z[i] - centre;
    }
    for (Index l = 0; l < j; ++l) {
      const double entry = factor[j + l * d];
      const double* before = white + l * mixture_rows;
      for (Index i = 0; i < rows; ++i) {
        y[i] -= entry * before[i];
      }
    }
    const double inverse = 1.0 / factor[j + j * d];
    for (Index i = 0; i < rows; ++i) {
      y[i] *= inverse;
      distances[i] += y[i] * y[i];
    }
  }
}

/// term = factor (1 + distance / nu)^(-twice_exponent / 2), by repeated squaring; sum += term.
PORTABLE_MATH_MULTIVERSION
void add_powers(Index rows, double factor, double inverse_nu, Index twice_exponent, const double* distances,
                double* term, double* sum) {
  double square[mixture_rows];
  for (Index i = 0; i < rows; ++i) {
    square[i] = 1.0 / (1.0 + distances[i] * inverse_nu);
  }
  for (Index i = 0; i < rows; ++i) {
    term[i] = twice_exponent % 2 == 0 ? factor : factor * std::sqrt(square[i]);
  }
  for (Index exponent = twice_exponent / 2;;) {
    if (exponent % 2 != 0) {
      for (Index i = 0; i < rows; ++i) {
        term[i] *= square[i];
      }
    }
    exponent /= 2;
    if (exponent == 0) {
      break;
    }
    for (Index i = 0; i < rows; ++i) {
      square[i] *= square[i];
    }
  }
  for (Index i = 0; i < rows; ++i) {
    sum[i] += term[i];
  }
}

/// \return  false where there is no version for so few coordinates and the usual degrees of freedom
PORTABLE_MATH_MULTIVERSION
bool are_terms_of_few(Index d, const double* points, Index stride, Index rows, const Component& component,
                      double factor, double* distances, double* terms, double* sum) {
  switch (d) {
    case 1:
      terms_of_few<1>(points, stride, rows, component, factor, distances, terms, sum);
      return true;
    case 2:
      terms_of_few<2>(points, stride, rows, component, factor, distances, terms, sum);
      return true;
    case 3:
      terms_of_few<3>(points, stride, rows, component, factor, distances, terms, sum);
      return true;
    case 4:
      terms_of_few<4>(points, stride, rows, component, factor, distances, terms, sum);
      return true;
    case 5:
      terms_of_few<5>(points, stride, rows, component, factor, distances, terms, sum);
      return true;
    case 6:
      terms_of_few<6>(points, stride, rows, component, factor, distances, terms, sum);
      return true;
    default:
      return false;
  }
}

/// Whether all are, none of them NaN.
PORTABLE_MATH_MULTIVERSION
bool are_above(Index rows, double bound, const double* x) {
  int count = 0;
  for (Index i = 0; i < rows; ++i) {
    count += x[i] > bound ? 1 : 0;
  }
  return count == rows;
}

}  // namespace

MixtureTerms::MixtureTerms(const StudentMixture& mixture)
    : components_(components_of(mixture)),
      d_(mixture.dimension()),
      degrees_of_freedom_(mixture.degrees_of_freedom),
      white_(mixture_rows, d_),
      distances_(mixture_rows, mixture.size()),
      terms_(mixture_rows, mixture.size()),
      sum_(mixture_rows),
      log_scale_(mixture_rows) {
  double largest = minus_infinity;
  for (const Component& component : components_) {
    largest = component.log_constant > largest ? component.log_constant : largest;
  }
  log_largest_ = largest == minus_infinity ? 0.0 : largest;
}

void MixtureTerms::evaluate(const double* points, Index stride, Index rows) {
  constexpr double least_sum = 1e-250;  // below it some terms may have lost digits
  sum_.head(rows).setZero();
  log_scale_.head(rows).setConstant(log_largest_);
  for (std::size_t k = 0; k < components_.size(); ++k) {
    const Component& component = components_[k];
    const double factor = portable_math::exp(component.log_constant - log_largest_);
    double* distances = distances_.col(static_cast<Index>(k)).data();
    double* terms = terms_.col(static_cast<Index>(k)).data();
    if (degrees_of_freedom_ == usual_degrees_of_freedom &&
        are_terms_of_few(d_, points, stride, rows, component, factor, distances, terms, sum_.data())) {
      continue;
    }
    squared_distances(points, stride, rows, d_, component.mean, component.factor, white_.data(), distances);
    add_powers(rows, factor, 1.0 / static_cast<double>(degrees_of_freedom_), degrees_of_freedom_ + d_,
               distances, terms, sum_.data());
  }
  if (are_above(rows, least_sum, sum_.data())) {
    return;
  }
  for (Index i = 0; i < rows; ++i) {
    if (!(sum_[i] > least_sum)) {
      evaluate_by_logarithms(i);
    }
  }
}

/// Where the powers underflow.
void MixtureTerms::evaluate_by_logarithms(Index i) {
  const double inverse_nu = 1.0 / static_cast<double>(degrees_of_freedom_);
  const double exponent = 0.5 * static_cast<double>(degrees_of_freedom_ + d_);
  double largest = minus_infinity;
  for (Index k = 0; k < terms_.cols(); ++k) {
    terms_(i, k) = components_[static_cast<std::size_t>(k)].log_constant -
                   exponent * portable_math::log(1.0 + distances_(i, k) * inverse_nu);
    largest = terms_(i, k) > largest ? terms_(i, k) : largest;
  }
  log_scale_[i] = largest == minus_infinity ? 0.0 : largest;
  sum_[i] = 0.0;
  for (Index k = 0; k < terms_.cols(); ++k) {
    terms_(i, k) = portable_math::exp(terms_(i, k) - log_scale_[i]);
    sum_[i] += terms_(i, k);
  }
}

}  // namespace tmcmc::detail
