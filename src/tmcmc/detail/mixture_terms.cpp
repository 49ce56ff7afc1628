#include "tmcmc/detail/mixture_terms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "portable_math/elementary.hpp"
#include "portable_math/multiversion.hpp"
#include "tmcmc/detail/few_coordinates.hpp"

namespace tmcmc::detail {

namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();
constexpr int usual_degrees_of_freedom = 8;

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

/// base^((8 + d) / 2), base = 1 / (1 + distance / 8).
template <int d>
PORTABLE_MATH_INLINE double student_power(double base) {
  const double whole = power<(usual_degrees_of_freedom + d) / 2>(base);
  return d % 2 == 0 ? whole : whole * std::sqrt(base);
}

/// Terms of one component for so few coordinates that the coordinates of a point stay in registers,
/// with distance = |L^-1 (z - m)|^2 by forward substitution: term = narrow (1 + distance / 8)^(-(8
/// + d) / 2) + wide (1 + distance / (8 c^2))^(-(8 + d) / 2); sum += term.
/// \param inverse_square  1 / c^2
template <int d, bool has_wide>
PORTABLE_MATH_INLINE void terms_of_few(const double* __restrict points, Index stride, Index rows,
                                       const Component& component, double inverse_square,
                                       double* __restrict distances, double* __restrict terms,
                                       double* __restrict sum) {
  const double* mean = component.mean;
  const double* lower = component.factor;
  const double narrow = component.narrow;
  const double wide = component.wide;
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
    const double scaled = distance * (1.0 / usual_degrees_of_freedom);
    const double stretched = 1.0 + scaled;
    double term;
    if constexpr (has_wide) {
      const double less_stretched = 1.0 + scaled * inverse_square;
      const double both = 1.0 / (stretched * less_stretched);  // one division for two
      term = narrow * student_power<d>(both * less_stretched) + wide * student_power<d>(both * stretched);
    } else {
      term = narrow * student_power<d>(1.0 / stretched);
    }
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

/// term += factor (1 + distance / nu)^(-twice_exponent / 2), by repeated squaring; the same is
/// added to sum.
PORTABLE_MATH_MULTIVERSION
void add_powers(Index rows, double factor, double inverse_nu, Index twice_exponent, const double* distances,
                double* term, double* sum) {
  double square[mixture_rows];
  double result[mixture_rows];
  for (Index i = 0; i < rows; ++i) {
    square[i] = 1.0 / (1.0 + distances[i] * inverse_nu);
  }
  for (Index i = 0; i < rows; ++i) {
    result[i] = twice_exponent % 2 == 0 ? factor : factor * std::sqrt(square[i]);
  }
  for (Index exponent = twice_exponent / 2;;) {
    if (exponent % 2 != 0) {
      for (Index i = 0; i < rows; ++i) {
        result[i] *= square[i];
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
    term[i] += result[i];
    sum[i] += result[i];
  }
}

/// \param d  at most most_of_few
PORTABLE_MATH_MULTIVERSION
void add_terms_of_few(Index d, const double* points, Index stride, Index rows, const Component& component,
                      double inverse_square, double* distances, double* terms, double* sum) {
  for_few_coordinates(
      d, [&](auto few) __attribute__((always_inline)) {
        if (component.wide > 0.0) {
          terms_of_few<few, true>(points, stride, rows, component, inverse_square, distances, terms, sum);
        } else {
          terms_of_few<few, false>(points, stride, rows, component, inverse_square, distances, terms, sum);
        }
      });
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
      wide_share_(mixture.wide_share),
      inverse_square_(1.0 / (mixture.wider() * mixture.wider())),
      white_(is_usual() ? 0 : mixture_rows, d_),
      distances_(mixture_rows, mixture.size()),
      terms_(mixture_rows, mixture.size()),
      sum_(mixture_rows),
      log_scale_(mixture_rows) {
  double largest = minus_infinity;
  for (const Component& component : components_) {
    largest = component.log_constant > largest ? component.log_constant : largest;
  }
  log_largest_ = largest == minus_infinity ? 0.0 : largest;
  for (Component& component : components_) {
    const double constant = portable_math::exp(component.log_constant - log_largest_);
    component.narrow = (1.0 - wide_share_) * constant;
    component.wide = wide_share_ * constant / wider_volume(d_);
  }
}

bool MixtureTerms::is_usual() const {
  return degrees_of_freedom_ == usual_degrees_of_freedom && d_ <= most_of_few;
}

void MixtureTerms::evaluate(const double* points, Index stride, Index rows) {
  constexpr double least_sum = 1e-250;  // below it some terms may have lost digits
  sum_.head(rows).setZero();
  log_scale_.head(rows).setConstant(log_largest_);
  for (std::size_t k = 0; k < components_.size(); ++k) {
    const Component& component = components_[k];
    double* distances = distances_.col(static_cast<Index>(k)).data();
    double* terms = terms_.col(static_cast<Index>(k)).data();
    if (is_usual()) {
      add_terms_of_few(d_, points, stride, rows, component, inverse_square_, distances, terms, sum_.data());
      continue;
    }
    const double inverse_nu = 1.0 / static_cast<double>(degrees_of_freedom_);
    const Index exponent = degrees_of_freedom_ + d_;
    squared_distances(points, stride, rows, d_, component.mean, component.factor, white_.data(), distances);
    std::fill(terms, terms + rows, 0.0);
    add_powers(rows, component.narrow, inverse_nu, exponent, distances, terms, sum_.data());
    if (component.wide > 0.0) {
      add_powers(rows, component.wide, inverse_nu * inverse_square_, exponent, distances, terms, sum_.data());
    }
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

/// Evaluates a point at which the powers underflow.
void MixtureTerms::evaluate_by_logarithms(Index i) {
  using portable_math::exp;
  using portable_math::log;
  const double inverse_nu = 1.0 / static_cast<double>(degrees_of_freedom_);
  const double exponent = 0.5 * static_cast<double>(degrees_of_freedom_ + d_);
  const double log_narrow = log(1.0 - wide_share_);
  const double log_wide = log(wide_share_ / wider_volume(d_));
  double largest = minus_infinity;
  for (Index k = 0; k < terms_.cols(); ++k) {
    const double distance = distances_(i, k) * inverse_nu;
    const double narrow = log_narrow - exponent * log(1.0 + distance);
    const double wide = log_wide - exponent * log(1.0 + distance * inverse_square_);
    const double larger = narrow > wide ? narrow : wide;
    const double smaller = narrow > wide ? wide : narrow;
    const double constant = components_[static_cast<std::size_t>(k)].log_constant;
    terms_(i, k) = larger == minus_infinity ? larger : constant + larger + log(1.0 + exp(smaller - larger));
    largest = terms_(i, k) > largest ? terms_(i, k) : largest;
  }
  log_scale_[i] = largest == minus_infinity ? 0.0 : largest;
  sum_[i] = 0.0;
  for (Index k = 0; k < terms_.cols(); ++k) {
    terms_(i, k) = exp(terms_(i, k) - log_scale_[i]);
    sum_[i] += terms_(i, k);
  }
}

}  // namespace tmcmc::detail
