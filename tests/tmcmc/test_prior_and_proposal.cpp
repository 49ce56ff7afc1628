// The uniform prior, the proposal covariance (Eq. 5) and its factor.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tmcmc/detail/proposal_covariance.hpp"
#include "tmcmc/prior.hpp"
#include "tmcmc/statistics.hpp"

namespace {

using Catch::Matchers::Contains;
using tmcmc::BoxPrior;
using tmcmc::Centre;
using tmcmc::Index;
using tmcmc::Population;
using tmcmc::detail::cholesky_factor;
using tmcmc::detail::proposal_covariance;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double rounding = 1e-13;

std::vector<double> column(const Population& points, Index j) {
  return {points.col(j).begin(), points.col(j).end()};
}

struct Weighted {
  Population points;
  std::vector<double> weights;
  double sum = 0.0;
};

Weighted random_weighted(Index n, Index d, std::uint64_t seed) {
  statistics::Uniforms uniform(seed);
  Weighted result{Population(n, d), std::vector<double>(static_cast<std::size_t>(n))};
  for (Index i = 0; i < n; ++i) {
    for (Index j = 0; j < d; ++j) {
      result.points(i, j) = uniform(-1.0, 3.0) + (j > 0 ? 0.5 * result.points(i, j - 1) : 10.0);
    }
    auto& w = result.weights[static_cast<std::size_t>(i)];
    w = std::exp(-0.3 * result.points(i, 0)) * uniform();  // correlated with the points
    result.sum += w;
  }
  return result;
}

/// Eq. 5 as printed, in long double.
Eigen::MatrixXd exact_covariance(const Weighted& s, double scale, Centre centre) {
  const Index n = s.points.rows();
  const Index d = s.points.cols();
  long double total = 0.0L;
  for (const double w : s.weights) {
    total += w;
  }
  std::vector<long double> m(static_cast<std::size_t>(d), 0.0L);
  for (Index j = 0; j < d; ++j) {
    for (Index i = 0; i < n; ++i) {
      m[static_cast<std::size_t>(j)] +=
          s.points(i, j) * (centre == Centre::weighted_mean ? s.weights[static_cast<std::size_t>(i)] / total
                                                            : 1.0L / static_cast<long double>(n));
    }
  }
  Eigen::MatrixXd result(d, d);
  for (Index j = 0; j < d; ++j) {
    for (Index k = 0; k < d; ++k) {
      long double sum = 0.0L;
      for (Index i = 0; i < n; ++i) {
        sum += s.weights[static_cast<std::size_t>(i)] / total *
               (s.points(i, j) - m[static_cast<std::size_t>(j)]) *
               (s.points(i, k) - m[static_cast<std::size_t>(k)]);
      }
      result(j, k) = static_cast<double>(static_cast<long double>(scale) * scale * sum);
    }
  }
  return result;
}

Eigen::MatrixXd covariance_of(const Weighted& s, double scale, Centre centre) {
  return proposal_covariance(s.points, s.weights, s.sum, scale, centre);
}

double largest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("prior draws are uniform in the box and uncorrelated", "[tmcmc][prior]") {
  // Nine parameters need three blocks of words.
  const Index d = 9;
  Eigen::VectorXd lower(d);
  Eigen::VectorXd upper(d);
  for (Index j = 0; j < d; ++j) {
    lower[j] = -1.0 * static_cast<double>(j);
    upper[j] = lower[j] + std::pow(10.0, static_cast<double>(j) - 4.0);
  }
  const BoxPrior prior(lower, upper);
  CHECK(prior.dimension() == d);
  const Population points = prior.sample(20000, {.seed = 3});
  REQUIRE(points.rows() == 20000);
  REQUIRE(points.cols() == d);
  for (Index j = 0; j < d; ++j) {
    CAPTURE(j);
    CHECK(points.col(j).minCoeff() >= lower[j]);
    CHECK(points.col(j).maxCoeff() <= upper[j]);
    CHECK(statistics::kolmogorov(column(points, j), [&](double x) {
            return (x - lower[j]) / (upper[j] - lower[j]);
          }) < statistics::kolmogorov_bound);
    for (Index k = 0; k < j; ++k) {
      CAPTURE(k);
      CHECK(std::fabs(statistics::scaled_correlation(column(points, j), column(points, k))) <
            statistics::standard_errors);
    }
  }
}

TEST_CASE("prior draws depend on row and key alone", "[tmcmc][prior]") {
  const BoxPrior prior(Eigen::VectorXd::Zero(5), Eigen::VectorXd::Ones(5));
  const Population few = prior.sample(10, {.seed = 1});
  CHECK((prior.sample(1000, {.seed = 1}).topRows(10) == few));
  CHECK((prior.sample(10, {.seed = 2}) != few));
  CHECK((prior.sample(10, {.seed = 1, .run = 1}) != few));
  CHECK((prior.sample(10001, {.seed = 1}, /*threads=*/3) == prior.sample(10001, {.seed = 1})));
}

TEST_CASE("prior draws stay inside a box as narrow as three doubles", "[tmcmc][prior]") {
  const double middle = std::nextafter(1.0, 2.0);
  const BoxPrior prior(Eigen::VectorXd::Constant(1, 1.0),
                       Eigen::VectorXd::Constant(1, std::nextafter(middle, 2.0)));
  CHECK((prior.sample(1000, {}).array() == middle).all());  // none on a bound, whose logit is infinite
}

TEST_CASE("a prior without a box is refused, naming the parameter", "[tmcmc][prior]") {
  const auto box = [](double low, double high) {
    Eigen::VectorXd lower(2);
    Eigen::VectorXd upper(2);
    lower << 0.0, low;
    upper << 1.0, high;
    return BoxPrior(lower, upper);
  };
  CHECK_NOTHROW(box(-1.0, 1.0));
  for (const auto& [low, high] : {std::pair{1.0, 1.0},
                                  {2.0, 1.0},
                                  {1.0, std::nextafter(1.0, 2.0)},
                                  {-1.7e308, 1.7e308},
                                  {not_a_number, 1.0},
                                  {0.0, not_a_number},
                                  {-infinity, 1.0},
                                  {0.0, infinity}}) {
    CAPTURE(low, high);
    CHECK_THROWS_AS(box(low, high), std::invalid_argument);
    CHECK_THROWS_WITH(box(low, high), Contains("parameter 1"));
  }
  CHECK_THROWS_AS(BoxPrior(Eigen::VectorXd(), Eigen::VectorXd()), std::invalid_argument);
  CHECK_THROWS_AS(BoxPrior(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(2)), std::invalid_argument);
}

TEST_CASE("the proposal covariance is Eq. 5, about either mean", "[tmcmc][proposal]") {
  for (const Index n : {2, 7, 8, 9, 500, 10001}) {  // the last takes three blocks
    for (const Index d : {1, 2, 5}) {
      CAPTURE(n, d);
      const Weighted s = random_weighted(n, d, static_cast<std::uint64_t>(10 * n + d));
      for (const Centre centre : {Centre::weighted_mean, Centre::plain_mean}) {
        const Eigen::MatrixXd covariance = covariance_of(s, 0.2, centre);
        CHECK(largest_difference(covariance, exact_covariance(s, 0.2, centre)) < rounding);
        CHECK(covariance == covariance.transpose());
        CHECK(covariance == proposal_covariance(s.points, s.weights, s.sum, 0.2, centre, /*threads=*/3));
      }
    }
  }
}

TEST_CASE("the plain mean widens the proposal by the squared distance of the means", "[tmcmc][proposal]") {
  const Weighted s = random_weighted(300, 3, 5);
  const Eigen::VectorXd w = Eigen::Map<const Eigen::VectorXd>(s.weights.data(), 300) / s.sum;
  const Eigen::VectorXd shift = s.points.transpose() * w - s.points.colwise().mean().transpose();
  REQUIRE(shift.norm() > 0.05);
  const Eigen::MatrixXd difference =
      covariance_of(s, 0.2, Centre::plain_mean) - covariance_of(s, 0.2, Centre::weighted_mean);
  CHECK(largest_difference(difference, 0.04 * shift * shift.transpose()) < 1e-10);
}

TEST_CASE("the scale enters squared, the size of the weights not at all", "[tmcmc][proposal]") {
  Weighted s = random_weighted(50, 2, 6);
  const Eigen::MatrixXd unscaled = covariance_of(s, 1.0, Centre::weighted_mean);
  CHECK(largest_difference(covariance_of(s, 0.2, Centre::weighted_mean), 0.04 * unscaled) < rounding);
  for (double& w : s.weights) {
    w *= 0x1p-900;
  }
  s.sum *= 0x1p-900;
  CHECK(largest_difference(covariance_of(s, 1.0, Centre::weighted_mean), unscaled) < rounding);
}

TEST_CASE("one positive weight leaves no spread about the weighted mean", "[tmcmc][proposal]") {
  Weighted s = random_weighted(9, 2, 7);
  std::fill(s.weights.begin(), s.weights.end(), 0.0);
  s.weights[4] = 3.0;
  s.sum = 3.0;
  CHECK(covariance_of(s, 0.2, Centre::weighted_mean).isZero(0.0));
  CHECK(covariance_of(s, 0.2, Centre::plain_mean)(0, 0) > 0.0);
}

TEST_CASE("the Cholesky factor is lower triangular and its square the matrix", "[tmcmc][proposal]") {
  for (const Index d : {1, 2, 5, 12}) {
    CAPTURE(d);
    const Eigen::MatrixXd covariance = covariance_of(
        random_weighted(4 * d + 3, d, static_cast<std::uint64_t>(d)), 0.2, Centre::weighted_mean);
    const Eigen::MatrixXd factor = cholesky_factor(covariance);
    CHECK(largest_difference(factor * factor.transpose(), covariance) < rounding);
    CHECK(Eigen::MatrixXd(factor.triangularView<Eigen::StrictlyUpper>()).isZero(0.0));
    CHECK(factor.diagonal().minCoeff() > 0.0);
  }
}

TEST_CASE("the Cholesky factor copes with parameters on very different scales", "[tmcmc][proposal]") {
  Eigen::VectorXd scale(3);
  scale << 1e-150, 1.0, 1e120;
  Eigen::MatrixXd correlation(3, 3);
  correlation << 1.0, 0.5, -0.3, 0.5, 1.0, 0.2, -0.3, 0.2, 1.0;
  const Eigen::MatrixXd factor = cholesky_factor(scale.asDiagonal() * correlation * scale.asDiagonal());
  const Eigen::MatrixXd unscaled = scale.cwiseInverse().asDiagonal() * factor;
  CHECK(largest_difference(unscaled * unscaled.transpose(), correlation) < rounding);
}

TEST_CASE("a direction without variance gets a zero column", "[tmcmc][proposal]") {
  Eigen::MatrixXd perfect(3, 3);  // the second parameter is twice the first
  perfect << 1.0, 2.0, 0.5, 2.0, 4.0, 1.0, 0.5, 1.0, 3.0;
  const Eigen::MatrixXd factor = cholesky_factor(perfect);
  CHECK(factor.col(1).isZero(0.0));
  CHECK(largest_difference(factor * factor.transpose(), perfect) < rounding);

  Eigen::MatrixXd constant = Eigen::MatrixXd::Zero(3, 3);  // the second parameter is the same in all samples
  constant(0, 0) = 2.0;
  constant(2, 2) = 5.0;
  constant(0, 2) = constant(2, 0) = 1.0;
  const Eigen::MatrixXd singular = cholesky_factor(constant);
  CHECK(singular.row(1).isZero(0.0));
  CHECK(singular.col(1).isZero(0.0));
  CHECK(largest_difference(singular * singular.transpose(), constant) < rounding);

  CHECK(cholesky_factor(Eigen::MatrixXd::Zero(2, 2)).isZero(0.0));

  Weighted s = random_weighted(100, 2, 8);  // as above, with the rounding of a sum
  s.points.col(1) = 3.0 * s.points.col(0);
  const Eigen::MatrixXd rounded = covariance_of(s, 0.2, Centre::weighted_mean);
  CHECK(cholesky_factor(rounded).col(1).isZero(0.0));
}

TEST_CASE("rounding behind an almost singular direction is no negative variance", "[tmcmc][proposal]") {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    CAPTURE(seed);
    Weighted s = random_weighted(50, 4, seed);
    const Eigen::VectorXd first = s.points.col(0);
    const Eigen::VectorXd second = s.points.col(3);  // in the second parameter only in the sixth digit
    s.points.col(1) = first + 3e-6 * second;
    s.points.col(2) = first - second;
    const Eigen::MatrixXd covariance = covariance_of(s, 1.0, Centre::weighted_mean);
    const Eigen::MatrixXd factor = cholesky_factor(covariance);
    CHECK(largest_difference(factor * factor.transpose(), covariance) < 1e-2 * covariance.maxCoeff());
  }
}

TEST_CASE("a matrix that is no covariance is refused", "[tmcmc][proposal]") {
  Eigen::MatrixXd m(2, 2);
  m << 1.0, 2.0, 2.0, 1.0;
  CHECK_THROWS_AS(cholesky_factor(m), tmcmc::SamplingError);
  CHECK_THROWS_WITH(cholesky_factor(m), Contains("row 1"));
  m << -1.0, 0.0, 0.0, 1.0;
  CHECK_THROWS_AS(cholesky_factor(m), tmcmc::SamplingError);
  for (const double bad : {not_a_number, infinity}) {
    m << bad, 0.0, 0.0, 1.0;
    CHECK_THROWS_AS(cholesky_factor(m), tmcmc::SamplingError);
    m << 1.0, bad, bad, 1.0;
    CHECK_THROWS_AS(cholesky_factor(m), tmcmc::SamplingError);
    m << 1.0, 0.0, 0.0, bad;
    CHECK_THROWS_AS(cholesky_factor(m), tmcmc::SamplingError);
  }
}
