// The deterministic baseline: least squares with Ceres, of the phase angles in the friction force
// and of the nominal frequency ratios in the natural frequency, with maximum-likelihood noise
// levels. What the samplers' posteriors stand beside in Figure 3.
//
// Data: Table 1 as printed, or the reader's own measurements.

#include "estimation/least_squares.hpp"
#include "inputs.hpp"

using namespace experiments;

namespace {

void report_fit(const Report& report, const char* name, const char* unit, const estimation::BlockFit& fit) {
  report("{} = {:.6g} {} +- {} (noise as given, {:.4g}) +- {} (noise as fitted, {})\n", name, fit.estimate,
         unit, or_undefined("{:.3g}", fit.standard_error), fit.noise_given,
         or_undefined("{:.3g}", fit.standard_error_ml), or_undefined("{:.4g}", fit.noise_ml));
  if (fit.fitted_noise != estimation::FittedNoise::determined) {
    report("  the fitted noise is undefined: {}\n", describe(fit.fitted_noise));
  }
  report("  chi^2 = {:.3f} on {} {}, reduced {}; {} iterations; {} of {} starts agree, {} {}{}\n",
         fit.chi_squared, fit.residuals.size(), fit.residuals.size() == 1 ? "observation" : "observations",
         or_undefined("{:.3f}", fit.reduced_chi_squared), fit.iterations, fit.agreed, fit.starts,
         fit.distinct_minima, fit.distinct_minima == 1 ? "minimum" : "local minima",
         fit.at_bound ? "; AT A BOUND" : "");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Ceres least-squares fit of friction force and natural frequency.", "least_squares_baseline");
  Report report(app);
  std::string output;
  InputFiles inputs;
  PhysicsOptions physics;
  estimation::LeastSquaresOptions options;
  add_output(app, output,
             "CSV: one row for each parameter with estimate, standard errors, chi^2 and how the fit went");
  inputs.add_observations_to(app);
  app.add_option("--phase-noise", options.phase_noise_deg, "sigma of the phase angle, deg")
      ->transform(positive());
  app.add_option("--frequency-ratio-noise", options.frequency_ratio_noise, "sigma of the frequency ratio")
      ->transform(positive());
  physics.add_to(app);

  return report.run(argc, argv, [&] {
    const auto reading = physics.reading();
    const auto observations = read_observations(inputs.observations);
    auto csv = open_csv(
        output, {"parameter", "estimate", "standard_error", "standard_error_ml", "sigma_given", "chi_squared",
                 "reduced_chi_squared", "iterations", "starts", "agreed", "distinct_minima", "at_bound"});
    const auto fit = estimation::fit_least_squares(observations, reading.physics, options);
    report_fit(report, "F_mu", "N", fit.friction_force);
    report_fit(report, "omega_n", "Hz", fit.natural_frequency);
    report("largest log-likelihood {}\n", or_undefined("{:.4f}", fit.log_likelihood()));
    const auto write = [&](const std::string& location, const std::string& noise,
                           const estimation::BlockFit& block) {
      csv.row(location, digits(block.estimate), digits(block.standard_error), digits(block.standard_error_ml),
              block.noise_given, digits(block.chi_squared), digits(block.reduced_chi_squared),
              block.iterations, block.starts, block.agreed, block.distinct_minima, block.at_bound ? 1 : 0);
      csv.row(noise, digits(block.noise_ml), digits(block.standard_error_of_noise(block.noise_given)),
              digits(block.standard_error_of_noise(block.noise_ml)), block.noise_given,
              digits(block.chi_squared), digits(block.reduced_chi_squared), block.iterations, block.starts,
              block.agreed, block.distinct_minima, block.at_bound ? 1 : 0);
    };
    write(parameter_columns[0], parameter_columns[2], fit.friction_force);
    write(parameter_columns[1], parameter_columns[3], fit.natural_frequency);
    io::commit_all(csv);
  });
}
