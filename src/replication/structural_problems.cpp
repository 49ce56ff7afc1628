#include <algorithm>
#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>

#include "estimation/exact_posterior.hpp"
#include "replication/benchmark_problems.hpp"
#include "replication/calibration.hpp"

namespace replication {

namespace {

using detail::by_rows;
using detail::log_normal_density;
using Panel = boost::math::quadrature::gauss<double, 30>;

// Rigs that were seen while the settings of the independent draws were chosen, or the cause of
// their warnings was investigated.
constexpr std::array rigs_seen{1, 2, 3, 10, 14, 20};
constexpr double frame_mass_1 = 16.5e3;       // kg
constexpr double frame_mass_2 = 16.1e3;       // kg
constexpr double nominal_stiffness = 29.7e6;  // N/m
constexpr double first_frequency = 3.13;      // Hz
constexpr double second_frequency = 9.83;     // Hz

double square(double x) {
  return x * x;
}

/// Integral over several panels of [low, high].
template <class Function>
double integral(Function function, double low, double high, int panels) {
  double sum = 0.0;
  for (int k = 0; k < panels; ++k) {
    sum += Panel::integrate(function, low + (high - low) * k / panels, low + (high - low) * (k + 1) / panels);
  }
  return sum;
}

/// Squares of the frequencies of a frame whose stiffnesses are theta times the nominal one, divided
/// by the measured squares.
struct SquaredRatios {
  double first;
  double second;
};
SquaredRatios squared_ratios(const double* theta) {
  const auto f = shear_frame_frequencies(frame_mass_1, frame_mass_2, theta[0] * nominal_stiffness,
                                         theta[1] * nominal_stiffness);
  return {square(f.first / first_frequency), square(f.second / second_frequency)};
}

/// Area of theta_1 and theta_2 per area of the squared ratios, at one of the two solutions: the
/// solutions have the same product and the same sum u + v of u = m_2 k_1 and v = (m_1 + m_2) k_2,
/// so that u and v are exchanged.
double area_per_squared_ratios(double first, double second) {
  constexpr double two_pi = boost::math::constants::two_pi<double>();
  const double measured_1 = square(two_pi * first_frequency);
  const double measured_2 = square(two_pi * second_frequency);
  const double sum = frame_mass_1 * frame_mass_2 * (measured_1 * first + measured_2 * second);
  const double product = frame_mass_2 * (frame_mass_1 + frame_mass_2) * frame_mass_1 * frame_mass_2 *
                         measured_1 * first * measured_2 * second;
  const double difference = std::sqrt(sum * sum - 4.0 * product);
  return std::fabs(measured_2 * second - measured_1 * first) * square(frame_mass_1 * frame_mass_2) /
         difference * measured_1 * measured_2 / square(nominal_stiffness);
}

/// Mean of area_per_squared_ratios over independent normals about `centre` with standard deviation
/// sd.
double mean_area(double sd, SquaredRatios centre) {
  const auto density = [](double z) { return std::exp(log_normal_density(z, 1.0)); };
  return integral(
      [&](double s) {
        return density(s) * integral(
                                [&](double t) {
                                  return density(t) * area_per_squared_ratios(centre.first + sd * s,
                                                                              centre.second + sd * t);
                                },
                                -8.0, 8.0, 1);
      },
      -8.0, 8.0, 1);
}

std::function<std::size_t(const Eigen::Ref<const Eigen::RowVectorXd>&)> side_of_frame() {
  return [](const Eigen::Ref<const Eigen::RowVectorXd>& x) {
    return static_cast<std::size_t>(frame_mass_2 * x[0] < (frame_mass_1 + frame_mass_2) * x[1] ? 0 : 1);
  };
}

/// Frame with known errors of 1 %, and stiffnesses of up to a thousand times the nominal one.
BenchmarkProblem frame_with_wide_priors() {
  constexpr double largest = 1000.0;
  constexpr double error = 0.01;
  return {.name = "frame, wide priors",
          .problem = {by_rows([](const double* theta) {
                        const SquaredRatios r = squared_ratios(theta);
                        return log_normal_density((r.first - 1.0) / error, error) +
                               log_normal_density((r.second - 1.0) / error, error);
                      }),
                      {Eigen::Vector2d::Zero(), Eigen::Vector2d::Constant(largest)}},
          .log_evidence = portable_math::log(2.0 * mean_area(error, {1.0, 1.0}) / square(largest)),
          .mode_of = side_of_frame(),
          .mode_masses = {0.5, 0.5}};
}

/// Three measurements of each frequency that agree to about 1 in 2000, and an unknown noise level.
BenchmarkProblem frame_with_precise_data() {
  constexpr int repetitions = 3;
  constexpr double measured_1[repetitions] = {1.0006, 0.9995, 0.9999};
  constexpr double measured_2[repetitions] = {0.9994, 1.0004, 1.0002};
  constexpr double largest = 3.0;
  constexpr double least_noise = 1e-5;
  constexpr double most_noise = 0.2;
  const auto log_likelihood = [=](const double* theta) {
    const SquaredRatios r = squared_ratios(theta);
    double value = 0.0;
    for (int k = 0; k < repetitions; ++k) {
      value += log_normal_density((measured_1[k] - r.first) / theta[2], theta[2]) +
               log_normal_density((measured_2[k] - r.second) / theta[2], theta[2]);
    }
    return value;
  };
  SquaredRatios mean{0.0, 0.0};
  for (int k = 0; k < repetitions; ++k) {
    mean.first += measured_1[k] / repetitions;
    mean.second += measured_2[k] / repetitions;
  }
  double squares = 0.0;
  for (int k = 0; k < repetitions; ++k) {
    squares += square(measured_1[k] - mean.first) + square(measured_2[k] - mean.second);
  }
  // At a given noise level the squared ratios are normal about their means, times a factor for the
  // scatter of the measurements.
  const double total = integral(
      [=](double log_noise) {
        const double noise = std::exp(log_noise);
        const double scatter =
            2 * repetitions * log_normal_density(0.0, noise) - 0.5 * squares / square(noise);
        const double sd = noise / std::sqrt(repetitions);
        return std::exp(scatter - 2.0 * log_normal_density(0.0, sd)) * mean_area(sd, mean) * noise;
      },
      std::log(least_noise), std::log(0.02), 20);  // above 2 % the scatter leaves less than 1e-7
  return {
      .name = "frame, precise data",
      .problem = {by_rows(log_likelihood),
                  {Eigen::Vector3d(0.0, 0.0, least_noise), Eigen::Vector3d(largest, largest, most_noise)}},
      .log_evidence = portable_math::log(2.0 * total / (square(largest) * (most_noise - least_noise))),
      .mode_of = side_of_frame(),
      .mode_masses = {0.5, 0.5}};
}

/// Mean mu on (-30, 50), spread tau on (0, 40), standardised effects on (-8, 8) with standard
/// normal densities.
BenchmarkProblem eight_schools() {
  constexpr int schools = 8;
  constexpr double effect[schools] = {28, 8, -3, 7, -1, 1, 18, 12};
  constexpr double error[schools] = {15, 10, 16, 11, 9, 11, 10, 18};
  constexpr double half_width = 8.0;
  const auto log_likelihood = [=](const double* x) {
    double value = 0.0;
    for (int j = 0; j < schools; ++j) {
      value += log_normal_density(x[2 + j], 1.0) +
               log_normal_density((effect[j] - x[0] - x[1] * x[2 + j]) / error[j], error[j]);
    }
    return value;
  };
  const double mean = integral(
                          [=](double tau) {
                            return integral(
                                [=](double mu) {
                                  double value = 0.0;
                                  for (int j = 0; j < schools; ++j) {
                                    const double sd = std::sqrt(tau * tau + error[j] * error[j]);
                                    value += log_normal_density((effect[j] - mu) / sd, sd);
                                  }
                                  return std::exp(value);
                                },
                                -30.0, 50.0, 4);
                          },
                          0.0, 40.0, 4) /
                      (80.0 * 40.0);
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(schools + 2, -half_width);
  Eigen::VectorXd upper = Eigen::VectorXd::Constant(schools + 2, half_width);
  lower.head(2) << -30.0, 0.0;
  upper.head(2) << 50.0, 40.0;
  return {.name = "eight schools, 10-D",
          .problem = {by_rows(log_likelihood), {lower, upper}},
          .log_evidence = portable_math::log(mean) - schools * portable_math::log(2.0 * half_width)};
}

BenchmarkProblem friction_problem(std::string name, const Reading& reading,
                                  const friction::Observations& observations, const tmcmc::BoxPrior& prior) {
  estimation::ParameterBounds bounds;
  for (int p = 0; p < friction::parameter_count; ++p) {
    bounds[static_cast<std::size_t>(p)] = {prior.lower()[p], prior.upper()[p]};
  }
  const estimation::ExactPosterior exact(friction::Likelihood(observations, reading.physics), bounds);
  return {.name = std::move(name),
          .problem = problem(reading, observations, prior),
          .log_evidence = exact.log_evidence(),
          .infeasible_level = reading.infeasible_log_likelihood};
}

}  // namespace

FrameFrequencies shear_frame_frequencies(double mass_1, double mass_2, double stiffness_1,
                                         double stiffness_2) {
  // Characteristic equation a w^4 - b w^2 + c = 0 of det(K - w^2 M).
  const double a = mass_1 * mass_2;
  const double b = mass_1 * stiffness_2 + mass_2 * (stiffness_1 + stiffness_2);
  const double c = stiffness_1 * stiffness_2;
  const double larger = 0.5 * (b + std::sqrt(std::max(b * b - 4.0 * a * c, 0.0)));
  constexpr double two_pi = boost::math::constants::two_pi<double>();
  return {std::sqrt(c / larger) / two_pi, std::sqrt(larger / a) / two_pi};
}

std::vector<BenchmarkProblem> structural_problems() {
  return {frame_with_wide_priors(), frame_with_precise_data(), eight_schools()};
}

std::vector<BenchmarkProblem> friction_problems(const std::string& name, const Reading& reading,
                                                const friction::Observations& observations,
                                                const tmcmc::BoxPrior& prior, int rigs, std::uint64_t seed) {
  std::vector<BenchmarkProblem> problems{friction_problem("friction, " + name, reading, observations, prior)};
  for (int rig = 1; rig <= rigs; ++rig) {
    const auto pair =
        simulate_pair(observations, reading.physics, prior, seed, static_cast<std::uint32_t>(rig - 1));
    problems.push_back(friction_problem("rig " + std::to_string(rig), reading, pair.observations, prior));
    problems.back().tuned_on = std::find(rigs_seen.begin(), rigs_seen.end(), rig) != rigs_seen.end();
  }
  return problems;
}

}  // namespace replication
