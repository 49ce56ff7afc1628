/// \file
/// A hierarchical model as a prior of one's own: eight groups (the coaching experiments of Rubin
/// 1981), each with an effect theta_j of its own and a measurement y_j of it,
///
///     y_j ~ N(theta_j, s_j^2),   theta_j ~ N(mu, tau^2),   mu ~ N(0, 20^2),   tau ~ half-normal(10) or known.
///
/// The parameters are mu, log(tau) if tau is unknown, and theta_1 ... theta_8. Given tau everything
/// is normal: evidence and moments in closed form.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "tmcmc/sampler.hpp"

namespace eight_groups {

constexpr std::size_t groups = 8;
/// y_j, points of a test.
constexpr std::array<double, groups> measured = {28, 8, -3, 7, -1, 1, 18, 12};
/// s_j.
constexpr std::array<double, groups> errors = {15, 10, 16, 11, 9, 11, 10, 18};
/// Standard deviation of the prior of mu.
constexpr double centre_sd = 20.0;
/// Scale of the half-normal prior of tau.
constexpr double spread_sd = 10.0;

/// log N(x; mean, sd^2).
inline double log_normal_density(double x, double mean, double sd) {
  const double z = (x - mean) / sd;
  return -0.5 * z * z - std::log(sd) - 0.91893853320467274178;
}

/// The prior. If tau is unknown there is one more parameter, log(tau), whose density has the
/// Jacobian tau.
inline tmcmc::Prior prior(std::optional<double> known_tau) {
  const Eigen::Index first = known_tau ? 1 : 2;  // of the thetas
  const auto spread = tmcmc::Marginal::half_normal(spread_sd);
  tmcmc::OwnPrior own{
      .description = "eight groups, tau " + (known_tau ? std::to_string(*known_tau) : "unknown"),
      .parameters = {{"mu", "points"}},
      .log_density = {},
      .draw = {}};
  if (!known_tau) {
    own.parameters.push_back({"log_tau"});
  }
  for (std::size_t j = 1; j <= groups; ++j) {
    own.parameters.push_back({"theta_" + std::to_string(j), "points"});
  }
  own.log_density = [=](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const double tau = known_tau ? *known_tau : std::exp(points(i, 1));
      double sum = log_normal_density(points(i, 0), 0.0, centre_sd);
      sum += known_tau ? 0.0 : spread.log_density(tau) + points(i, 1);
      for (Eigen::Index j = first; j < points.cols(); ++j) {
        sum += log_normal_density(points(i, j), points(i, 0), tau);
      }
      values[i] = sum;
    }
  };
  own.draw = [=](tmcmc::RandomStream& stream, Eigen::Ref<Eigen::VectorXd> point) {
    point[0] = centre_sd * stream.normal();
    const double tau = known_tau ? *known_tau : spread.quantile(stream.uniform());
    if (!known_tau) {
      point[1] = std::log(tau);
    }
    for (Eigen::Index j = first; j < point.size(); ++j) {
      point[j] = point[0] + tau * stream.normal();
    }
  };
  return tmcmc::Prior(own);
}

/// Log-likelihood of the measurements, which depends only on the thetas: the last eight columns.
inline void log_likelihood(const Eigen::Ref<const Eigen::MatrixXd>& points,
                           Eigen::Ref<Eigen::VectorXd> values) {
  values.setZero();
  for (std::size_t j = 0; j < groups; ++j) {
    const auto column = points.cols() - static_cast<Eigen::Index>(groups - j);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      values[i] += log_normal_density(measured[j], points(i, column), errors[j]);
    }
  }
}

/// Evidence and moments known in closed form.
struct Exact {
  double log_evidence = 0.0;
  double mu_mean = 0.0;
  double mu_sd = 0.0;
  std::array<double, groups> theta_mean{};
  std::array<double, groups> theta_sd{};
};

/// Evidence and posterior moments given tau. With v_j = s_j^2 + tau^2 the measurements are N(mu,
/// v_j) given mu.
inline Exact exact(double tau) {
  Exact result;
  double precision = 1.0 / (centre_sd * centre_sd);
  double weighted = 0.0;
  for (std::size_t j = 0; j < groups; ++j) {
    const double v = errors[j] * errors[j] + tau * tau;
    precision += 1.0 / v;
    weighted += measured[j] / v;
    result.log_evidence += log_normal_density(measured[j], 0.0, std::sqrt(v));
  }
  // The product of the densities about mu = 0, times the integral over mu of what mu changes.
  result.log_evidence +=
      0.5 * weighted * weighted / precision - std::log(centre_sd) - 0.5 * std::log(precision);
  result.mu_mean = weighted / precision;
  result.mu_sd = 1.0 / std::sqrt(precision);
  for (std::size_t j = 0; j < groups; ++j) {
    const double v = errors[j] * errors[j];
    const double shrinkage = v / (v + tau * tau);  // share of mu in theta_j
    result.theta_mean[j] = shrinkage * result.mu_mean + (1.0 - shrinkage) * measured[j];
    result.theta_sd[j] = std::sqrt(shrinkage * tau * tau + shrinkage * shrinkage / precision);
  }
  return result;
}

}  // namespace eight_groups
