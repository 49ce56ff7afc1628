#include "friction/likelihood.hpp"

#include <algorithm>
#include <array>

#include "errors/invalid_value.hpp"
#include "friction/angle.hpp"
#include "portable_math/multiversion.hpp"

namespace friction {

namespace {

constexpr Eigen::Index chunk = 64;
struct alignas(64) Lanes : std::array<double, chunk> {};

/// Adds the squared phase residuals of one observation. Force ratios beyond the limit give values
/// that the caller does not use; the square root is kept real for them. Two short loops are used
/// instead of a long one: the processor looks ahead over more points, which hides the latency of
/// root, division and polynomial.
PORTABLE_MATH_MULTIVERSION
void add_squared_residuals(const ResponseConstants& c, double observed_deg, const Lanes& force_ratio,
                           Lanes& sum) {
  const double v_squared = c.v * c.v;
  Lanes real_part;
  Lanes imaginary_part;
  for (std::size_t i = 0; i < force_ratio.size(); ++i) {
    const double phi = force_ratio[i];
    const double phi_squared = phi * phi;
    const double phi_x0 = phi * std::sqrt(std::fabs(v_squared - c.u * c.u * phi_squared));
    real_part[i] = c.a0 + c.a1 * phi_x0 + c.a2 * phi_squared;
    imaginary_part[i] = std::fabs(c.b1 * phi_x0 + c.b2 * phi_squared);
  }
  for (std::size_t i = 0; i < force_ratio.size(); ++i) {
    const double phase =
        portable_math::polar_angle(imaginary_part[i], real_part[i]) * (180.0 / std::numbers::pi);
    const double residual = angle_residual_deg(observed_deg, phase);
    sum[i] += residual * residual;
  }
}

/// Quantities that are common to the values of a chunk of points.
struct Terms {
  double constant;
  double count;
  double frequency_minimum;
  double frequency_curvature;
  double frequency_best_period;
  double limit_force_ratio;
  double infeasible_log_likelihood;
};

/// One column of the points each, their squared phase residuals, and where the values go.
PORTABLE_MATH_MULTIVERSION
void add_up(const Terms& t, std::size_t size, const Lanes& phi, const Lanes& misfit,
            const double* natural_frequency, const double* sigma_phase, const double* sigma_ratio,
            double* log_likelihood) {
  for (std::size_t i = 0; i < size; ++i) {
    const double period_error = 1.0 / natural_frequency[i] - t.frequency_best_period;
    const double frequency = t.frequency_minimum + t.frequency_curvature * period_error * period_error;
    const double value =
        t.constant - t.count * portable_math::log(sigma_phase[i] * sigma_ratio[i]) -
        0.5 * (misfit[i] / (sigma_phase[i] * sigma_phase[i]) + frequency / (sigma_ratio[i] * sigma_ratio[i]));
    const bool feasible = phi[i] >= 0.0 && phi[i] <= t.limit_force_ratio;
    log_likelihood[i] = feasible ? value : t.infeasible_log_likelihood;
  }
}

}  // namespace

Likelihood::Likelihood(const Observations& observations, const Physics& physics,
                       double infeasible_log_likelihood)
    : phase_deg_(observations.phase_deg),
      driving_force_n_(physics.driving_force_n),
      infeasible_log_likelihood_(infeasible_log_likelihood),
      limit_force_ratio_(std::numeric_limits<double>::infinity()) {
  observations.validate();
  if (!(physics.driving_force_n > 0.0) || !std::isfinite(physics.driving_force_n)) {
    throw errors::InvalidValue("driving_force_n", physics.driving_force_n, "a positive finite number");
  }
  double squares = 0.0;
  double products = 0.0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    constants_.push_back(response_constants(observations.measured_ratio[i], physics));
    limit_force_ratio_ = std::min(limit_force_ratio_, constants_.back().limit_force_ratio);
    const double omega = observations.driving_frequency_hz[i];
    squares += omega * omega;
    products += omega * observations.nominal_ratio[i];
  }
  frequency_curvature_ = squares;
  frequency_best_period_ = products / squares;
  frequency_minimum_ = 0.0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const double residual =
        observations.nominal_ratio[i] - observations.driving_frequency_hz[i] * frequency_best_period_;
    frequency_minimum_ += residual * residual;
  }
}

void Likelihood::operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                            Eigen::Ref<Eigen::VectorXd> log_likelihood) const {
  if (points.cols() != parameter_count || log_likelihood.size() != points.rows()) {
    throw errors::InvalidValue("friction::Likelihood", "", "n x 4 points and n results");
  }
  const double count = static_cast<double>(constants_.size());
  constexpr double log_two_pi = 1.8378770664093453;
  const Terms terms{.constant = -count * log_two_pi,
                    .count = count,
                    .frequency_minimum = frequency_minimum_,
                    .frequency_curvature = frequency_curvature_,
                    .frequency_best_period = frequency_best_period_,
                    .limit_force_ratio = limit_force_ratio_,
                    .infeasible_log_likelihood = infeasible_log_likelihood_};
  const double to_ratio = 1.0 / driving_force_n_;
  for (Eigen::Index begin = 0; begin < points.rows(); begin += chunk) {
    const Eigen::Index size = std::min(chunk, points.rows() - begin);
    const auto column = [&](Parameter parameter) { return points.col(parameter).data() + begin; };
    Lanes phi{};
    Lanes misfit{};
    for (Eigen::Index i = 0; i < size; ++i) {
      phi[static_cast<std::size_t>(i)] = column(friction_force)[i] * to_ratio;
    }
    for (std::size_t j = 0; j < constants_.size(); ++j) {
      add_squared_residuals(constants_[j], phase_deg_[j], phi, misfit);
    }
    add_up(terms, static_cast<std::size_t>(size), phi, misfit, column(natural_frequency), column(phase_noise),
           column(frequency_ratio_noise), log_likelihood.data() + begin);
  }
}

double Likelihood::phase_misfit(double friction_force_n) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < constants_.size(); ++j) {
    const double residual =
        angle_residual_deg(phase_deg_[j], phase_deg(constants_[j], friction_force_n / driving_force_n_));
    sum += residual * residual;
  }
  return sum;
}

double Likelihood::frequency_misfit(double natural_frequency_hz) const {
  const double period_error = 1.0 / natural_frequency_hz - frequency_best_period_;
  return frequency_minimum_ + frequency_curvature_ * period_error * period_error;
}

}  // namespace friction
