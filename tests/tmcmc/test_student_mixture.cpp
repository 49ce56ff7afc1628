// Density, draws and fit of mixtures of Student t distributions.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tmcmc/detail/separate_modes.hpp"
#include "tmcmc/mixture_fit.hpp"

using namespace tmcmc;

namespace {

constexpr double rounding = 1e-13;
constexpr double standard_errors = 5.0;

StudentMixture two_components() {
  StudentMixture mixture;
  mixture.weights = Eigen::Vector2d(0.25, 0.75);
  mixture.means.resize(2, 2);
  mixture.means << -3.0, 2.0, 1.0, 0.5;
  mixture.factors = {(Eigen::Matrix2d() << 0.5, 0.0, 0.3, 0.4).finished(),
                     (Eigen::Matrix2d() << 1.0, 0.0, -0.6, 0.8).finished()};
  return mixture;
}

WeightedPoints equally_weighted_points(Population points) {
  const Index n = points.rows();
  WeightedPoints data{std::move(points), Eigen::VectorXd::Ones(n), {}};
  for (Index i = 0; i < n; ++i) {
    data.groups.push_back(i);
  }
  return data;
}

}  // namespace

TEST_CASE("The density of one component is the closed form of Student's t with two degrees of freedom") {
  StudentMixture t;
  t.weights = Eigen::VectorXd::Ones(1);
  t.means = Eigen::MatrixXd::Constant(1, 1, 0.5);
  t.factors = {Eigen::MatrixXd::Constant(1, 1, 2.0)};
  t.degrees_of_freedom = 2;
  const Population x = Eigen::Vector3d(-40.0, 0.5, 3.0);
  const Eigen::VectorXd values = log_density(t, x);
  for (Index i = 0; i < 3; ++i) {
    const double z = (x(i, 0) - 0.5) / 2.0;
    const double expected =
        -std::log(2.0 * std::sqrt(2.0) * std::pow(1.0 + 0.5 * z * z, 1.5)) - std::log(2.0);
    CHECK(values[i] == Approx(expected).epsilon(rounding));
  }
}

TEST_CASE("The density of a mixture integrates to one, in an even and an odd number of dimensions") {
  const StudentMixture mixture = two_components();
  constexpr Index side = 600;
  constexpr double low = -30.0;
  constexpr double step = 0.1;
  Population grid(side * side, 2);
  for (Index i = 0; i < side * side; ++i) {
    grid(i, 0) = low + step * static_cast<double>(i % side);
    grid(i, 1) = low + step * static_cast<double>(i / side);
  }
  CHECK(log_density(mixture, grid).array().exp().sum() * step * step == Approx(1.0).margin(1e-5));

  StudentMixture line;
  line.weights = Eigen::Vector2d(0.4, 0.6);
  line.means = Eigen::RowVector2d(-1.0, 2.0);
  line.factors = {Eigen::MatrixXd::Constant(1, 1, 0.5), Eigen::MatrixXd::Constant(1, 1, 1.5)};
  const Population points = Eigen::VectorXd::LinSpaced(8001, -80.0, 80.0);
  CHECK(log_density(line, points).array().exp().sum() * 0.02 == Approx(1.0).margin(1e-6));
}

TEST_CASE(
    "Far from all components, where their densities underflow, the log-density is that of the formula") {
  const StudentMixture mixture = two_components();
  Population far(2, 2);
  far << 1e150, -1e150, -2e60, 1e60;
  const Eigen::VectorXd found = log_density(mixture, far);
  for (Index i = 0; i < 2; ++i) {
    double expected = -std::numeric_limits<double>::infinity();
    for (Index k = 0; k < 2; ++k) {
      const auto& factor = mixture.factors[static_cast<std::size_t>(k)];
      const Eigen::VectorXd deviation = far.row(i).transpose() - mixture.means.col(k);
      const double distance = factor.triangularView<Eigen::Lower>().solve(deviation).squaredNorm();
      // Gamma(5) / (Gamma(4) 8 pi) = 1 / (2 pi).
      const double term = std::log(mixture.weights[k]) - std::log(2.0 * std::acos(-1.0)) -
                          std::log(factor(0, 0) * factor(1, 1)) - 5.0 * std::log1p(distance / 8.0);
      const double larger = std::max(term, expected);
      expected = larger + std::log(std::exp(term - larger) + std::exp(expected - larger));
    }
    CHECK(found[i] == Approx(expected).epsilon(rounding));
  }
}

