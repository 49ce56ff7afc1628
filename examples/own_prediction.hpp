/// \file
/// The measurements of a model of one's own in what its posterior predicts for them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "own_models.hpp"
#include "run.hpp"
#include "statistics/predictive_band.hpp"

namespace examples {

/// A measurement, and the band that its posterior predictive distribution gives.
struct PredictedMeasurement {
  std::string quantity;    ///< its name in Measurements::observed
  std::size_t number = 0;  ///< among those of the quantity, from 1
  std::string label;       ///< of ComparedOutputs, or the number
  double observed = 0.0;   ///< in its unit, as the band
  statistics::PredictiveBand band;
};

/// All measurements, in the order of Measurements::observed.
struct Prediction {
  std::vector<PredictedMeasurement> measurements;
  tmcmc::Index evaluations = 0;  ///< of the model, for this alone
};

/// Evaluates the model at equally weighted draws of all runs, each of which counts the same: evenly spaced in the sum of the weights
/// (statistics::equal_rows), so that they depend on the runs alone. A point that is drawn several times is evaluated once; calls have at
/// most 100 points.
/// \param model  with outputs
/// \param draws  at least 1
/// \param begin  told the number of evaluations before the first
/// \throws what the model throws; errors::InvalidValue for an output that is not finite; io::Interrupted
[[nodiscard]] Prediction predict(const std::vector<tmcmc::Result>& runs, const Model& model,
                                 tmcmc::Index draws, const std::function<void(tmcmc::Index)>& begin);

/// Columns of predictive.csv, and its rows: each measurement with its band, and the same less the median in standard deviations of a
/// new measurement (the columns that end in _score).
[[nodiscard]] const std::vector<std::string>& prediction_columns();
void write_prediction(experiments::OptionalCsv& csv, const Prediction& prediction);

/// Prints how many measurements lie in their bands, and what it has cost.
void print_prediction(const experiments::Report& report, const Prediction& prediction);

}  // namespace examples
