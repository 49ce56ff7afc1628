/// \file
/// Contents of figures and tables about the exact posterior, and the distances of the samplers from
/// it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "estimation/exact_posterior.hpp"
#include "estimation/laplace.hpp"
#include "replication/sample_tables.hpp"
#include "statistics/summary.hpp"

namespace replication {

/// Estimates of one parameter, in its unit.
struct ParameterEstimate {
  /// Levels of the quantiles.
  static constexpr std::array<double, 5> levels{0.025, 0.25, 0.5, 0.75, 0.975};
  /// Exact posterior mean and standard deviation.
  double mean, standard_deviation;
  /// Exact quantiles at the levels.
  std::array<double, 5> quantiles;
  /// Mode and standard deviation of the normal approximation; NaN where there is none.
  double laplace_mode, laplace_standard_deviation;
  /// Least-squares estimate; for a noise level the maximum-likelihood estimate.
  double least_squares;
};

/// One estimate per parameter, in the order of friction::Parameter.
[[nodiscard]] std::vector<ParameterEstimate> parameter_estimates(
    const estimation::ExactPosterior& posterior, const estimation::LaplaceApproximation& laplace,
    const estimation::LeastSquaresFit& fit);

/// The error of one sampler in one quantity, from its runs.
struct QuantityError {
  /// Name of the sampler, as in the runs.
  std::string sampler;
  /// One of estimated_quantities().
  std::string quantity;
  /// Number of estimates.
  std::size_t runs;
  /// Value of the exact posterior.
  double exact;
  /// Error of the estimates.
  statistics::EstimateError error;
  /// Number of independent samples whose mean would have the same spread; NaN for quantities other
  /// than means.
  double effective_size;
};

/// Each sampler's error in each of estimated_quantities.
/// \param runs  as read_estimates returns them
[[nodiscard]] std::vector<QuantityError> errors_of(const GroupedColumns& runs,
                                                   const estimation::ExactPosterior& posterior);

/// A point on the exact marginal of a parameter.
struct MarginalPoint {
  /// Index in the order of friction::Parameter.
  std::size_t parameter;
  /// Value, in the unit of the parameter.
  double x;
  /// Exact density, per that unit.
  double density;
  /// Exact distribution function.
  double cdf;
  /// Density of the normal approximation.
  double laplace_density;
};

/// Points of each marginal at equal distances over all but 2e-4 of its probability.
/// \param points  points per marginal, at least 2
[[nodiscard]] std::vector<MarginalPoint> marginal_points(const estimation::ExactPosterior& posterior,
                                                         const estimation::LaplaceApproximation& laplace,
                                                         long points);

/// The p-box of a sampler at one point, with the exact distribution function.
struct PboxPoint {
  /// Name of the sampler, as in the samples.
  std::string sampler;
  /// Index in the order of friction::Parameter.
  std::size_t parameter;
  /// Value, in the unit of the parameter.
  double x;
  /// Smallest and largest value of the runs' empirical distribution functions.
  double lower, upper;
  /// Value of the exact distribution function.
  double exact;
};

/// P-boxes of all runs of each sampler at the values of marginal_points.
/// \param samples  samples of the four parameters in order
/// \param points  points per parameter, at least 2
[[nodiscard]] std::vector<PboxPoint> pbox_points(const GroupedColumns& samples,
                                                 const estimation::ExactPosterior& posterior, long points);

/// A bin of the pooled samples of a sampler.
struct HistogramBin {
  /// Name of the sampler, as in the samples.
  std::string sampler;
  /// Index in the order of friction::Parameter.
  std::size_t parameter;
  /// Lower end of the bin, in the unit of the parameter.
  double low;
  /// Upper end of the bin, which is the next bin's low.
  double high;
  /// Density, per that unit.
  double density;
};

/// Histograms over the ranges of marginal_points.
/// \param samples  samples of the four parameters in order
[[nodiscard]] std::vector<HistogramBin> sample_histograms(const GroupedColumns& samples,
                                                          const estimation::ExactPosterior& posterior,
                                                          long bins);

}  // namespace replication
