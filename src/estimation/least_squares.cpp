#include "estimation/least_squares.hpp"

#include <ceres/ceres.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "errors/invalid_value.hpp"
#include "friction/angle.hpp"
#include "friction/likelihood.hpp"

namespace estimation {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

template <class Value>
void require(bool condition, const char* field, Value value, const char* expected) {
  if (!condition) {
    throw errors::InvalidValue(field, value, expected);
  }
}

struct PhaseResidual {
  friction::ResponseConstants constants;
  double driving_force_n;
  double observed_deg;
  double noise_deg;

  template <class T>
  bool operator()(const T* friction_force_n, T* residual) const {
    const T force_ratio = *friction_force_n / driving_force_n;
    *residual =
        friction::angle_residual_deg(observed_deg, friction::phase_deg(constants, force_ratio)) / noise_deg;
    return true;
  }
};

struct RatioResidual {
  double nominal_ratio;
  double driving_frequency_hz;
  double noise;

  template <class T>
  bool operator()(const T* natural_frequency_hz, T* residual) const {
    *residual = (nominal_ratio - driving_frequency_hz / *natural_frequency_hz) / noise;
    return true;
  }
};

/// A problem with one unknown; Ceres keeps the address of x.
struct OneParameterProblem {
  double x = 1.0;
  ceres::Problem problem;

  template <class Residual>
  void add(const Residual& residual) {
    problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Residual, 1, 1>(new Residual(residual)), nullptr,
                             &x);
  }

  void set_bounds(double lower, double upper) {
    problem.SetParameterLowerBound(&x, 0, lower);
    problem.SetParameterUpperBound(&x, 0, upper);
  }

  [[nodiscard]] double standard_error() {
    ceres::CRSMatrix jacobian;
    problem.Evaluate({}, nullptr, nullptr, nullptr, &jacobian);
    // Ceres logs a rank-deficient Jacobian.
    if (std::all_of(jacobian.values.begin(), jacobian.values.end(),
                    [](double d) { return std::fabs(d) < 1e-150; })) {
      return not_a_number;
    }
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::DENSE_SVD;
    options.null_space_rank = 0;
    ceres::Covariance covariance(options);
    double variance = not_a_number;
    const std::vector<std::pair<const double*, const double*>> blocks = {{&x, &x}};
    if (!covariance.Compute(blocks, &problem) || !covariance.GetCovarianceBlock(&x, &x, &variance)) {
      return not_a_number;
    }
    return std::sqrt(variance);
  }
};

struct Minimum {
  double x;
  double cost;
  int iterations;
  std::string termination;
};

Minimum minimise(OneParameterProblem& block, double start, int max_iterations, bool& converged) {
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.dense_linear_algebra_library_type = ceres::EIGEN;
  solver.function_tolerance = 1e-15;
  solver.parameter_tolerance = 1e-12;
  solver.gradient_tolerance = 1e-14;
  solver.max_num_iterations = max_iterations;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  block.x = start;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &block.problem, &summary);
  converged = summary.termination_type == ceres::CONVERGENCE;
  return {block.x, summary.final_cost, static_cast<int>(summary.iterations.size()) - 1, summary.message};
}

/// Relative error of an estimate: residuals below this fraction of the observed values are
/// rounding.
constexpr double estimate_error = 1e-9;

