#include "fit.hpp"

#include <ceres/jet.h>
#include <ceres/tiny_solver.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "friction/angle.hpp"
#include "friction/likelihood.hpp"

namespace site {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Residuals of the phases, deg, and their derivatives in F_mu; NaN where the mass sticks, which
/// TinySolver refuses as a step.
struct PhaseResiduals {
  using Scalar = double;
  enum { NUM_RESIDUALS = Eigen::Dynamic, NUM_PARAMETERS = 1 };

  std::vector<friction::ResponseConstants> constants;
  std::vector<double> observed_deg;
  double driving_force_n;

  [[nodiscard]] int NumResiduals() const { return static_cast<int>(constants.size()); }

  bool operator()(const double* force_n, double* residuals, double* jacobian) const {
    using Jet = ceres::Jet<double, 1>;
    for (std::size_t i = 0; i < constants.size(); ++i) {
      const Jet ratio = Jet(*force_n, 0) / driving_force_n;
      const Jet residual =
          friction::angle_residual_deg(observed_deg[i], friction::phase_deg(constants[i], ratio));
      residuals[i] = residual.a;
      if (jacobian != nullptr) {
        jacobian[i] = residual.v[0];
      }
    }
    return true;
  }
};

/// Noise and standard error; `slope` is the square root of the sum of the squared derivatives.
void add_noise(Fit& fit, double sum_of_squares, double slope, const std::vector<double>& observed) {
  constexpr double rounding = 1e-9;
  double largest = 0.0;
  for (const double value : observed) {
    largest = std::max(largest, std::fabs(value));
  }
  const double noise = std::sqrt(sum_of_squares / static_cast<double>(observed.size()));
  fit.noise = observed.size() > 1 && noise > rounding * largest ? noise : not_a_number;
  fit.standard_error = slope > 0.0 ? fit.noise / slope : not_a_number;
}

}  // namespace

Fit fit_friction_force(const friction::Observations& observations, const friction::Physics& physics) {
  const friction::Likelihood likelihood(observations, physics);  // validates
  PhaseResiduals residuals{{}, observations.phase_deg, physics.driving_force_n};
  for (const double ratio : observations.measured_ratio) {
    residuals.constants.push_back(friction::response_constants(ratio, physics));
  }
  const double limit =
      likelihood.limit_friction_force_n() * (1.0 - 4.0 * std::numeric_limits<double>::epsilon());
  Fit fit;
  double least = std::numeric_limits<double>::infinity();
  const auto consider = [&](double force_n) {
    const double misfit = likelihood.phase_misfit(force_n);
    if (misfit < least) {
      least = misfit;
      fit.estimate = force_n;
    }
  };
  consider(0.0);
  consider(limit);
  constexpr int starts = 8;
  for (int i = 0; i < starts; ++i) {
    ceres::TinySolver<PhaseResiduals> solver;
    solver.options.max_num_iterations = 200;
    solver.options.gradient_tolerance = 1e-13;
    solver.options.parameter_tolerance = 1e-13;
    solver.options.function_tolerance = 0.0;
    ceres::TinySolver<PhaseResiduals>::Parameters force_n;
    force_n[0] = limit * (i + 0.5) / starts;
    solver.Solve(residuals, &force_n);
    consider(std::clamp(force_n[0], 0.0, limit));
  }
  constexpr double same = 1e-7;
  fit.at_bound = fit.estimate <= same * limit || fit.estimate >= limit * (1.0 - same);
  std::vector<double> values(observations.size()), slopes(observations.size());
  residuals(&fit.estimate, values.data(), slopes.data());
  double squares = 0.0;
  for (const double slope : slopes) {
    squares += slope * slope;
  }
  add_noise(fit, least, std::sqrt(squares), observations.phase_deg);
  return fit;
}

Fit fit_natural_frequency(const friction::Observations& observations) {
  double product = 0.0, square = 0.0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const double omega_b = observations.driving_frequency_hz[i];
    product += omega_b * observations.nominal_ratio[i];
    square += omega_b * omega_b;
  }
  Fit fit;
  fit.estimate = square / product;
  double sum = 0.0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const double residual =
        observations.nominal_ratio[i] - observations.driving_frequency_hz[i] / fit.estimate;
    sum += residual * residual;
  }
  add_noise(fit, sum, std::sqrt(square) / (fit.estimate * fit.estimate), observations.nominal_ratio);
  return fit;
}

}  // namespace site