TEST_CASE("Draws have the means and the covariances of their components") {
  const StudentMixture mixture = two_components();
  constexpr Index n = 40000;
  const Population draws = sample(mixture, n, {.seed = 3}, 0);
  const Eigen::RowVectorXd mean = draws.colwise().mean();
  const Eigen::VectorXd expected = mixture.means * mixture.weights;
  // Covariance of t: nu / (nu - 2) L L^T; and the spread of the means.
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  for (Index k = 0; k < 2; ++k) {
    const auto& factor = mixture.factors[static_cast<std::size_t>(k)];
    const Eigen::Vector2d shift = mixture.means.col(k) - expected;
    covariance += mixture.weights[k] * (8.0 / 6.0 * factor * factor.transpose() + shift * shift.transpose());
  }
  for (Index j = 0; j < 2; ++j) {
    const double error = std::sqrt(covariance(j, j) / static_cast<double>(n));
    CHECK(mean[j] == Approx(expected[j]).margin(standard_errors * error));
  }
  const Population centred = draws.rowwise() - mean;
  const Eigen::Matrix2d found = centred.transpose() * centred / static_cast<double>(n);
  CHECK((found - covariance).cwiseAbs().maxCoeff() < 0.03 * covariance.cwiseAbs().maxCoeff());
}

