// Figure 2: phase angle of the response over the frequency ratio (Eq. 21) for the stated friction
// force and for the one that least squares fits to the observations, and along Den Hartog's
// boundary of continuous motion (Eq. 18), where phi = phi_lim(r). The numerical data of Table 1
// stand beside them in the figure.

#include <cmath>

#include "estimation/least_squares.hpp"
#include "inputs.hpp"
#include "replication/model_checks.hpp"

using namespace experiments;

int main(int argc, char** argv) {
  CLI::App app("Phase angle over the frequency ratio, and Den Hartog's boundary (Figure 2).",
               "fig2_phase_angle");
  Report report(app);
  std::string output;
  PhysicsOptions physics;
  InputFiles inputs;
  double friction_force = 1.086;
  constexpr double lowest = 0.05, highest = 2.0;
  long points = 1951;
  add_output(app, output,
             "CSV: frequency_ratio, phase_deg (nan beyond the limit), boundary_phase_deg, limit_force_ratio; "
             "phase_fitted_deg and fitted_force_n by least squares");
  app.add_option("--friction-force", friction_force, "F_mu, N")->transform(non_negative());
  app.add_option("--points", points, "Points of the curves")->transform(count(2, 1000000));
  inputs.add_observations_to(app);
  physics.add_to(app);

  return report.run(argc, argv, [&] {
    const auto reading = physics.reading();
    const auto fit = estimation::fit_least_squares(read_observations(inputs.observations), reading.physics);
    const double fitted_force = std::stod(digits(fit.friction_force.estimate, 6));  // of Ceres
    auto csv = open_csv(output, {"frequency_ratio", "phase_deg", "boundary_phase_deg", "limit_force_ratio",
                                 "phase_fitted_deg", "fitted_force_n"});
    double continuous_from = highest;
    double smallest_limit = std::numeric_limits<double>::infinity();
    for (const auto& p :
         replication::phase_curves(lowest, highest, points, friction_force, fitted_force, reading.physics)) {
      if (!std::isnan(p.phase_deg)) {
        continuous_from = std::min(continuous_from, p.frequency_ratio);
      }
      if (p.frequency_ratio >= 0.6) {
        smallest_limit = std::min(smallest_limit, p.limit_force_ratio);
      }
      csv.row(p.frequency_ratio, p.phase_deg, p.boundary_phase_deg, p.limit_force_ratio, p.phase_fitted_deg,
              fitted_force);
    }
    io::commit_all(csv);
    report("F_mu = {} N (force ratio {:.4f}): continuous motion from r = {:.3f} on\n", friction_force,
           friction_force / reading.physics.driving_force_n, continuous_from);
    report("smallest limit of the force ratio for r >= 0.6: {:.4f}\n", smallest_limit);
  });
}
