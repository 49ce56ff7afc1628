// What the posterior predicts for new measurements of the rig: the phase angle over the frequency
// ratio (Eqs. 21 and 23) and the frequency ratio over the driving frequency (Eq. 24), with central
// 95 % bands of the model and of a measurement with noise. And how the measurements lie in them,
// each also predicted from the others alone. The draws are exact (estimation::ExactPosterior).
//
// Data: Table 1 and the prior of Table 2 as printed in Lye and Marino (ESREL 2023), or the reader's
// own.

#include "inputs.hpp"
#include "io/interrupt.hpp"
#include "replication/predictive_checks.hpp"
#include "statistics/summary.hpp"

using namespace experiments;

namespace {

/// Columns of a table of bands: the given columns, the columns of a band, and further columns.
std::vector<std::string> with_band(std::vector<std::string> columns, const std::vector<std::string>& more) {
  for (const char* name : {"median", "model_low", "model_high", "low", "high", "model_low_less_median",
                           "model_high_less_median", "low_less_median", "high_less_median", "share"}) {
    columns.emplace_back(name);
  }
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

std::vector<std::string> cells(const estimation::PredictiveBand& b) {
  std::vector<std::string> texts{digits(b.median, 8)};
  for (const double less : {0.0, b.median}) {
    for (const double end : {b.model_low, b.model_high, b.low, b.high}) {
      texts.push_back(digits(end - less, 8));
    }
  }
  texts.push_back(digits(b.share, 8));
  return texts;
}

void report_coverage(const Report& report, const char* quantity,
                     const std::vector<replication::RowPrediction>& rows,
                     replication::MeasurementPrediction replication::RowPrediction::*member) {
  std::vector<double> probabilities, left_out;
  for (const auto& row : rows) {
    probabilities.push_back((row.*member).probability);
    left_out.push_back((row.*member).left_out);
  }
  const auto all = replication::coverage_95(probabilities);
  report("{:<16} {:>10} of {:>3}", quantity, all.inside, all.measurements);
  const auto others = replication::coverage_95(left_out);
  if (others.measurements > 0) {
    report(" {:>22} of {:>3} {:>24.2g}", others.inside, others.measurements, others.probability);
  }
  report("\n");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Posterior predictive bands of phase angle and frequency ratio, and the measurements in them.",
               "posterior_predictive");
  Report report(app);
  ProblemInputs inputs;
  RunOptions run_options;
  replication::PredictiveDrawing drawing;
  long points = 401;
  std::string output, frequency_output, observations_output;
  add_output(app, output, "CSV: phase angle over the frequency ratio, with bands and Den Hartog's boundary");
  add_output(app, "--frequency-output", frequency_output,
             "CSV: frequency ratio over the driving frequency, with bands");
  add_output(app, "--observations-output", observations_output,
             "CSV: each measurement with its prediction, from all of them and from the others (left_out)");
  app.add_option("--draws", drawing.draws, "Draws of each posterior")->transform(count(40, 10000000));
  app.add_option("--points", points, "Points of each curve")->transform(count(2, 1000000));
  run_options.add_seed_to(app);
  run_options.add_threads_to(app);
  inputs.add_to(app);

  return report.run(argc, argv, [&] {
    const auto reading = inputs.physics.reading();
    const auto measured = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, reading);
    auto csv = open_csv(output, with_band({"frequency_ratio"}, {"boundary_phase_deg"}));
    auto frequencies = open_csv(frequency_output, with_band({"driving_frequency_hz"}, {}));
    auto predictions = open_csv(observations_output,
                                with_band({"quantity", "index", "x", "observed", "observed_less_median"},
                                          {"probability", "left_out"}));
    io::Progress progress("posterior_predictive", measured.size() + 1, !report.quiet());
    drawing.seed = run_options.seed;
    drawing.threads = run_options.study_options().threads;
    drawing.observer = [&] { progress.advance(); };
    const auto posterior_of = [&](const friction::Observations& observations) {
      io::stop_if_interrupted();
      return exact_posterior_for(inputs, friction::Likelihood(observations, reading.physics), prior);
    };
    const auto posterior = posterior_of(measured);
    const auto draws = replication::predictive_draws(posterior, drawing, 0);

    const auto on_grid = [&](const estimation::Interval& range) {
      return statistics::evenly_spaced(range.lower, range.upper, points);
    };
    for (const double r : on_grid(replication::curve_range(measured.measured_ratio))) {
      if (!friction::is_singular_ratio(r)) {
        const auto c = friction::response_constants(r, reading.physics);
        csv.row(r, cells(estimation::phase_band(draws, r, reading.physics)),
                digits(friction::phase_deg(c, c.limit_force_ratio)));
      }
    }
    for (const double f : on_grid(replication::curve_range(measured.driving_frequency_hz))) {
      frequencies.row(f, cells(estimation::ratio_band(draws, f)));
    }
    const auto rows = replication::predict_rows(measured, draws, posterior_of, reading.physics, drawing);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto write = [&](const char* quantity, double x, const replication::MeasurementPrediction& p) {
        predictions.row(quantity, i + 1, x, digits(p.observed, 8), digits(p.observed - p.band.median, 8),
                        cells(p.band), digits(p.probability, 8), digits(p.left_out, 8));
      };
      write("phase_deg", measured.measured_ratio[i], rows[i].phase);
      write("frequency_ratio", measured.driving_frequency_hz[i], rows[i].ratio);
    }
    report("{} (reading {}, driving force {} N, {} draws)\n", inputs.observations,
           inputs.physics.reading_name, reading.physics.driving_force_n, drawing.draws);
    report("{:<16} {:>17} {:>29} {:>24}\n", "inside 95 %", "from all", "from the others",
           "P(so few or fewer)");
    report_coverage(report, "phase angle", rows, &replication::RowPrediction::phase);
    report_coverage(report, "frequency ratio", rows, &replication::RowPrediction::ratio);
    for (const auto& cut :
         prior.is_box() ? replication::cut_offs(posterior) : std::vector<replication::CutOff>()) {
      report("warning: the prior or the limit of continuous motion cuts the posterior of {} off at {:.4g}\n",
             parameter_columns[static_cast<std::size_t>(cut.parameter)], cut.bound);
    }
    io::commit_all(csv, frequencies, predictions);
  });
}
