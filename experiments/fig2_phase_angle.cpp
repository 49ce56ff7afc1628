// Figure 2: phase angle of the response over the frequency ratio (Eq. 21) for the stated friction force and for the
// one that least squares fits to the observations, and along Den Hartog's boundary of continuous motion (Eq. 18), where
// phi = phi_lim(r). The numerical data of Table 1 stand beside them in the figure.

#include <cmath>

#include "estimation/least_squares.hpp"
#include "inputs.hpp"
#include "statistics/summary.hpp"

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
    for (const double r : statistics::evenly_spaced(lowest, highest, points)) {
      if (friction::is_singular_ratio(r)) {
        continue;
      }
      const auto c = friction::response_constants(r, reading.physics);
      const double phase = friction::phase_deg(c, friction_force / reading.physics.driving_force_n);
      if (!std::isnan(phase) && r < continuous_from) {
        continuous_from = r;
      }
      smallest_limit = std::min(smallest_limit, r >= 0.6 ? c.limit_force_ratio : smallest_limit);
      csv.row(r, phase, friction::phase_deg(c, c.limit_force_ratio), c.limit_force_ratio,
              friction::phase_deg(c, fitted_force / reading.physics.driving_force_n), fitted_force);
    }
    io::commit_all(csv);
    report("F_mu = {} N (force ratio {:.4f}): continuous motion from r = {:.3f} on\n", friction_force,
           friction_force / reading.physics.driving_force_n, continuous_from);
    report("smallest limit of the force ratio for r >= 0.6: {:.4f}\n", smallest_limit);
  });
}
