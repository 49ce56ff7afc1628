/// \file
/// What a figure or table shows of the exact posterior, and how far the samplers are from it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "estimation/exact_posterior.hpp"
#include "estimation/laplace.hpp"
#include "replication/sample_tables.hpp"
#include "statistics/summary.hpp"

namespace replication {

/// What is known of one parameter, in its unit.
struct ParameterEstimate {
  /// Levels of the quantiles.
  static constexpr std::array<double, 5> levels{0.025, 0.25, 0.5, 0.75, 0.975};
  /// Exact.
  double mean, standard_deviation;
  /// Exact, at the levels.
  std::array<double, 5> quantiles;
  /// Of the normal approximation; NaN where there is none.
  double laplace_mode, laplace_standard_deviation;
  /// Least squares; of a noise level the estimate of maximum likelihood.
  double least_squares;
};

/// One a parameter, in the order of friction::Parameter.
[[nodiscard]] std::vector<ParameterEstimate> parameter_estimates(
    const estimation::ExactPosterior& posterior, const estimation::LaplaceApproximation& laplace,
    const estimation::LeastSquaresFit& fit);

/// The error of one sampler in one quantity, from its runs.
struct QuantityError {
  /// As in the runs.
  std::string sampler;
  /// One of estimated_quantities.
  std::string quantity;
  /// Number of estimates.
  std::size_t runs;
  /// Value of the exact posterior.
  double exact;
  /// Of the estimates.
  statistics::EstimateError error;
  /// Number of independent samples whose mean would spread as much; NaN of other quantities than
  /// means.
  double effective_size;
};

/// Each sampler's error in each of estimated_quantities.
/// \param runs  as read_estimates returns them
[[nodiscard]] std::vector<QuantityError> errors_of(const GroupedColumns& runs,
                                                   const estimation::ExactPosterior& posterior);

/// A place on the exact marginal of a parameter.
struct MarginalPoint {
  /// Friction::Parameter.
  std::size_t parameter;
  /// In the unit of the parameter.
  double x;
  /// Exact, per that unit.
  double density;
  /// Exact.
  double cdf;
  /// Of the normal approximation.
  double laplace_density;
};

/// Each marginal at equal distances over all but 2e-4 of its probability.
/// \param points  of each marginal, at least 2
[[nodiscard]] std::vector<MarginalPoint> marginal_points(const estimation::ExactPosterior& posterior,
                                                         const estimation::LaplaceApproximation& laplace,
                                                         long points);

/// The p-box of a sampler at one place, beside the exact distribution function.
struct PboxPoint {
  /// As in the samples.
  std::string sampler;
  /// Friction::Parameter.
  std::size_t parameter;
  /// In the unit of the parameter.
  double x;
  /// Smallest and largest value of the runs' empirical distribution functions.
  double lower, upper;
  /// Value of the exact one.
  double exact;
};

/// P-boxes of all runs of each sampler on the places of marginal_points.
/// \param samples  of the four parameters in order
/// \param points  of each parameter, at least 2
[[nodiscard]] std::vector<PboxPoint> pbox_points(const GroupedColumns& samples,
                                                 const estimation::ExactPosterior& posterior, long points);

/// A bin of the pooled samples of a sampler.
struct HistogramBin {
  /// As in the samples.
  std::string sampler;
  /// Friction::Parameter.
  std::size_t parameter;
  /// In the unit of the parameter.
  double low;
  /// The next bin's low.
  double high;
  /// Per that unit.
  double density;
};

/// Histograms over the ranges of marginal_points.
/// \param samples  of the four parameters in order
[[nodiscard]] std::vector<HistogramBin> sample_histograms(const GroupedColumns& samples,
                                                          const estimation::ExactPosterior& posterior,
                                                          long bins);

}  // namespace replication
