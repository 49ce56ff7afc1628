/// \file
/// Elementary functions in plain double arithmetic.
///
/// The results of std::exp, std::log, std::sin and std::atan2 depend on the C library and on the
/// instruction set that it finds at run time. The functions here use IEEE additions,
/// multiplications, divisions and bit operations in a fixed order instead, so that every machine
/// gives the same bits (compile with -ffp-contract=off), and they have no branches, so that a loop
/// over them vectorises. Errors are below 3 units in the last place.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

/// Marks a function that is inlined into every caller, so that a loop over it vectorises for the
/// caller's instruction set.
#define PORTABLE_MATH_INLINE [[gnu::always_inline]] inline

namespace portable_math {

namespace detail {

constexpr double round_shift = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer

PORTABLE_MATH_INLINE double select(bool condition, double if_true, double if_false) {
  return condition ? if_true : if_false;
}

/// c0 + c1 x + c2 x^2 + ... by Horner's rule.
template <class... Coefficients>
PORTABLE_MATH_INLINE double polynomial(double x, double c0, Coefficients... rest) {
  if constexpr (sizeof...(rest) == 0) {
    return c0;
  } else {
    return c0 + x * polynomial(x, rest...);
  }
}

/// sin(x) for |x| <= pi/4 (fdlibm's kernel polynomial).
PORTABLE_MATH_INLINE double sin_kernel(double x) {
  const double z = x * x;
  const double p =
      polynomial(z, -1.66666666666666324348e-01, 8.33333333332248946124e-03, -1.98412698298579493134e-04,
                 2.75573137070700676789e-06, -2.50507602534068634195e-08, 1.58969099521155010221e-10);
  return x + x * z * p;
}

/// cos(x) for |x| <= pi/4 (fdlibm's kernel polynomial).
PORTABLE_MATH_INLINE double cos_kernel(double x) {
  const double z = x * x;
  const double p =
      polynomial(z, 4.16666666666666019037e-02, -1.38888888888741095749e-03, 2.48015872894767294178e-05,
                 -2.75573143513906633035e-07, 2.08757232129817482790e-09, -1.13596475577881948265e-11);
  const double half_z = 0.5 * z;
  const double w = 1.0 - half_z;
  return w + ((1.0 - w) - half_z + z * z * p);
}

}  // namespace detail

/// e^x. Results below 1e-307 are returned as 0; NaN stays NaN.
PORTABLE_MATH_INLINE double exp(double x) {
  const double shifted = x * std::numbers::log2e + detail::round_shift;
  const double k = shifted - detail::round_shift;
  const double r = (x - k * 6.93147180369123816490e-01) - k * 1.90821492927058770002e-10;
  const double tail = detail::polynomial(r, 0.5, 0.1666666666666667, 0.04166666666666667,
                                         0.008333333333326136, 0.0013888888888883748, 0.00019841269874820627,
                                         2.4801587325547743e-05, 2.7557255400206422e-06, 2.75572736431103e-07,
                                         2.5105217004720745e-08, 2.0914686968086876e-09);
  const double p = 1.0 + (r + r * r * tail);
  // 2^(k-1), whose exponent field cannot overflow unless the result does; a factor of 2 completes
  // the scaling.
  const double half_scale = std::bit_cast<double>((std::bit_cast<std::uint64_t>(shifted) + 1022U) << 52U);
  const double in_range = 2.0 * (p * half_scale);
  const double above =
      detail::select(x > 709.782712893384, std::numeric_limits<double>::infinity(), in_range);
  const double below = detail::select(x < -706.8, 0.0, above);
  return detail::select(x != x, x, below);
}

namespace detail {

/// log(x 2^-exponent) for positive normal x (fdlibm's polynomial).
PORTABLE_MATH_INLINE double log_normal(double x, double exponent) {
  constexpr std::uint64_t sqrt_half = 0x3fe6a09e667f3bcdU;
  constexpr std::uint64_t one = 0x3ff0000000000000U;
  const std::uint64_t u = std::bit_cast<std::uint64_t>(x) + (one - sqrt_half);
  const double k_biased = std::bit_cast<double>((u >> 52U) | 0x4330000000000000U) - 4503599627370496.0;
  const double k = k_biased - (1023.0 + exponent);
  const double m = std::bit_cast<double>((u & 0x000fffffffffffffU) + sqrt_half);
  const double f = m - 1.0;
  const double half_square = 0.5 * f * f;
  const double s = f / (2.0 + f);
  const double z = s * s;
  const double p =
      z * polynomial(z, 6.666666666666735130e-01, 3.999999999940941908e-01, 2.857142874366239149e-01,
                     2.222219843214978396e-01, 1.818357216161805012e-01, 1.531383769920937332e-01,
                     1.479819860511658591e-01);
  return s * (half_square + p) + k * 1.90821492927058770002e-10 - half_square + f +
         k * 6.93147180369123816490e-01;
}

}  // namespace detail

/// Natural logarithm of a positive, normal, finite number; for other arguments the result is
/// meaningless.
PORTABLE_MATH_INLINE double log_positive(double x) {
  return detail::log_normal(x, 0.0);
}

/// Natural logarithm; log(0) = -inf, negative arguments give NaN.
PORTABLE_MATH_INLINE double log(double x) {
  const bool subnormal = x < std::numeric_limits<double>::min();
  const double value = detail::log_normal(detail::select(subnormal, x * 18014398509481984.0, x),
                                          detail::select(subnormal, 54.0, 0.0));
  const double finite =
      detail::select(x < std::numeric_limits<double>::infinity(), value, x);  // inf and NaN pass through
  const double positive = detail::select(x == 0.0, -std::numeric_limits<double>::infinity(), finite);
  return detail::select(x < 0.0, std::numeric_limits<double>::quiet_NaN(), positive);
}

/// Angle of the point (x, y), y >= 0, in [0, pi], for finite arguments below 1e307, not both 0. The
/// error is below 3 ulp.
PORTABLE_MATH_INLINE double polar_angle(double y, double x) {
  const double ax = std::fabs(x);
  const bool steep = y > ax;
  const double low = detail::select(steep, ax, y);
  const double high = detail::select(steep, y, ax);
  const bool octant = low > 0.41421356237309503 * high;  // beyond tan(pi/8): rotate by pi/4
  const double numerator = detail::select(octant, low - high, low);
  const double denominator = detail::select(octant, low + high, high);
  const double t = numerator / denominator;
  const double z = t * t;
  const double p = detail::polynomial(z, -0.3333333333333333, 0.19999999999995516, -0.14285714284665682,
                                      0.11111111015187018, -0.0909090457530649, 0.07692183125376892,
                                      -0.06664510525508936, 0.05858140904866328, -0.050854078345894844,
                                      0.03923044778479309, -0.019175404711104935);
  const double small = t + t * z * p;
  const double first = detail::select(octant, (small + 3.061616997868383e-17) + 0.7853981633974483, small);
  const double second = detail::select(steep, (6.123233995736766e-17 - first) + 1.5707963267948966, first);
  return detail::select(x < 0.0, (1.2246467991473532e-16 - second) + 3.141592653589793, second);
}

/// Angle of the point (x, y) in [-pi, pi], for finite arguments below 1e307; atan2(0, x) = 0 for x
/// >= 0 and pi for x < 0, whatever the sign of the zeros.
PORTABLE_MATH_INLINE double atan2(double y, double x) {
  const double angle = polar_angle(std::fabs(y), detail::select(x == 0.0 && y == 0.0, 1.0, x));
  return detail::select(y < 0.0, -angle, angle);
}

/// Sine and cosine of one angle; errors below 3 units in the last place.
struct SinCos {
  /// In [-1, 1] up to rounding.
  double sin;
  /// In [-1, 1] up to rounding.
  double cos;
};

/// Sine and cosine of x radians, |x| < 1e5.
PORTABLE_MATH_INLINE SinCos sin_cos(double x) {
  const double shifted = x * (2.0 / std::numbers::pi) + detail::round_shift;
  const double k = shifted - detail::round_shift;
  const std::uint64_t quadrant = std::bit_cast<std::uint64_t>(shifted);
  const double r = ((x - k * 1.57079632673412561417e+00) - k * 6.07710050630396597660e-11) -
                   k * 2.02226624879595063154e-21;
  const double s = detail::sin_kernel(r);
  const double c = detail::cos_kernel(r);
  const bool odd = (quadrant & 1U) != 0;
  const bool sin_negative = (quadrant & 2U) != 0;
  const bool cos_negative = ((quadrant + 1U) & 2U) != 0;
  const double sin_abs = detail::select(odd, c, s);
  const double cos_abs = detail::select(odd, s, c);
  return {detail::select(sin_negative, -sin_abs, sin_abs), detail::select(cos_negative, -cos_abs, cos_abs)};
}

/// Sine of x radians, |x| < 1e5.
PORTABLE_MATH_INLINE double sin(double x) {
  return sin_cos(x).sin;
}
/// Cosine of x radians, |x| < 1e5.
PORTABLE_MATH_INLINE double cos(double x) {
  return sin_cos(x).cos;
}

/// Sine and cosine of u full turns, 0 <= u <= 1; the reduction to a quarter turn is exact.
PORTABLE_MATH_INLINE SinCos sin_cos_turns(double u) {
  const double shifted = 4.0 * u + detail::round_shift;
  const double k = shifted - detail::round_shift;
  const std::uint64_t quadrant = std::bit_cast<std::uint64_t>(shifted);
  const double r = (4.0 * u - k) * (0.5 * std::numbers::pi);
  const double s = detail::sin_kernel(r);
  const double c = detail::cos_kernel(r);
  const bool odd = (quadrant & 1U) != 0;
  const double sin_abs = detail::select(odd, c, s);
  const double cos_abs = detail::select(odd, s, c);
  return {detail::select((quadrant & 2U) != 0, -sin_abs, sin_abs),
          detail::select(((quadrant + 1U) & 2U) != 0, -cos_abs, cos_abs)};
}

}  // namespace portable_math
