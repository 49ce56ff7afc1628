/// \file
/// Moments and quantiles of a sample.
#pragma once

#include <span>
#include <vector>

namespace statistics {

/// Mean and standard deviation (with N - 1; NaN for a single value), summed in index order.
struct Moments {
  /// Sum of the values over their number.
  double mean = 0.0;
  /// Standard deviation, in the unit of the values.
  double standard_deviation = 0.0;
};
/// \throws errors::InvalidValue if there is no value.
[[nodiscard]] Moments moments(std::span<const double> values);

/// Moments of weighted values: mean sum(w x) / W with W = sum(w), variance sum(w (x - mean)^2) / (W
/// - sum(w^2) / W). Equal weights give moments() of the values bit for bit.
/// \param weights  one per value, not negative
/// \throws errors::InvalidValue if the number of weights differs, or if none is positive.
[[nodiscard]] Moments moments(std::span<const double> values, std::span<const double> weights);

/// Square root of the mean of the squares, summed in index order; 0 if there are no values.
[[nodiscard]] double root_mean_square(std::span<const double> values);

/// An interval that holds 95 % of a distribution, which its owner specifies.
struct Interval95 {
  /// Lower end, with 2.5 % below.
  double low;
  /// Upper end, with 2.5 % above.
  double high;
};

/// Quantile of a sample by linear interpolation of the order statistics (type 7 of Hyndman and Fan
/// 1996).
/// \param sorted  ascending, not empty
/// \param p  in [0, 1]
[[nodiscard]] double sample_quantile(std::span<const double> sorted, double p);

/// Central 95 % interval of the draws.
[[nodiscard]] Interval95 central_95(std::vector<double> null);

/// Errors of the estimates of independent runs relative to the exact value, in the unit of the
/// estimates.
struct EstimateError {
  /// Mean of the estimates.
  double mean;
  /// Mean minus the exact value.
  double bias;
  /// Standard error of the bias: spread / sqrt(n).
  double standard_error;
  /// Standard deviation of the estimates (n - 1); NaN for one estimate.
  double spread;
  /// Root mean square of the differences from the exact value.
  double root_mean_square;
};
/// \throws errors::InvalidValue if there is no estimate.
[[nodiscard]] EstimateError error_of(std::span<const double> estimates, double exact);

/// `points` values from `low` to `high`, both included, at equal distances.
/// \param points  at least 2
/// \throws errors::InvalidValue for fewer points.
[[nodiscard]] std::vector<double> evenly_spaced(double low, double high, long points);

/// Number of values in each of equal bins from `low` to `high`; the lower end of a bin belongs to
/// it, and values outside the range are not counted.
/// \throws errors::InvalidValue unless low < high and there is a bin.
[[nodiscard]] std::vector<long> histogram(std::span<const double> values, double low, double high, long bins);

/// As histogram above, with the sum of the weights in place of the number of values.
/// \param weights  one per value
/// \throws as histogram; errors::InvalidValue if the number of weights differs.
[[nodiscard]] std::vector<double> histogram(std::span<const double> values, std::span<const double> weights,
                                            double low, double high, long bins);

}  // namespace statistics
