/// \file
/// Transformations between parameters and the unbounded coordinates that follow from the supports
/// of their prior.
#pragma once

#include "tmcmc/prior.hpp"

namespace tmcmc {

/// Coordinates of the points, n x d: log((x - lower) / (upper - x)) where the support of a
/// parameter has two bounds, log(x - lower) or -log(upper - x) where it has one, x itself where it
/// has none.
/// \param points  n x d, inside the support
[[nodiscard]] Population to_unbounded(const Population& points, const Prior& prior);

/// The parameters x for coordinates z, n x d: the inverse of to_unbounded(). A value that would
/// round to a bound of the support becomes the adjacent double inside it.
[[nodiscard]] Population from_unbounded(const Population& z, const Prior& prior);

/// Logarithm of the prior density of the coordinates, p(x(z)) |dx/dz|. A uniform parameter has the
/// standard logistic density, -(|z_j| + 2 log(1 + exp(-|z_j|))).
/// \param z  n x d
[[nodiscard]] Eigen::VectorXd log_prior_density(const Population& z, const Prior& prior, int threads = 1);

}  // namespace tmcmc
