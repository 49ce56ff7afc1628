#include "replication/benchmark_problems.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>

namespace replication {

namespace detail {

tmcmc::LogLikelihood by_rows(std::function<double(const double*)> function) {
  return [function = std::move(function)](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                          Eigen::Ref<Eigen::VectorXd> values) {
    std::vector<double> x(static_cast<std::size_t>(points.cols()));
    for (tmcmc::Index i = 0; i < points.rows(); ++i) {
      for (tmcmc::Index j = 0; j < points.cols(); ++j) {
        x[static_cast<std::size_t>(j)] = points(i, j);
      }
      values[i] = function(x.data());
    }
  };
}

double log_normal_density(double z, double sd) {
  constexpr double log_two_pi = 1.8378770664093454836;
  return -0.5 * (z * z + log_two_pi) - portable_math::log(sd);
}

}  // namespace detail

namespace {

using detail::by_rows;
using detail::log_normal_density;
using tmcmc::Index;
using Quadrature = boost::math::quadrature::gauss_kronrod<double, 61>;

tmcmc::BoxPrior cube(Index d, double low, double high) {
  return {Eigen::VectorXd::Constant(d, low), Eigen::VectorXd::Constant(d, high)};
}

std::string in_dimensions(const char* name, Index d) {
  return name + (", " + std::to_string(d) + "-D");
}

double log_add(double a, double b) {
  const double larger = std::max(a, b);
  return larger + portable_math::log(1.0 + portable_math::exp(std::min(a, b) - larger));
}

/// Unit variances, every correlation 0.7; the box extends to 10 standard deviations.
BenchmarkProblem gaussian(Index d) {
  constexpr double rho = 0.7;
  constexpr double half_width = 10.0;
  const auto n = static_cast<double>(d);
  const double log_determinant =
      (n - 1.0) * portable_math::log(1.0 - rho) + portable_math::log(1.0 + (n - 1.0) * rho);
  const double log_norm = n * log_normal_density(0.0, 1.0) - 0.5 * log_determinant;
  const auto log_likelihood = [=](const double* x) {
    double sum = 0.0;
    double squares = 0.0;
    for (Index j = 0; j < d; ++j) {
      sum += x[j];
      squares += x[j] * x[j];
    }
    return log_norm - 0.5 * (squares - rho / (1.0 + (n - 1.0) * rho) * sum * sum) / (1.0 - rho);
  };
  return {.name = in_dimensions("Gaussian", d),
          .problem = {by_rows(log_likelihood), cube(d, -half_width, half_width)},
          .log_evidence = -n * portable_math::log(2.0 * half_width)};
}

/// x_1 is normal, x_2 is normal about x_1^2, and the others are standard normal: the map has unit
/// Jacobian.
BenchmarkProblem banana(Index d) {
  constexpr double sd = 0.2;
  const auto log_likelihood = [=](const double* x) {
    double value = log_normal_density(x[0], 1.0) + log_normal_density((x[1] - x[0] * x[0]) / sd, sd);
    for (Index j = 2; j < d; ++j) {
      value += log_normal_density(x[j], 1.0);
    }
    return value;
  };
  Eigen::VectorXd lower = Eigen::VectorXd::Constant(d, -6.0);
  Eigen::VectorXd upper = Eigen::VectorXd::Constant(d, 6.0);
  lower[1] = -2.0;
  upper[1] = 38.0;
  return {.name = in_dimensions("banana", d),
          .problem = {by_rows(log_likelihood), {lower, upper}},
          .log_evidence = -portable_math::log(40.0) - static_cast<double>(d - 1) * portable_math::log(12.0)};
}

/// Isotropic normals on [-10, 10]^d.
BenchmarkProblem normals(std::string name, Index d, double sd, std::vector<Eigen::VectorXd> centres,
                         std::vector<double> masses) {
  const auto squared_distance = [=](const double* x, const Eigen::VectorXd& centre) {
    double squares = 0.0;
    for (Index j = 0; j < d; ++j) {
      squares += (x[j] - centre[j]) * (x[j] - centre[j]);
    }
    return squares;
  };
  const double log_norm = static_cast<double>(d) * log_normal_density(0.0, sd);
  const auto log_likelihood = [=](const double* x) {
    double value = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < centres.size(); ++k) {
      const double term =
          portable_math::log(masses[k]) - 0.5 * squared_distance(x, centres[k]) / (sd * sd) + log_norm;
      value = k == 0 ? term : log_add(value, term);
    }
    return value;
  };
  const auto mode_of = [=](const Eigen::Ref<const Eigen::RowVectorXd>& row) {
    const Eigen::VectorXd x = row.transpose();
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < centres.size(); ++k) {
      if (squared_distance(x.data(), centres[k]) < squared_distance(x.data(), centres[nearest])) {
        nearest = k;
      }
    }
    return nearest;
  };
  return {.name = std::move(name),
          .problem = {by_rows(log_likelihood), cube(d, -10.0, 10.0)},
          .log_evidence = -static_cast<double>(d) * portable_math::log(20.0),
          .mode_of = mode_of,
          .mode_masses = masses};
}

