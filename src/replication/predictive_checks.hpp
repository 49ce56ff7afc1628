/// \file
/// Draws from the posterior predictive distribution of the rig, and the position of the
/// measurements in it.
#pragma once

#include <functional>
#include <vector>

#include "estimation/exact_posterior.hpp"
#include "estimation/posterior_predictive.hpp"

namespace replication {

/// Settings for drawing from the posterior.
struct PredictiveDrawing {
  /// Seed of the random stream.
  std::uint64_t seed = 1;
  /// Draws per posterior.
  long draws = 10000;
  /// Threads over the draws; the draws do not depend on the number.
  int threads = 1;
  /// Called once after the draws from each posterior; may be empty.
  std::function<void()> observer{};
};

/// Independent draws from a posterior, each with the errors of a new measurement.
/// \param stream  number of the random stream: one for each posterior
[[nodiscard]] std::vector<estimation::PredictiveDraw> predictive_draws(
    const estimation::ExactPosterior& posterior, const PredictiveDrawing& drawing, std::uint32_t stream);

/// Range over which a curve of predictions is drawn: the range of the measured ratios or
/// frequencies, extended on each side by a tenth of its width, or by a tenth of their size if all
/// are equal; it starts at half the smallest one or above.
/// \param measured  positive, not empty
[[nodiscard]] estimation::Interval curve_range(const std::vector<double>& measured);

/// An end of a marginal at which it is cut off.
struct CutOff {
  /// Parameter whose marginal is cut off.
  friction::Parameter parameter;
  /// Bound in the unit of the parameter.
  double bound;
};
/// The ends at which the prior or the limit of continuous motion cuts the posterior off: the
/// density there exceeds a tenth of its maximum.
[[nodiscard]] std::vector<CutOff> cut_offs(const estimation::ExactPosterior& posterior);

/// A measured quantity and its prediction.
struct MeasurementPrediction {
  /// Phase, turned to lie closest to the median, deg; or nominal frequency ratio.
  double observed;
  /// Predicted from all measurements.
  estimation::PredictiveBand band;
  /// P(new value < observed), from all measurements.
  double probability;
  /// The same from all other measurements; NaN where there are none.
  double left_out;
};

/// Predictions for one row of measurements.
struct RowPrediction {
  /// Phase at the measured frequency ratio.
  MeasurementPrediction phase;
  /// Nominal ratio at the driving frequency.
  MeasurementPrediction ratio;
};

/// Function that returns the posterior given measurements.
using PosteriorOf = std::function<estimation::ExactPosterior(const friction::Observations&)>;

/// Predictions of all rows: from draws of the posterior given all rows, and from the posterior
/// given all rows but the predicted one, which is computed anew.
/// \param draws  draws from the posterior given all rows, not empty
/// \throws as posterior_of and estimation::phase_band
[[nodiscard]] std::vector<RowPrediction> predict_rows(const friction::Observations& measured,
                                                      const std::vector<estimation::PredictiveDraw>& draws,
                                                      const PosteriorOf& posterior_of,
                                                      const friction::Physics& physics,
                                                      const PredictiveDrawing& drawing);

/// How many measurements lie in the central 95 % of their predictive distributions.
struct Coverage {
  /// Measurements inside.
  long inside;
  /// Measurements that have a prediction.
  long measurements;
  /// Binomial probability that at most `inside` of `measurements` independent ones do.
  double probability;
};
/// \param probabilities  as in MeasurementPrediction; NaN for measurements without a prediction
[[nodiscard]] Coverage coverage_95(const std::vector<double>& probabilities);

}  // namespace replication
