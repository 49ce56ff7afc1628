/// \file
/// What Metropolis proposals can be.
#pragma once

namespace tmcmc {

/// The m in Eq. 5.
enum class Centre {
  weighted_mean,  ///< Ching and Chen 2007
  plain_mean      ///< as Eq. 5 is printed
};

/// Coordinates in which proposals are made.
enum class Coordinates {
  natural,  ///< the parameters; a proposal can fall outside the support of the prior
  /// u = log((x - lower) / (upper - x)) where the prior's support has two bounds, log(x - lower) or -log(upper - x) where it
  /// has one, x itself where it has none; the acceptance ratio carries the Jacobian, and none falls outside.
  unbounded
};

/// What happens to a proposal outside the support of the prior.
enum class Boundary {
  reject,  ///< the chain stays; leaves the tempered posterior invariant
  redraw   ///< drawn again until inside, without the correction of the acceptance ratio (published scripts)
};

}  // namespace tmcmc
