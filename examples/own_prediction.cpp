#include "own_prediction.hpp"

#include <algorithm>

#include "io/interrupt.hpp"
#include "statistics/posterior_summary.hpp"

namespace examples {

using tmcmc::Index;

namespace {

constexpr Index points_of_a_call = 100;  // as the calls of the runs, for which a time-out was chosen

/// Equally weighted draws: the distinct ones, and for each draw which of them it is.
struct Draws {
  Eigen::MatrixXd points;
  std::vector<Index> rows;
};

Draws draws_of(const std::vector<tmcmc::Result>& runs, Index number) {
  Draws draws{.points = Eigen::MatrixXd(number, runs.front().final.points.cols()), .rows = {}};
  Index different = 0;
  const auto count = static_cast<Index>(runs.size());
  for (Index r = 0; r < count; ++r) {
    const auto& run = runs[static_cast<std::size_t>(r)];
    const Index share = number * (r + 1) / count - number * r / count;
    for (const Index row : share > 0 ? statistics::equal_rows(run, share) : std::vector<Index>()) {
      const auto point = run.final.points.row(row);
      if (different == 0 || draws.points.row(different - 1) != point) {
        draws.points.row(different++) = point;
      }
      draws.rows.push_back(different - 1);
    }
  }
  draws.points.conservativeResize(different, Eigen::NoChange);
  return draws;
}

std::size_t size_of(const Measurements& measurements) {
  std::size_t size = 0;
  for (const auto& [name, values] : measurements.observed) {
    size += values.size();
  }
  return size;
}

}  // namespace

Prediction predict(const std::vector<tmcmc::Result>& runs, const Model& model, Index number,
                   const std::function<void(Index)>& begin) {
  const Draws draws = draws_of(runs, number);
  const auto size = static_cast<Index>(size_of(model.measurements));
  Eigen::MatrixXd outputs(draws.points.rows(), size), noise(draws.points.rows(), size);
  begin(draws.points.rows());
  for (Index first = 0; first < draws.points.rows(); first += points_of_a_call) {
    io::stop_if_interrupted();
    const Index rows = std::min(points_of_a_call, draws.points.rows() - first);
    model.compared.outputs(draws.points.middleRows(first, rows), outputs.middleRows(first, rows));
  }
  for (Index i = 0; i < outputs.rows(); ++i) {
    noise.row(i) = model.compared.noise(draws.points.row(i), outputs.row(i));
  }
  Prediction result{.measurements = {}, .evaluations = draws.points.rows()};
  const auto& labels = model.compared.labels;
  std::vector<double> of_model(draws.rows.size()), of_noise(draws.rows.size());
  Index column = 0;
  for (const auto& [quantity, observed] : model.measurements.observed) {
    for (std::size_t k = 0; k < observed.size(); ++k, ++column) {
      io::stop_if_interrupted();
      for (std::size_t i = 0; i < draws.rows.size(); ++i) {
        of_model[i] = outputs(draws.rows[i], column);
        of_noise[i] = noise(draws.rows[i], column);
      }
      result.measurements.push_back(
          {.quantity = quantity,
           .number = k + 1,
           .label = labels.empty() ? std::to_string(k + 1) : labels[static_cast<std::size_t>(column)],
           .observed = observed[k],
           .band = statistics::predictive_band(of_model, of_noise, observed[k])});
    }
  }
  return result;
}

const std::vector<std::string>& prediction_columns() {
  static const std::vector<std::string> columns = {
      "quantity",         "number",    "label",     "observed",          "median",         "model_low",
      "model_high",       "low",       "high",      "probability_below", "observed_score", "model_low_score",
      "model_high_score", "low_score", "high_score"};
  return columns;
}

void write_prediction(command_line::OptionalCsv& csv, const Prediction& prediction) {
  for (const auto& [quantity, number, label, observed, band] : prediction.measurements) {
    std::vector<std::string> cells{command_line::digits(band.median)};
    const double ends[] = {band.model.low, band.model.high, band.measurement.low, band.measurement.high};
    for (const double end : ends) {
      cells.push_back(command_line::digits(end));
    }
    cells.push_back(command_line::digits(band.probability_below));
    cells.push_back(command_line::digits((observed - band.median) / band.standard_deviation));
    for (const double end : ends) {
      cells.push_back(command_line::digits((end - band.median) / band.standard_deviation));
    }
    csv.row(quantity, number, label, observed, cells);
  }
}

void print_prediction(const command_line::Report& report, const Prediction& prediction) {
  const auto inside =
      std::count_if(prediction.measurements.begin(), prediction.measurements.end(), [](const auto& m) {
        return m.observed >= m.band.measurement.low && m.observed <= m.band.measurement.high;
      });
  report(
      "posterior predictive: {} of {} measurements in the central 95 % of a new one; {} more evaluations\n",
      inside, prediction.measurements.size(), prediction.evaluations);
}

}  // namespace examples
