#include "tmcmc/student_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "portable_math/multiversion.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

namespace {

constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

/// log Gamma(twice / 2), by the recurrence from Gamma(1) = 1 or Gamma(1/2) = sqrt(pi).
double log_gamma_of_half(Index twice) {
  double value = twice % 2 == 0 ? 0.0 : 0.5 * portable_math::log(std::numbers::pi);
  for (Index k = twice % 2 == 0 ? 2 : 1; k < twice; k += 2) {
    value += portable_math::log(0.5 * static_cast<double>(k));
  }
  return value;
}

/// white = L^-1 (z - m) by forward substitution, distances = |white|^2.
PORTABLE_MATH_MULTIVERSION
void whiten(const double* points, Index stride, Index rows, Index d, const double* mean, const double* factor,
            double* white, double* distances) {
  for (Index i = 0; i < rows; ++i) {
    distances[i] = 0.0;
  }
  for (Index j = 0; j < d; ++j) {
    double* y = white + j * detail::mixture_rows;
    const double* z = points + j * stride;
    const double centre = mean[j];
    for (Index i = 0; i < rows; ++i) {
      y[i] = z[i] - centre;
    }
    for (Index l = 0; l < j; ++l) {
      const double entry = factor[j + l * d];
      const double* before = white + l * detail::mixture_rows;
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

/// share = factor (1 + distance / nu)^(-twice_exponent / 2), by repeated squaring; sum += share.
PORTABLE_MATH_MULTIVERSION
void add_powers(Index rows, double factor, double inverse_nu, Index twice_exponent, const double* distances,
                double* share, double* sum) {
  double square[detail::mixture_rows];
  for (Index i = 0; i < rows; ++i) {
    square[i] = 1.0 / (1.0 + distances[i] * inverse_nu);
  }
  for (Index i = 0; i < rows; ++i) {
    share[i] = twice_exponent % 2 == 0 ? factor : factor * std::sqrt(square[i]);
  }
  for (Index exponent = twice_exponent / 2;;) {
    if (exponent % 2 != 0) {
      for (Index i = 0; i < rows; ++i) {
        share[i] *= square[i];
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
    sum[i] += share[i];
  }
}

PORTABLE_MATH_MULTIVERSION
void log_and_inverse(Index rows, double shift, const double* sum, double* result, double* inverse) {
  for (Index i = 0; i < rows; ++i) {
    result[i] = shift + portable_math::log(sum[i]);
    inverse[i] = 1.0 / sum[i];
  }
}

PORTABLE_MATH_MULTIVERSION
void scale_by(Index rows, const double* factor, double* x) {
  for (Index i = 0; i < rows; ++i) {
    x[i] *= factor[i];
  }
}

}  // namespace

namespace detail {

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

namespace {

/// Density and shares of row i, by logarithms: where the powers underflow.
void log_row(const std::vector<Component>& components, double exponent, double inverse_nu, Index i,
             const double* distances, double* log_density, double* shares) {
  const auto count = static_cast<Index>(components.size());
  double largest = minus_infinity;
  for (Index k = 0; k < count; ++k) {
    const double distance = distances[k * detail::mixture_rows + i];
    double& term = shares[k * detail::mixture_rows + i];
    term = components[static_cast<std::size_t>(k)].log_constant -
           exponent * portable_math::log(1.0 + distance * inverse_nu);
    largest = term > largest ? term : largest;
  }
  const double shift = largest == minus_infinity ? 0.0 : largest;
  double sum = 0.0;
  for (Index k = 0; k < count; ++k) {
    double& share = shares[k * detail::mixture_rows + i];
    share = portable_math::exp(share - shift);
    sum += share;
  }
  log_density[i] = shift + portable_math::log(sum);
  for (Index k = 0; k < count; ++k) {
    shares[k * detail::mixture_rows + i] *= sum > 0.0 ? 1.0 / sum : 0.0;
  }
}

}  // namespace

void mixture_density(const std::vector<Component>& components, Index d, int degrees_of_freedom,
                     const double* points, Index stride, Index rows, double* white, double* distances,
                     double* log_density, double* shares) {
  constexpr double least_sum = 1e-250;  // below it some shares may have lost digits
  double largest = minus_infinity;
  for (const Component& component : components) {
    largest = component.log_constant > largest ? component.log_constant : largest;
  }
  const double shift = largest == minus_infinity ? 0.0 : largest;
  const double inverse_nu = 1.0 / degrees_of_freedom;
  const Index twice_exponent = degrees_of_freedom + d;
  double sum[detail::mixture_rows] = {};
  for (std::size_t k = 0; k < components.size(); ++k) {
    const Index column = static_cast<Index>(k) * detail::mixture_rows;
    whiten(points, stride, rows, d, components[k].mean, components[k].factor, white, distances + column);
    add_powers(rows, portable_math::exp(components[k].log_constant - shift), inverse_nu, twice_exponent,
               distances + column, shares + column, sum);
  }
  double inverse[detail::mixture_rows];
  log_and_inverse(rows, shift, sum, log_density, inverse);
  for (std::size_t k = 0; k < components.size(); ++k) {
    scale_by(rows, inverse, shares + static_cast<Index>(k) * detail::mixture_rows);
  }
  for (Index i = 0; i < rows; ++i) {
    if (!(sum[i] > least_sum)) {
      log_row(components, 0.5 * static_cast<double>(twice_exponent), inverse_nu, i, distances, log_density,
              shares);
    }
  }
}

}  // namespace detail

Eigen::VectorXd log_density(const StudentMixture& mixture, const Population& points, int threads) {
  const Index d = mixture.dimension();
  const auto components = detail::components_of(mixture);
  Eigen::VectorXd result(points.rows());
  for_each_block(points.rows(), reduction_rows, threads, [&](Index, Index begin, Index end) {
    const auto entries = static_cast<std::size_t>(mixture.size() * detail::mixture_rows);
    std::vector<double> white(static_cast<std::size_t>(d * detail::mixture_rows));
    std::vector<double> distances(entries);
    std::vector<double> shares(entries);
    for (Index i = begin; i < end; i += detail::mixture_rows) {
      const Index rows = std::min(detail::mixture_rows, end - i);
      detail::mixture_density(components, d, mixture.degrees_of_freedom, points.data() + i, points.rows(),
                              rows, white.data(), distances.data(), result.data() + i, shares.data());
    }
  });
  return result;
}

StudentMixture blend(const StudentMixture& a, double share, const StudentMixture& b) {
  StudentMixture result = a;
  result.weights.resize(a.size() + b.size());
  result.weights << share * a.weights, (1.0 - share) * b.weights;
  result.means.resize(a.dimension(), a.size() + b.size());
  result.means << a.means, b.means;
  result.factors.insert(result.factors.end(), b.factors.begin(), b.factors.end());
  return result;
}

}  // namespace tmcmc
