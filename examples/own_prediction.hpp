/// \file
/// The measurements of a user-defined model within their posterior predictive distributions.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "command_line/report.hpp"
#include "own_models.hpp"
#include "statistics/predictive_band.hpp"

namespace examples {

/// A measurement, and the band of its posterior predictive distribution.
struct PredictedMeasurement {
  /// Name of the quantity in Measurements::observed.
  std::string quantity;
  /// Number among the measurements of the quantity, from 1.
  std::size_t number = 0;
  /// Label in ComparedOutputs, or the number.
  std::string label;
  /// Measured value, in its unit, as is the band.
  double observed = 0.0;
  statistics::PredictiveBand band;
};

/// All measurements, in the order of Measurements::observed.
struct Prediction {
  std::vector<PredictedMeasurement> measurements;
  /// Evaluations of the model for the prediction alone.
  tmcmc::Index evaluations = 0;
};

/// Evaluates the model at equally weighted draws of all runs, each of which has the same weight:
/// evenly spaced in the cumulative weight (statistics::equal_rows), so that they depend on the runs
/// alone. A point that is drawn several times is evaluated once; calls have at most 100 points.
/// \param model  a model with outputs
/// \param draws  number of draws, at least 1
/// \param begin  called with the number of evaluations before the first one
/// \throws any exception of the model; errors::InvalidValue for an output that is not finite;
///         io::Interrupted
[[nodiscard]] Prediction predict(const std::vector<tmcmc::Result>& runs, const Model& model,
                                 tmcmc::Index draws, const std::function<void(tmcmc::Index)>& begin);

/// Columns of predictive.csv, and its rows: each measurement with its band, and the same less the
/// median in standard deviations of a new measurement (the columns that end in _score).
[[nodiscard]] const std::vector<std::string>& prediction_columns();
void write_prediction(command_line::OptionalCsv& csv, const Prediction& prediction);

/// Prints how many measurements lie in their bands, and the cost of the prediction.
void print_prediction(const command_line::Report& report, const Prediction& prediction);

}  // namespace examples
