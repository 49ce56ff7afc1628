#include "replication/benchmark_problems.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <memory>

namespace replication {

namespace {

using tmcmc::Index;
using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;

constexpr double log_two_pi = 1.8378770664093454836;

double normal_cdf(double z) {
  return boost::math::cdf(boost::math::normal(), std::clamp(z, -37.0, 37.0));
}

double log_normal_density(double z, double sd) {
  return -0.5 * (z * z + log_two_pi) - portable_math::log(sd);
}

tmcmc::LogLikelihood by_rows(std::function<double(const double*)> function) {
  return [function = std::move(function)](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                          Eigen::Ref<Eigen::VectorXd> values) {
    std::vector<double> x(static_cast<std::size_t>(points.cols()));
    for (Index i = 0; i < points.rows(); ++i) {
      for (Index j = 0; j < points.cols(); ++j) {
        x[static_cast<std::size_t>(j)] = points(i, j);
      }
      values[i] = function(x.data());
    }
  };
}

tmcmc::BoxPrior cube(Index d, double low, double high) {
  return {Eigen::VectorXd::Constant(d, low), Eigen::VectorXd::Constant(d, high)};
}

/// Stationary first-order autoregression: unit variances, correlation 0.5^|i-j|.
BenchmarkProblem gaussian(Index d, Index budget, Index chains, Index samples) {
  constexpr double rho = 0.5;
  constexpr double half_width = 8.0;
  const double innovation = std::sqrt(1.0 - rho * rho);
  BenchmarkProblem p{.name = "Gaussian, " + std::to_string(d) + " dimensions",
                     .problem = {by_rows([=](const double* x) {
                                   double value = log_normal_density(x[0], 1.0);
                                   for (Index j = 1; j < d; ++j) {
                                     value +=
                                         log_normal_density((x[j] - rho * x[j - 1]) / innovation, innovation);
                                   }
                                   return value;
                                 }),
                                 cube(d, -half_width, half_width)},
                     .log_evidence = -static_cast<double>(d) * portable_math::log(2.0 * half_width),
                     .marginal_cdf = [](Index, double x) { return normal_cdf(x); },
                     .in_first_mode = {},
                     .options = tmcmc::recommended_options(budget)};
  p.options.move = tmcmc::WasteFree{chains};
  p.options.samples = samples;  // more stages than the recommended number of samples leaves room for
  p.options.cross_fit = d >= 20;
  return p;
}

BenchmarkProblem two_normals() {
  constexpr double mass = 0.3;
  constexpr double sd_1 = 0.2;
  constexpr double sd_2 = 0.5;
  constexpr double centre_1 = -4.0;
  constexpr double centre_2 = 3.0;
  BenchmarkProblem p{
      .name = "two normals",
      .problem = {by_rows([=](const double* x) {
                    double a = portable_math::log(mass);
                    double b = portable_math::log(1.0 - mass);
                    for (int j = 0; j < 2; ++j) {
                      a += log_normal_density((x[j] - centre_1) / sd_1, sd_1);
                      b += log_normal_density((x[j] - centre_2) / sd_2, sd_2);
                    }
                    const double larger = std::max(a, b);
                    return larger + portable_math::log(1.0 + portable_math::exp(std::min(a, b) - larger));
                  }),
                  cube(2, -10.0, 10.0)},
      .log_evidence = -2.0 * portable_math::log(20.0),
      .marginal_cdf =
          [=](Index, double x) {
            return mass * normal_cdf((x - centre_1) / sd_1) +
                   (1.0 - mass) * normal_cdf((x - centre_2) / sd_2);
          },
      .in_first_mode = [](const auto& x) { return x[0] + x[1] < 0.0; },
      .first_mode_mass = mass,
      .options = tmcmc::recommended_options(62000)};
  p.options.move = tmcmc::WasteFree{100};
  p.options.samples = p.options.samples / 100 * 100;
  return p;
}

/// x_1 normal, x_2 normal about x_1^2: the map has unit Jacobian.
BenchmarkProblem banana() {
  constexpr double sd = 0.2;
  return {.name = "banana",
          .problem = {by_rows([=](const double* x) {
                        return log_normal_density(x[0], 1.0) +
                               log_normal_density((x[1] - x[0] * x[0]) / sd, sd);
                      }),
                      {Eigen::Vector2d(-6.0, -2.0), Eigen::Vector2d(6.0, 38.0)}},
          .log_evidence = -portable_math::log(12.0 * 40.0),
          .marginal_cdf =
              [=](Index j, double x) {
                if (j == 0) {
                  return normal_cdf(x);
                }
                return Quadrature::integrate(
                    [=](double t) {
                      return boost::math::pdf(boost::math::normal(), t) * normal_cdf((x - t * t) / sd);
                    },
                    -8.0, 8.0, 12, 1e-8);
              },
          .in_first_mode = {},
          .options = tmcmc::recommended_options(31000)};
}

/// Exponential from one bound in x_1, and the upper half of a normal centred on the other in x_2.
BenchmarkProblem corner() {
  constexpr double scale = 0.02;
  constexpr double sd = 0.05;
  return {.name = "against a corner",
          .problem = {by_rows([=](const double* x) {
                        return -x[0] / scale - portable_math::log(scale) + portable_math::log(2.0) +
                               log_normal_density((x[1] - 1.0) / sd, sd);
                      }),
                      cube(2, 0.0, 1.0)},
          .log_evidence = 0.0,  // but for exp(-50)
          .marginal_cdf =
              [=](Index j, double x) {
                return j == 0 ? -std::expm1(-x / scale) : 2.0 * normal_cdf((std::min(x, 1.0) - 1.0) / sd);
              },
          .in_first_mode = {},
          .options = tmcmc::recommended_options(31000)};
}

/// Cumulative integral of a density that is known but for its norm, with its norm.
class Tabulated {
 public:
  Tabulated(double low, double high, const std::function<double(double)>& density) {
    constexpr int intervals = 600;
    for (int i = 0; i <= intervals; ++i) {
      x_.push_back(low + (high - low) * i / intervals);
      const double mass = i == 0 ? 0.0
                                 : boost::math::quadrature::gauss<double, 7>::integrate(
                                       density, x_[x_.size() - 2], x_.back());
      cumulative_.push_back(i == 0 ? 0.0 : cumulative_.back() + mass);
    }
  }
  [[nodiscard]] double total() const { return cumulative_.back(); }
  [[nodiscard]] double cdf(double x) const {
    const auto upper = std::upper_bound(x_.begin(), x_.end(), x);
    if (upper == x_.begin() || upper == x_.end()) {
      return upper == x_.begin() ? 0.0 : 1.0;
    }
    const auto i = static_cast<std::size_t>(upper - x_.begin());
    const double part = (x - x_[i - 1]) / (x_[i] - x_[i - 1]);
    return (cumulative_[i - 1] + part * (cumulative_[i] - cumulative_[i - 1])) / total();
  }

