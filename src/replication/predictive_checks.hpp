/// \file
/// Draws of the posterior predictive distribution of the rig, and how the measurements lie in it.
#pragma once

#include <functional>
#include <vector>

#include "estimation/exact_posterior.hpp"
#include "estimation/posterior_predictive.hpp"

namespace replication {

/// How draws are made.
struct PredictiveDrawing {
  std::uint64_t seed = 1;            ///< of the random stream
  long draws = 10000;                ///< of each posterior
  int threads = 1;                   ///< over the draws, which do not depend on it
  std::function<void()> observer{};  ///< called once after each posterior was drawn from; may be empty
};

/// Independent draws of a posterior, each with the errors of a new measurement.
/// \param stream  of random numbers: one for each posterior
[[nodiscard]] std::vector<estimation::PredictiveDraw> predictive_draws(
    const estimation::ExactPosterior& posterior, const PredictiveDrawing& drawing, std::uint32_t stream);

/// Where a curve of predictions is drawn: the range of the measured places and a tenth of its width beyond on each side, or of
/// their size if they are all one; from half the smallest on at least.
/// \param measured  positive, not empty
[[nodiscard]] estimation::Interval curve_range(const std::vector<double>& measured);

/// An end of a marginal.
struct CutOff {
  friction::Parameter parameter;  ///< whose marginal it is
  double bound;                   ///< in the unit of the parameter
};
/// The ends at which the prior or the limit of continuous motion cuts the posterior off: its density there is more than a
/// tenth of the largest.
[[nodiscard]] std::vector<CutOff> cut_offs(const estimation::ExactPosterior& posterior);

/// A measured quantity and what is predicted for it.
struct MeasurementPrediction {
  double observed;  ///< the phase as the turn closest to the median, deg; the nominal frequency ratio
  estimation::PredictiveBand band;  ///< from all measurements
  double probability;               ///< of less than what was observed, from all measurements
  double left_out;                  ///< the same from all the others; NaN where there are none
};

/// A row of measurements.
struct RowPrediction {
  MeasurementPrediction phase;  ///< at the measured frequency ratio
  MeasurementPrediction ratio;  ///< at the driving frequency
};

/// The posterior of measurements.
using PosteriorOf = std::function<estimation::ExactPosterior(const friction::Observations&)>;

/// Predictions of all rows: from draws of their posterior, and from the posterior of all rows but the one, which is computed
/// anew.
/// \param draws  of the posterior of all rows, not empty
/// \throws as posterior_of and estimation::phase_band
[[nodiscard]] std::vector<RowPrediction> predict_rows(const friction::Observations& measured,
                                                      const std::vector<estimation::PredictiveDraw>& draws,
                                                      const PosteriorOf& posterior_of,
                                                      const friction::Physics& physics,
                                                      const PredictiveDrawing& drawing);

/// How many measurements lie in the central 95 % of what is predicted for them.
struct Coverage {
  long inside;         ///< of them
  long measurements;   ///< that have a prediction
  double probability;  ///< that so few or fewer of as many independent ones do, by the binomial distribution
};
/// \param probabilities  as MeasurementPrediction has them; NaN for none
[[nodiscard]] Coverage coverage_95(const std::vector<double>& probabilities);

}  // namespace replication