/// Everything but the observations' own quantities: minimum over the starts, bookkeeping, standard
/// error.
BlockFit solve(OneParameterProblem& block, double lower, double upper, double noise,
               const std::vector<double>& observed, const char* name, const LeastSquaresOptions& options) {
  const std::size_t count = observed.size();
  BlockFit fit;
  fit.lower = lower;
  fit.upper = upper;
  fit.noise_given = noise;
  fit.starts = options.starts;
  block.set_bounds(lower, upper);
  std::vector<Minimum> minima;
  for (int i = 0; i < options.starts; ++i) {
    bool converged = false;
    const double fraction = (i + 0.5) / options.starts;
    minima.push_back(minimise(block, lower + fraction * (upper - lower), options.max_iterations, converged));
    if (!converged) {
      minima.pop_back();
      ++fit.failed;
    }
  }
  if (minima.empty()) {
    throw std::runtime_error(std::string(name) + ": least squares did not converge from any of " +
                             std::to_string(options.starts) + " starts");
  }
  const double same = options.agreement_tolerance * (upper - lower);
  const auto best = std::min_element(minima.begin(), minima.end(),
                                     [](const Minimum& a, const Minimum& b) { return a.cost < b.cost; });
  fit.estimate = best->x;
  fit.iterations = best->iterations;
  fit.termination = best->termination;
  fit.at_bound = best->x - lower <= same || upper - best->x <= same;
  fit.agreed = static_cast<int>(std::count_if(minima.begin(), minima.end(), [&](const Minimum& other) {
    return std::fabs(other.x - fit.estimate) <= same;
  }));
  std::sort(minima.begin(), minima.end(), [](const Minimum& a, const Minimum& b) { return a.x < b.x; });
  for (std::size_t i = 0; i < minima.size(); ++i) {
    fit.distinct_minima += i == 0 || minima[i].x - minima[i - 1].x > same ? 1 : 0;
  }

  block.x = fit.estimate;
  block.problem.Evaluate({}, nullptr, &fit.residuals, nullptr, nullptr);
  for (double& residual : fit.residuals) {
    residual *= noise;
    fit.sum_of_squares += residual * residual;
  }
  const auto n = static_cast<double>(count);
  const double residual = std::sqrt(fit.sum_of_squares / n);
  double largest = 0.0;
  for (const double value : observed) {
    largest = std::max(largest, std::fabs(value));
  }
  fit.fitted_noise = count == 1                             ? FittedNoise::one_observation
                     : residual <= estimate_error * largest ? FittedNoise::perfect_fit
                                                            : FittedNoise::determined;
  fit.noise_ml = fit.fitted_noise == FittedNoise::determined ? residual : not_a_number;
  fit.standard_error = block.standard_error();
  fit.standard_error_ml = fit.standard_error * (fit.noise_ml / noise);
  fit.chi_squared = fit.sum_of_squares / (noise * noise);
  fit.reduced_chi_squared = count > 1 ? fit.chi_squared / (n - 1.0) : not_a_number;
  fit.log_likelihood = -n * (0.5 * std::log(2.0 * std::numbers::pi) + std::log(fit.noise_ml) + 0.5);
  return fit;
}

}  // namespace

const char* describe(FittedNoise noise) {
  switch (noise) {
    case FittedNoise::determined:
      return "determined by the residuals";
    case FittedNoise::one_observation:
      return "one observation determines either the estimate or the noise, not both";
    case FittedNoise::perfect_fit:
      return "the residuals are 0 to rounding, so that the likelihood has no maximum";
  }
  return "";
}

double BlockFit::standard_error_of_noise(double sigma) const {
  return sigma / std::sqrt(2.0 * static_cast<double>(residuals.size()));
}

void LeastSquaresOptions::validate() const {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  require(positive(phase_noise_deg), "phase_noise_deg", phase_noise_deg, "a positive finite number");
  require(positive(frequency_ratio_noise), "frequency_ratio_noise", frequency_ratio_noise,
          "a positive finite number");
  require(starts >= 1 && starts <= 1000, "starts", starts, "a number from 1 to 1000");
  require(agreement_tolerance >= 1e-10 && agreement_tolerance <= 0.1, "agreement_tolerance",
          agreement_tolerance, "a number from 1e-10 to 0.1");
  require(max_iterations >= 1, "max_iterations", max_iterations, "at least 1");
}

LeastSquaresFit fit_least_squares(const friction::Observations& observations,
                                  const friction::Physics& physics, const LeastSquaresOptions& options) {
  options.validate();
  const friction::Likelihood likelihood(observations, physics);  // validates observations and physics
  const std::size_t count = observations.size();
  LeastSquaresFit fit;

  OneParameterProblem phase;
  for (std::size_t i = 0; i < count; ++i) {
    phase.add(PhaseResidual{friction::response_constants(observations.measured_ratio[i], physics),
                            physics.driving_force_n, observations.phase_deg[i], options.phase_noise_deg});
  }
  // A few roundings below the limit: the force is divided by the driving force and compared again.
  const double limit =
      likelihood.limit_friction_force_n() * (1.0 - 4.0 * std::numeric_limits<double>::epsilon());
  fit.friction_force =
      solve(phase, 0.0, limit, options.phase_noise_deg, observations.phase_deg, "friction_force", options);

  OneParameterProblem ratio;
  double least = std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double omega_b = observations.driving_frequency_hz[i];
    ratio.add(RatioResidual{observations.nominal_ratio[i], omega_b, options.frequency_ratio_noise});
    least = std::min(least, omega_b / observations.nominal_ratio[i]);
    largest = std::max(largest, omega_b / observations.nominal_ratio[i]);
  }
  fit.natural_frequency = solve(ratio, 0.5 * least, 2.0 * largest, options.frequency_ratio_noise,
                                observations.nominal_ratio, "natural_frequency", options);
  return fit;
}

}  // namespace estimation