 private:
  std::vector<double> x_;
  std::vector<double> cumulative_;
};

BenchmarkProblem shear_frame() {
  constexpr double mass_1 = 16.5e3;
  constexpr double mass_2 = 16.1e3;
  constexpr double nominal_stiffness = 29.7e6;
  constexpr double largest = 3.0;
  constexpr double error = 1.0 / 16.0;  // of the squared frequency ratios
  const auto log_likelihood = [=](const double* theta) {
    const auto f =
        shear_frame_frequencies(mass_1, mass_2, theta[0] * nominal_stiffness, theta[1] * nominal_stiffness);
    const double first = f.first * f.first / (3.13 * 3.13) - 1.0;
    const double second = f.second * f.second / (9.83 * 9.83) - 1.0;
    return -(first * first + second * second) / (2.0 * error * error);
  };
  const auto density = [=](int j) {
    return [=](double x) {
      return Quadrature::integrate(
          [=](double y) {
            const double theta[] = {j == 0 ? x : y, j == 0 ? y : x};
            return portable_math::exp(log_likelihood(theta));
          },
          0.0, largest, 10, 1e-7);
    };
  };
  // The two solutions lie on both sides of the point where they would meet.
  constexpr double between = 1.0;
  const auto first = std::make_shared<Tabulated>(0.0, largest, density(0));
  const auto second = std::make_shared<Tabulated>(0.0, largest, density(1));
  BenchmarkProblem p{
      .name = "two-storey frame",
      .problem = {by_rows(log_likelihood), cube(2, 0.0, largest)},
      .log_evidence = portable_math::log(first->total() / (largest * largest)),
      .marginal_cdf = [=](Index j, double x) { return j == 0 ? first->cdf(x) : second->cdf(x); },
      .in_first_mode = [=](const auto& x) { return x[0] < between; },
      .first_mode_mass = first->cdf(between),
      .options = tmcmc::recommended_options(31000)};
  p.options.move = tmcmc::WasteFree{100};
  p.options.samples = p.options.samples / 100 * 100;
  return p;
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

std::vector<BenchmarkProblem> benchmark_problems() {
  return {gaussian(2, 31000, 10, 2380),
          gaussian(10, 62000, 10, 4000),
          gaussian(50, 1000000, 100, 25000),
          two_normals(),
          banana(),
          corner(),
          shear_frame()};
}

}  // namespace replication