TEST_CASE("Sums of densities are relative to the given scale, whatever its level") {
  const StudentMixture mixture = two_components();
  const Population points = sample(mixture, 300, {.seed = 5}, 0);
  const Eigen::VectorXd log_density_of_mixture = log_density(mixture, points);
  for (const double level : {0.0, -600.0, 600.0}) {
    Eigen::VectorXd total = Eigen::VectorXd::Constant(300, 2.0);
    const Eigen::VectorXd log_scale = log_density_of_mixture.array() + level;
    add_relative_density(mixture, std::log(3.0) + level, points, log_scale, total);
    CHECK((total.array() - 5.0).abs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("Densities in few dimensions and in many are the same function, with and without a wider share") {
  // A coordinate that is independent of the others factorises out of a normal, but not of Student's
  // t: so compare with the definition.
  for (const Index d : {1, 2, 3, 4, 5, 6, 7, 9}) {
    for (const int nu : {4, 8}) {
      for (const double wide_share : {0.0, 0.25}) {
        StudentMixture t;
        t.degrees_of_freedom = nu;
        t.wide_share = wide_share;
        t.weights = Eigen::VectorXd::Ones(1);
        t.means = Eigen::VectorXd::LinSpaced(d, -1.0, 2.0);
        Eigen::MatrixXd factor = Eigen::MatrixXd::Identity(d, d);
        for (Index j = 0; j < d; ++j) {
          for (Index l = 0; l < j; ++l) {
            factor(j, l) = 0.1 * static_cast<double>(j - 2 * l);
          }
          factor(j, j) = 0.5 + 0.25 * static_cast<double>(j);
        }
        t.factors = {factor};
        Population points = sample(t, 50, {.seed = 6}, 0);
        points.row(0) *= 1e30;  // where the powers underflow
        const Eigen::VectorXd found = log_density(t, points);
        const double wider = std::min(2.0, std::pow(2.0, 4.0 / static_cast<double>(d)));
        for (Index i = 0; i < points.rows(); ++i) {
          const Eigen::VectorXd white =
              factor.triangularView<Eigen::Lower>().solve(points.row(i).transpose() - t.means);
          const double half = 0.5 * static_cast<double>(nu + d);
          const auto log_t = [&](double c) {
            return std::lgamma(half) - std::lgamma(0.5 * nu) -
                   0.5 * static_cast<double>(d) * std::log(nu * std::acos(-1.0)) -
                   (c * factor).diagonal().array().log().sum() -
                   half * std::log1p(white.squaredNorm() / (c * c) / nu);
          };
          const double narrow = log_t(1.0);
          const double expected =
              narrow + std::log(1.0 - wide_share + wide_share * std::exp(log_t(wider) - narrow));
          CHECK(found[i] == Approx(expected).epsilon(1e-12).margin(1e-12));
        }
      }
    }
  }
}

TEST_CASE("A wider share has the means, and at most 16 times the volume and twice the width") {
  for (const Index d : {1, 4, 8}) {
    StudentMixture t;
    t.weights = Eigen::VectorXd::Ones(1);
    t.means = Eigen::VectorXd::Constant(d, 5.0);
    t.factors = {3.0 * Eigen::MatrixXd::Identity(d, d)};
    t.wide_share = 0.25;
    const double width = d <= 4 ? 2.0 : std::pow(16.0, 1.0 / static_cast<double>(d));
    CHECK(t.wider() == Approx(width).epsilon(rounding));
    const Index n = 40000;
    const Population x = sample(t, n, {.seed = 8}, 0);
    const Index narrow = n * 3 / 4;  // the draws stand in the order of the parts
    const double variance_of_t = 8.0 / 6.0;
    const auto variance_of = [](const auto& part) { return (part.array() - 5.0).square().mean(); };
    // Of Student's t with 8 degrees of freedom the kurtosis is 4.5, so the variance of a square is
    // 3.5 times its squared mean.
    const auto bound = [&](Index rows) { return 5.0 * std::sqrt(3.5 / static_cast<double>(rows)); };
    for (Index j = 0; j < d; ++j) {
      CHECK(variance_of(x.col(j).head(narrow)) / (9.0 * variance_of_t) == Approx(1.0).margin(bound(narrow)));
      CHECK(variance_of(x.col(j).tail(n - narrow)) / (9.0 * variance_of_t * width * width) ==
            Approx(1.0).margin(bound(n - narrow)));
      CHECK(x.col(j).mean() == Approx(5.0).margin(5.0 * 3.0 * width * std::sqrt(variance_of_t / n)));
    }
  }
}

TEST_CASE("Each component gets its share of the draws, rounded") {
  const std::vector<double> shares{0.5, 0.0, 0.3, 0.2};
  for (const double u : {0.001, 0.5, 0.999}) {
    const auto counts = systematic_counts(shares, 7, u);
    CHECK(counts[0] + counts[1] + counts[2] + counts[3] == 7);
    CHECK(counts[1] == 0);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(std::fabs(static_cast<double>(counts[k]) - 7.0 * shares[k]) < 1.0);
    }
  }
}

TEST_CASE("Draws and densities do not depend on the threads, and stages are independent") {
  const StudentMixture mixture = two_components();
  const Population one = sample(mixture, 9000, {.seed = 4}, 1, 1);
  CHECK(one == sample(mixture, 9000, {.seed = 4}, 1, 3));
  CHECK(one != sample(mixture, 9000, {.seed = 4}, 2, 1));
  CHECK(log_density(mixture, one, 1) == log_density(mixture, one, 3));
}

TEST_CASE("A fit finds the components that the points were drawn from") {
  const StudentMixture truth = two_components();
  const auto data = equally_weighted_points(sample(truth, 4000, {.seed = 5}, 0));
  const StudentMixture fit = fit_mixture(data, MixtureFitOptions{}, {.seed = 6}, 0);
  REQUIRE(fit.size() >= 2);
  const Population fresh = sample(truth, 4000, {.seed = 7}, 0);
  const double divergence = (log_density(truth, fresh) - log_density(fit, fresh)).mean();
  CHECK(divergence < 0.02);
  CHECK(divergence > -1e-3);
}

TEST_CASE(
    "The fit of one component solves the equations of the maximum likelihood, in few dimensions and in "
    "many") {
  for (const Index d : {1, 2, 3, 4, 5, 6, 8}) {
    StudentMixture truth;
    truth.weights = Eigen::VectorXd::Ones(1);
    truth.means = Eigen::VectorXd::LinSpaced(d, 0.0, 3.0);
    truth.factors = {Eigen::MatrixXd::Identity(d, d)};
    truth.factors[0](d - 1, 0) += 0.7;
    WeightedPoints data = equally_weighted_points(sample(truth, 601, {.seed = 7}, 0));
    data.weights.head(100).setConstant(0.25);
    const MixtureFitOptions options{.most_iterations = 200, .tolerance = 1e-14};
    const StudentMixture fit = fit_mixture(data, 1, options, {.seed = 8}, 0);
    const Eigen::MatrixXd scale = fit.factors[0] * fit.factors[0].transpose();
    double pulls = 0.0;
    Eigen::VectorXd first = Eigen::VectorXd::Zero(d);
    Eigen::MatrixXd second = Eigen::MatrixXd::Zero(d, d);
    for (Index i = 0; i < 601; ++i) {
      const Eigen::VectorXd deviation = data.points.row(i).transpose() - fit.means;
      const double distance = fit.factors[0].triangularView<Eigen::Lower>().solve(deviation).squaredNorm();
      const double pull = data.weights[i] * (8.0 + static_cast<double>(d)) / (8.0 + distance);
      pulls += pull;
      first += pull * deviation;
      second += pull * deviation * deviation.transpose();
    }
    CHECK((first / pulls).cwiseAbs().maxCoeff() < 1e-5);
    CHECK((second / pulls - scale).cwiseAbs().maxCoeff() < 1e-5 * scale.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("Points of weight zero have no influence on a fit") {
  auto data = equally_weighted_points(sample(two_components(), 600, {.seed = 8}, 0));
  const StudentMixture without = fit_mixture(data, 2, {}, {.seed = 9}, 0);
  Population outlier(1, 2);
  outlier << 1e6, 1e6;
  auto more = equally_weighted_points(outlier);
  more.weights[0] = 0.0;
  WeightedPoints all{Population(601, 2), Eigen::VectorXd(601), data.groups};
  all.points << data.points, more.points;
  all.weights << data.weights, more.weights;
  all.groups.push_back(600);
  const StudentMixture with = fit_mixture(all, 2, {}, {.seed = 9}, 0);
  CHECK((with.means - without.means).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("Points drawn from one component get one, also where each is repeated in its group") {
  StudentMixture t;
  t.weights = Eigen::VectorXd::Ones(1);
  t.means = Eigen::MatrixXd::Zero(3, 1);
  t.factors = {Eigen::MatrixXd::Identity(3, 3)};
  const Population points = sample(t, 400, {.seed = 10}, 0);
  CHECK(fit_mixture(equally_weighted_points(points), MixtureFitOptions{}, {.seed = 11}, 0).size() == 1);
  WeightedPoints repeated{Population(1600, 3), Eigen::VectorXd::Ones(1600), {}};
  for (Index i = 0; i < 1600; ++i) {
    repeated.points.row(i) = points.row(i / 4);
    repeated.groups.push_back(i / 4);
  }
  CHECK(fit_mixture(repeated, MixtureFitOptions{}, {.seed = 11}, 0).size() == 1);
}

TEST_CASE("A coordinate without variance does not stop a fit, and no weight at all does") {
  auto data = equally_weighted_points(sample(two_components(), 200, {.seed = 12}, 0));
  data.points.col(1).setConstant(0.5);
  CHECK(std::isfinite(log_density(fit_mixture(data, 2, {}, {.seed = 13}, 0), data.points).sum()));
  data.weights.setZero();
  CHECK_THROWS_AS(fit_mixture(data, 2, {}, {.seed = 13}, 0), SamplingError);
}

TEST_CASE("A fit that starts from the last one is as near to new points as one from clusters") {
  const StudentMixture truth = two_components();
  const StudentMixture rough =
      fit_mixture(equally_weighted_points(sample(truth, 60, {.seed = 14}, 0)), 2, {}, {.seed = 15}, 0);
  const auto data = equally_weighted_points(sample(truth, 4000, {.seed = 16}, 0));
  const StudentMixture improved = improve_mixture(data, rough, {});
  CHECK(improved.size() <= rough.size());
  const Population fresh = sample(truth, 4000, {.seed = 17}, 0);
  const double before = (log_density(truth, fresh) - log_density(rough, fresh)).mean();
  const double after = (log_density(truth, fresh) - log_density(improved, fresh)).mean();
  CHECK(before > 0.03);
  CHECK(after < 0.01);
}

TEST_CASE("Separate modes are counted where the density falls between components") {
  const auto row_of = [](const std::vector<double>& places, const std::vector<double>& weights) {
    StudentMixture mixture;
    mixture.weights = Eigen::Map<const Eigen::VectorXd>(weights.data(), static_cast<Index>(weights.size()));
    mixture.means = Eigen::MatrixXd::Zero(2, mixture.weights.size());
    for (Index k = 0; k < mixture.size(); ++k) {
      mixture.means(0, k) = places[static_cast<std::size_t>(k)];
      mixture.factors.emplace_back(Eigen::MatrixXd::Identity(2, 2));
    }
    return mixture;
  };
  CHECK(detail::separate_modes(row_of({0.0}, {1.0})) == 1);
  CHECK(detail::separate_modes(row_of({0.0, 2.0}, {0.5, 0.5})) == 1);
  CHECK(detail::separate_modes(row_of({0.0, 10.0}, {0.5, 0.5})) == 2);
  CHECK(detail::separate_modes(row_of({0.0, 6.0, 3.0}, {0.3, 0.4, 0.3})) == 1);  // the third joins the others
  CHECK(detail::separate_modes(row_of({0.0, 10.0, 11.0, 20.0}, {0.3, 0.2, 0.2, 0.3})) == 3);
  CHECK(detail::separate_modes(row_of({0.0, 10.0}, {0.995, 0.005})) == 1);
}
