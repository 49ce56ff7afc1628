#include "tmcmc/detail/support_lanes.hpp"

#include <cmath>
#include <limits>

#include "portable_math/elementary.hpp"
#include "portable_math/multiversion.hpp"

namespace tmcmc::detail {

namespace {

using Lanes = ProposalLanes::Lanes;

/// Replaces x by u = log((x - low) / (high - x)); log(dx/du), up to a constant, is subtracted from
/// log_jacobian.
PORTABLE_MATH_MULTIVERSION
void leave_box(double low, double high, std::size_t count, Lanes& x, Lanes& log_jacobian) {
  for (std::size_t i = 0; i < count; ++i) {
    const double below = portable_math::log(x[i] - low);
    const double above = portable_math::log(high - x[i]);
    log_jacobian[i] -= below + above;
    x[i] = below - above;
  }
}

/// The inverse transformation, from u; log(dx/du) is added to log_jacobian. A value that rounds to
/// a bound counts as outside.
PORTABLE_MATH_MULTIVERSION
void enter_box(double low, double high, std::size_t count, Lanes& x, Lanes& log_jacobian) {
  for (std::size_t i = 0; i < count; ++i) {
    const double e = portable_math::exp(x[i] > 0.0 ? -x[i] : x[i]);
    const double part = (high - low) * (e / (1.0 + e));
    const double value = x[i] > 0.0 ? high - part : low + part;
    const bool inside = value > low && value < high;
    x[i] = inside ? value : high + (high - low);
    log_jacobian[i] += inside ? portable_math::log(value - low) + portable_math::log(high - value) : 0.0;
  }
}

/// Replaces x by u = log(x - bound), or u = -log(bound - x) for sign = -1; log(dx/du) is subtracted
/// from log_jacobian.
PORTABLE_MATH_MULTIVERSION
void leave_half_line(double bound, double sign, std::size_t count, Lanes& x, Lanes& log_jacobian) {
  for (std::size_t i = 0; i < count; ++i) {
    const double log_distance = portable_math::log(sign * (x[i] - bound));
    log_jacobian[i] -= log_distance;
    x[i] = sign * log_distance;
  }
}

/// The inverse transformation, from u; log(dx/du) is added to log_jacobian. A value that rounds to
/// the bound or to infinity counts as outside.
PORTABLE_MATH_MULTIVERSION
void enter_half_line(double bound, double sign, std::size_t count, Lanes& x, Lanes& log_jacobian) {
  for (std::size_t i = 0; i < count; ++i) {
    const double value = bound + sign * portable_math::exp(sign * x[i]);
    const double distance = sign * (value - bound);
    const bool inside = distance > 0.0 && distance < std::numeric_limits<double>::infinity();
    x[i] = inside ? value : std::numeric_limits<double>::quiet_NaN();
    log_jacobian[i] += inside ? portable_math::log(distance) : 0.0;
  }
}

}  // namespace

void leave_support(double low, double high, std::size_t count, Lanes& x, Lanes& log_jacobian) {
  if (std::isfinite(low) && std::isfinite(high)) {
    leave_box(low, high, count, x, log_jacobian);
  } else if (std::isfinite(low) || std::isfinite(high)) {
    const bool above = std::isfinite(low);
    leave_half_line(above ? low : high, above ? 1.0 : -1.0, count, x, log_jacobian);
  }
}

void enter_support(double low, double high, std::size_t count, Lanes& x, Lanes& log_jacobian) {
  if (std::isfinite(low) && std::isfinite(high)) {
    enter_box(low, high, count, x, log_jacobian);
  } else if (std::isfinite(low) || std::isfinite(high)) {
    const bool above = std::isfinite(low);
    enter_half_line(above ? low : high, above ? 1.0 : -1.0, count, x, log_jacobian);
  }
}

}  // namespace tmcmc::detail
