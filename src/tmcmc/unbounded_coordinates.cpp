#include "tmcmc/unbounded_coordinates.hpp"

#include <algorithm>
#include <cmath>

#include "portable_math/multiversion.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

namespace {

PORTABLE_MATH_MULTIVERSION
void add_log_logistic(const double* z, Index n, double* log_density) {
  for (Index i = 0; i < n; ++i) {
    const double distance = std::fabs(z[i]);
    log_density[i] -= distance + 2.0 * portable_math::log_positive(1.0 + portable_math::exp(-distance));
  }
}

PORTABLE_MATH_MULTIVERSION
void enter_box(const double* z, Index n, double low, double high, double first, double last, double* x) {
  for (Index i = 0; i < n; ++i) {
    const double e = portable_math::exp(-std::fabs(z[i]));
    const double part = (high - low) * (e / (1.0 + e));
    const double value = z[i] > 0.0 ? high - part : low + part;
    const double above = value > first ? value : first;
    x[i] = above < last ? above : last;
  }
}

/// x from log(x - bound), or from -log(bound - x) for sign = -1.
PORTABLE_MATH_MULTIVERSION
void enter_half_line(const double* z, Index n, double bound, double sign, double* x) {
  const double first = std::nextafter(bound, sign * std::numeric_limits<double>::infinity());
  const double last = sign * std::numeric_limits<double>::max();
  const double low = sign > 0.0 ? first : last;
  const double high = sign > 0.0 ? last : first;
  for (Index i = 0; i < n; ++i) {
    const double value = bound + sign * portable_math::exp(sign * z[i]);
    const double above = value > low ? value : low;
    x[i] = above < high ? above : high;
  }
}

/// log |dx/dz| of a coordinate.
double log_slope(double z, double low, double high) {
  if (std::isfinite(low) && std::isfinite(high)) {
    const double distance = std::fabs(z);
    return portable_math::log(high - low) - distance -
           2.0 * portable_math::log_positive(1.0 + portable_math::exp(-distance));
  }
  return std::isfinite(low) ? z : (std::isfinite(high) ? -z : 0.0);
}

}  // namespace

Population to_unbounded(const Population& points, const Prior& prior) {
  Population result = points;
  for (Index j = 0; j < points.cols(); ++j) {
    const double low = prior.lower()[j];
    const double high = prior.upper()[j];
    for (Index i = 0; i < points.rows(); ++i) {
      if (std::isfinite(low) && std::isfinite(high)) {
        result(i, j) = portable_math::log(points(i, j) - low) - portable_math::log(high - points(i, j));
      } else if (std::isfinite(low)) {
        result(i, j) = portable_math::log(points(i, j) - low);
      } else if (std::isfinite(high)) {
        result(i, j) = -portable_math::log(high - points(i, j));
      }
    }
  }
  return result;
}

Population from_unbounded(const Population& z, const Prior& prior) {
  Population x = z;
  for (Index j = 0; j < z.cols(); ++j) {
    const double low = prior.lower()[j];
    const double high = prior.upper()[j];
    if (std::isfinite(low) && std::isfinite(high)) {
      enter_box(z.col(j).data(), z.rows(), low, high, std::nextafter(low, high), std::nextafter(high, low),
                x.col(j).data());
    } else if (std::isfinite(low) || std::isfinite(high)) {
      const bool above = std::isfinite(low);
      enter_half_line(z.col(j).data(), z.rows(), above ? low : high, above ? 1.0 : -1.0, x.col(j).data());
    }
  }
  return x;
}

Eigen::VectorXd log_prior_density(const Population& z, const Prior& prior, int threads) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(z.rows());
  if (!prior.is_box()) {
    result = prior.log_density(from_unbounded(z, prior));
    for (Index j = 0; j < z.cols(); ++j) {
      for (Index i = 0; i < z.rows(); ++i) {
        result[i] += log_slope(z(i, j), prior.lower()[j], prior.upper()[j]);
      }
    }
    return result;
  }
  for_each_block(z.rows(), reduction_rows, threads, [&](Index, Index begin, Index end) {
    for (Index j = 0; j < z.cols(); ++j) {
      add_log_logistic(z.col(j).data() + begin, end - begin, result.data() + begin);
    }
  });
  return result;
}

}  // namespace tmcmc
