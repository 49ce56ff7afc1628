// What the posterior predicts for new measurements of the rig: the phase angle over the frequency ratio (Eqs. 21 and 23) and the
// frequency ratio over the driving frequency (Eq. 24), with central 95 % bands of the model and of a measurement with noise. And how
// the measurements lie in them, each also predicted from the others alone. The draws are exact (estimation::ExactPosterior).
//
// Data: Table 1 and the prior of Table 2 as printed in Lye and Marino (ESREL 2023), or the reader's own.

#include <algorithm>
#include <cmath>

#include "inputs.hpp"
#include "io/interrupt.hpp"
#include "replication/predictive_checks.hpp"

using namespace experiments;

namespace {

/// The range of the values with a tenth of its width beyond on each side, or of their size if they are all one.
estimation::Interval drawn_range(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double margin = 0.1 * (*high > *low ? *high - *low : *high);
  return {std::max(*low - margin, 0.5 * *low), *high + margin};
}

std::vector<std::string> with_band(std::vector<std::string> columns, const std::vector<std::string>& more) {
  for (const char* name : {"median", "model_low", "model_high", "low", "high", "share"}) {
    columns.emplace_back(name);
  }
  columns.insert(columns.end(), more.begin(), more.end());
  return columns;
}

std::vector<std::string> cells(const estimation::PredictiveBand& b) {
  return {digits(b.median, 8), digits(b.model_low, 8), digits(b.model_high, 8),
          digits(b.low, 8),    digits(b.high, 8),      digits(b.share, 8)};
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

/// A posterior that the prior cuts off: its density at a bound is a tenth of the largest or more.
void report_bounds(const Report& report, const estimation::ExactPosterior& posterior,
                   const tmcmc::Prior& prior) {
  for (std::size_t p = 0; prior.is_box() && p < parameter_columns.size(); ++p) {
    const auto& marginal = posterior.marginal(static_cast<friction::Parameter>(p));
    double largest = 0.0;
    for (const double x : marginal.nodes()) {
      largest = std::max(largest, marginal.density(x));
    }
    for (const double bound : {marginal.lower(), marginal.upper()}) {
      if (marginal.density(bound) > 0.1 * largest) {
        report(
            "warning: the prior or the limit of continuous motion cuts the posterior of {} off at {:.4g}\n",
            parameter_columns[p], bound);
      }
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Posterior predictive bands of phase angle and frequency ratio, and the measurements in them.",
               "posterior_predictive");
  Report report(app);
  InputFiles inputs;
  PhysicsOptions physics;
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
  inputs.add_observations_to(app);
  inputs.add_prior_to(app);
  physics.add_to(app);

  return report.run(argc, argv, [&] {
    const auto reading = physics.reading();
    const auto measured = read_observations(inputs.observations);
    const auto prior = prior_for(inputs, reading);
    auto csv = open_csv(output, with_band({"frequency_ratio"}, {"boundary_phase_deg"}));
    auto frequencies = open_csv(frequency_output, with_band({"driving_frequency_hz"}, {}));
    auto predictions = open_csv(
        observations_output, with_band({"quantity", "index", "x", "observed"}, {"probability", "left_out"}));
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

    const auto on_grid = [&](const estimation::Interval& range, const auto& write) {
      for (long i = 0; i < points; ++i) {
        write(range.lower + range.width() * static_cast<double>(i) / static_cast<double>(points - 1));
      }
    };
    on_grid(drawn_range(measured.measured_ratio), [&](double r) {
      if (!friction::is_singular_ratio(r)) {
        const auto c = friction::response_constants(r, reading.physics);
        csv.row(r, cells(estimation::phase_band(draws, r, reading.physics)),
                digits(friction::phase_deg(c, c.limit_force_ratio)));
      }
    });
    on_grid(drawn_range(measured.driving_frequency_hz),
            [&](double f) { frequencies.row(f, cells(estimation::ratio_band(draws, f))); });
    const auto rows = replication::predict_rows(measured, draws, posterior_of, reading.physics, drawing);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto write = [&](const char* quantity, double x, const replication::MeasurementPrediction& p) {
        predictions.row(quantity, i + 1, x, digits(p.observed, 8), cells(p.band), digits(p.probability, 8),
                        digits(p.left_out, 8));
      };
      write("phase_deg", measured.measured_ratio[i], rows[i].phase);
      write("frequency_ratio", measured.driving_frequency_hz[i], rows[i].ratio);
    }
    report("{} (reading {}, driving force {} N, {} draws)\n", inputs.observations, physics.reading_name,
           reading.physics.driving_force_n, drawing.draws);
    report("{:<16} {:>17} {:>29} {:>24}\n", "inside 95 %", "from all", "from the others",
           "P(so few or fewer)");
    report_coverage(report, "phase angle", rows, &replication::RowPrediction::phase);
    report_coverage(report, "frequency ratio", rows, &replication::RowPrediction::ratio);
    report_bounds(report, posterior, prior);
    io::commit_all(csv, frequencies, predictions);
  });
}
