/// \file
/// Weighted samples as the panels of a corner plot: marginal densities, and joint densities of
/// pairs.
#pragma once

#include <span>
#include <vector>

namespace statistics {

/// Ends of a panel, in the unit of the parameter.
struct Range {
  /// Lower end, finite and less than high.
  double low;
  /// Upper end, finite.
  double high;
};

/// Quantile of weighted values: the smallest value with at least the share p of the weight at or
/// below it.
/// \param weights  one per value, not negative, not all zero; empty for equal weights
/// \throws errors::InvalidValue if there is no value, or if the weights are invalid.
[[nodiscard]] double weighted_quantile(std::span<const double> values, std::span<const double> weights,
                                       double p);

/// The range that holds all but a thousandth of the weight, extended by a twentieth of its width on
/// each side, but not beyond the smallest and the largest value. If all values are equal, the range
/// around the value has a width of a hundredth of it, or of 1 around 0.
/// \throws as weighted_quantile
[[nodiscard]] Range panel_range(std::span<const double> values, std::span<const double> weights);

/// Distance between the tick marks of a panel: 1, 2 or 5 times a power of ten, whichever comes
/// closest to dividing the range into three.
/// \throws errors::InvalidValue for a range that is not finite or has no width
[[nodiscard]] double tick_spacing(const Range& range);

/// Probability density in each of equal bins over the range, normalised by all the weight,
/// including the weight outside the range.
/// \throws as weighted_quantile; also for a range without width or without bins
[[nodiscard]] std::vector<double> marginal_density(std::span<const double> values,
                                                   std::span<const double> weights, const Range& range,
                                                   long bins);

/// A pair of parameters on a grid of bins times bins cells, x running faster.
struct PairDensity {
  /// Densities, per unit of x times unit of y.
  std::vector<double> density;
  /// Probability of all cells at least as dense as this one, this one included: the cells with a
  /// level up to p form the smallest region with probability p. The level of empty cells is 1.
  std::vector<double> level;
};

/// \throws as marginal_density
[[nodiscard]] PairDensity pair_density(std::span<const double> x, std::span<const double> y,
                                       std::span<const double> weights, const Range& x_range,
                                       const Range& y_range, long bins);

}  // namespace statistics
