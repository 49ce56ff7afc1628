// Sampler and oscillator as installed: phases of a known friction force give it back.
#include <cmath>
#include <cstdio>

#include "friction/likelihood.hpp"
#include "friction/time_integration.hpp"
#include "tmcmc/sampler.hpp"

namespace {

int failures = 0;

void check(bool condition, const char* what) {
  if (!condition) {
    std::printf("FAIL: %s\n", what);
    ++failures;
  }
}

}  // namespace

int main() {
  constexpr double friction_force_n = 1.0;
  constexpr double natural_frequency_hz = 3.0;
  const friction::Physics physics;
  friction::Observations observations;
  for (const double ratio : {0.7, 0.8, 0.9, 1.1, 1.2, 1.3}) {
    const double force_ratio = friction_force_n / physics.driving_force_n;
    const double phase = friction::phase_deg(friction::response_constants(ratio, physics), force_ratio);
    check(std::fabs(friction::integrate_steady_response(ratio, force_ratio).phase_deg - phase) < 1e-6,
          "closed form and integration in time agree");
    observations.nominal_ratio.push_back(ratio);
    observations.measured_ratio.push_back(ratio);
    observations.driving_frequency_hz.push_back(ratio * natural_frequency_hz);
    observations.phase_deg.push_back(phase);
  }
  const friction::Likelihood likelihood(observations, physics);
  // Noise levels known, so that the posteriors of force and frequency are close to normal around
  // the truth.
  const tmcmc::LogLikelihood log_likelihood = [&](const auto& points, auto values) {
    Eigen::MatrixXd full(points.rows(), friction::parameter_count);
    full.col(friction::friction_force) = points.col(0);
    full.col(friction::natural_frequency) = points.col(1);
    full.col(friction::phase_noise).setConstant(0.5);
    full.col(friction::frequency_ratio_noise).setConstant(0.002);
    likelihood(full, values);
  };
  const tmcmc::Problem problem{log_likelihood, {Eigen::Vector2d(0.1, 2.0), Eigen::Vector2d(2.0, 4.0)}};
  const tmcmc::Result result = tmcmc::run(problem, tmcmc::recommended_options(), {.seed = 1});
  const auto n = static_cast<double>(result.weights.size());  // the weights have a mean of 1
  const Eigen::RowVector2d mean = result.weights.transpose() * result.final.points / n;
  const Eigen::RowVector2d sd =
      (result.weights.transpose() * (result.final.points.rowwise() - mean).array().square().matrix() / n)
          .array()
          .sqrt()
          .matrix();
  check(result.stop == tmcmc::StopReason::completed, "the run reaches the posterior");
  check(result.diagnostics.warnings.empty(), "no warnings");
  check(std::fabs(mean[0] - friction_force_n) < 0.5 * sd[0], "mean of the friction force");
  check(std::fabs(mean[1] - natural_frequency_hz) < 0.5 * sd[1], "mean of the natural frequency");
  std::printf("F_mu %.4g +- %.2g N, omega_n %.5g +- %.2g Hz\n", mean[0], sd[0], mean[1], sd[1]);
  return failures == 0 ? 0 : 1;
}