BenchmarkProblem two_modes(Index d) {
  BenchmarkProblem p =
      normals(in_dimensions("two modes", d), d, 0.5,
              {Eigen::VectorXd::Constant(d, 4.0), Eigen::VectorXd::Constant(d, -4.0)}, {0.75, 0.25});
  return p;
}

BenchmarkProblem five_modes(Index d) {
  constexpr double places[5][6] = {{-5, -5, 3, 6, -2, 1},
                                   {6, -3, -4, 1, 5, -6},
                                   {-6, 5, -1, -5, 3, 4},
                                   {1, 1, 6, -2, -6, -3},
                                   {5, 6, -6, 4, 1, 5}};
  std::vector<Eigen::VectorXd> centres;
  std::vector<double> masses;
  for (int k = 0; k < 5; ++k) {
    centres.emplace_back(Eigen::Map<const Eigen::VectorXd>(places[k], d));
    masses.push_back((k + 1) / 15.0);
  }
  return normals(in_dimensions("five narrow modes", d), d, d == 2 ? 0.1 : 0.3, centres, masses);
}

/// v is normal with a standard deviation of 3, and four coordinates are normal with a variance of
/// exp(v).
BenchmarkProblem funnel() {
  constexpr double largest_v = 12.0;
  constexpr double largest_x = 30.0;
  constexpr int others = 4;
  const auto log_likelihood = [](const double* x) {
    const double sd = portable_math::exp(0.5 * x[0]);
    double value = log_normal_density(x[0] / 3.0, 3.0);
    for (int j = 1; j <= others; ++j) {
      value += log_normal_density(x[j] / sd, sd);
    }
    return value;
  };
  const double mass = Quadrature::integrate(
      [](double v) {
        const double inside = std::erf(largest_x / (std::exp(0.5 * v) * std::sqrt(2.0)));
        return std::exp(log_normal_density(v / 3.0, 3.0)) * std::pow(inside, others);
      },
      -largest_v, largest_v, 12, 1e-11);
  Eigen::VectorXd upper = Eigen::VectorXd::Constant(others + 1, largest_x);
  upper[0] = largest_v;
  return {.name = in_dimensions("funnel", others + 1),
          .problem = {by_rows(log_likelihood), {-upper, upper}},
          .log_evidence = portable_math::log(mass) - portable_math::log(2.0 * largest_v) -
                          others * portable_math::log(2.0 * largest_x)};
}

/// Log-likelihood 0, and 12 inside a ball that occupies a 500th of the box.
BenchmarkProblem plateau_and_ball() {
  constexpr double radius = 0.4151;
  constexpr double height = 12.0;
  constexpr double unit_ball = 5.2637890139143245967;  // 8 pi^2 / 15, volume in five dimensions
  const auto log_likelihood = [](const double* x) {
    double squares = 0.0;
    for (int j = 0; j < 5; ++j) {
      squares += (x[j] - 0.2) * (x[j] - 0.2);
    }
    return squares < radius * radius ? height : 0.0;
  };
  const double share = unit_ball * std::pow(radius, 5) / 32.0;
  return {.name = "plateau and ball, 5-D",
          .problem = {by_rows(log_likelihood), cube(5, -1.0, 1.0)},
          .log_evidence = portable_math::log(1.0 + share * (portable_math::exp(height) - 1.0))};
}

BenchmarkProblem spike_and_slab() {
  constexpr double narrow = 0.05;
  const auto log_likelihood = [](const double* x) {
    double spike = portable_math::log(0.9);
    double slab = portable_math::log(0.1);
    for (int j = 0; j < 2; ++j) {
      spike += log_normal_density((x[j] - 1.0) / narrow, narrow);
      slab += log_normal_density(x[j], 1.0);
    }
    return log_add(spike, slab);
  };
  return {.name = "spike and slab, 2-D",
          .problem = {by_rows(log_likelihood), cube(2, -10.0, 10.0)},
          .log_evidence = -2.0 * portable_math::log(20.0)};
}

/// Exponential from one bound in x_1, and the upper half of a normal centred on the other in x_2.
BenchmarkProblem corner() {
  constexpr double scale = 0.02;
  constexpr double sd = 0.05;
  return {.name = "corner, 2-D",
          .problem = {by_rows([](const double* x) {
                        return -x[0] / scale - portable_math::log(scale) + portable_math::log(2.0) +
                               log_normal_density((x[1] - 1.0) / sd, sd);
                      }),
                      cube(2, 0.0, 1.0)},
          .log_evidence = 0.0};  // but for exp(-50)
}

}  // namespace

std::vector<BenchmarkProblem> closed_form_problems() {
  std::vector<BenchmarkProblem> problems{gaussian(2),      gaussian(10),  gaussian(20), gaussian(50),
                                         banana(2),        banana(6),     two_modes(4), two_modes(10),
                                         five_modes(2),    five_modes(6), funnel(),     plateau_and_ball(),
                                         spike_and_slab(), corner()};
  for (BenchmarkProblem& p : structural_problems()) {
    problems.push_back(std::move(p));
  }
  return problems;
}

}  // namespace replication
