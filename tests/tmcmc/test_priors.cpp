// Priors of several parameters: draws, densities, names, correlations, and what is refused.
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "errors/invalid_value.hpp"
#include "tmcmc/prior.hpp"
#include "tmcmc/problems.hpp"
#include "tmcmc/statistics.hpp"
#include "tmcmc/unbounded_coordinates.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using tmcmc::Correlation;
using tmcmc::CorrelationOf;
using tmcmc::Index;
using tmcmc::Marginal;
using tmcmc::Population;
using tmcmc::Prior;

namespace {

std::vector<double> column(const Population& points, Index j) {
  return {points.col(j).begin(), points.col(j).end()};
}

Eigen::Matrix3d three_correlations() {
  Eigen::Matrix3d r;
  r << 1.0, 0.7, -0.3, 0.7, 1.0, 0.2, -0.3, 0.2, 1.0;
  return r;
}

std::vector<tmcmc::Parameter> three_parameters() {
  return {{"stiffness", "N/m", Marginal::log_normal_of_mean(3.0, 1.0)},
          {"damping", "", Marginal::beta(2.0, 5.0)},
          {"offset", "m", Marginal::gumbel(1.0, 2.0)}};
}

std::string refused(const std::function<void()>& make) {
  try {
    make();
  } catch (const errors::InvalidValue& error) {
    return error.what();
  }
  return "accepted";
}

/// z ~ N(0, 1), x given z ~ N(z, 0.5), x restricted to nothing: a hierarchical prior.
tmcmc::OwnPrior hierarchy() {
  return {.description = "normal about a normal",
          .parameters = {{"centre"}, {"value"}},
          .log_density = problems::by_rows([](const auto& x) {
            const double d = (x[1] - x[0]) / 0.5;
            return -0.5 * (x[0] * x[0] + d * d) - std::log(2.0 * 3.14159265358979323846 * 0.5);
          }),
          .draw = [](tmcmc::RandomStream& stream, Eigen::Ref<Eigen::VectorXd> x) {
            x[0] = stream.normal();
            x[1] = x[0] + 0.5 * stream.normal();
          }};
}

}  // namespace

TEST_CASE("uniform marginals are the box, to the last bit", "[tmcmc][prior]") {
  const Prior box(Eigen::Vector2d(-1.0, 2.0), Eigen::Vector2d(3.0, 2.5));
  const Prior named({{"a", "N", Marginal::uniform(-1.0, 3.0)}, {"b", "", Marginal::uniform(2.0, 2.5)}});
  CHECK(named.is_box());
  CHECK((named.sample(1000, {.seed = 4}) == box.sample(1000, {.seed = 4})));
  CHECK(box.names() == std::vector<std::string>{"parameter 0", "parameter 1"});
  CHECK(named.names() == std::vector<std::string>{"a", "b"});
  CHECK(named.units() == std::vector<std::string>{"N", ""});
  CHECK(named.text() == "a uniform(-1, 3), b uniform(2, 2.5)");
  CHECK_THAT(box.log_density(Eigen::MatrixXd::Constant(1, 2, 2.2))[0], WithinRel(-std::log(2.0), 1e-15));
}

TEST_CASE("each marginal of a prior has its distribution and no correlation with the others",
          "[tmcmc][prior]") {
  const auto parameters = three_parameters();
  const Population points = Prior(parameters).sample(20000, {.seed = 5}, /*threads=*/2);
  for (Index j = 0; j < 3; ++j) {
    CHECK(statistics::kolmogorov(column(points, j), [&](double x) {
            return parameters[static_cast<std::size_t>(j)].marginal.cdf(x);
          }) < statistics::kolmogorov_bound);
    CHECK(std::fabs(statistics::scaled_correlation(column(points, j), column(points, (j + 1) % 3))) <
          statistics::standard_errors);
  }
}

TEST_CASE("a Gaussian copula keeps the marginals and correlates the normal scores", "[tmcmc][prior]") {
  const auto parameters = three_parameters();
  const Prior prior(parameters, {three_correlations()});
  constexpr Index n = 20000;
  const Population points = prior.sample(n, {.seed = 6});
  CHECK((prior.sample(n, {.seed = 6}, /*threads=*/3) == points));
  Population scores(n, 3);
  for (Index j = 0; j < 3; ++j) {
    const Marginal& marginal = parameters[static_cast<std::size_t>(j)].marginal;
    CHECK(statistics::kolmogorov(column(points, j), [&](double x) { return marginal.cdf(x); }) <
          statistics::kolmogorov_bound);
    scores.col(j) = points.col(j).unaryExpr([&](double x) { return marginal.normal_score(x); });
  }
  for (Index i = 0; i < 3; ++i) {
    for (Index j = 0; j < i; ++j) {
      const double root_n = std::sqrt(static_cast<double>(n));
      const double rho = three_correlations()(i, j);
      const double r = statistics::scaled_correlation(column(scores, i), column(scores, j)) / root_n;
      // Fisher's transformation is normal with variance 1 / (n - 3).
      CHECK_THAT(std::atanh(r), WithinAbs(std::atanh(rho), statistics::standard_errors / root_n));
    }
  }
}

TEST_CASE("the density of a copula of normal marginals is the multivariate normal one", "[tmcmc][prior]") {
  const Prior prior({{"a", "", Marginal::normal(1.0, 2.0)}, {"b", "", Marginal::normal(-1.0, 0.5)}},
                    {(Eigen::Matrix2d() << 1.0, 0.8, 0.8, 1.0).finished()});
  for (const auto& x : {Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(3.0, -2.0)}) {
    const double u = (x[0] - 1.0) / 2.0;
    const double v = (x[1] + 1.0) / 0.5;
    const double expected = -0.5 * (u * u - 2.0 * 0.8 * u * v + v * v) / (1.0 - 0.64) -
                            std::log(2.0 * 3.14159265358979323846 * 2.0 * 0.5 * 0.6);
    CHECK_THAT(prior.log_density(x.transpose())[0], WithinRel(expected, 1e-13));
  }
}

TEST_CASE("correlations of the parameters are met through those of the normal scores", "[tmcmc][prior]") {
  // Two log-normal parameters: exp(s_a s_b rho) - 1 over the coefficients of variation.
  const Marginal a = Marginal::log_normal(0.0, 0.5);
  const Marginal b = Marginal::log_normal(1.0, 0.8);
  const auto exact = [](double rho) {
    return std::expm1(0.4 * rho) / std::sqrt(std::expm1(0.25) * std::expm1(0.64));
  };
  for (const double rho : {-0.9, -0.3, 0.5, 0.95}) {
    CHECK_THAT(tmcmc::parameter_correlation(a, b, rho), WithinRel(exact(rho), 1e-8));
  }
  // Two uniform ones: 6 / pi arcsin(rho / 2).
  const Marginal u = Marginal::uniform(0.0, 1.0);
  CHECK_THAT(tmcmc::parameter_correlation(u, u, 0.6),
             WithinRel(6.0 / 3.14159265358979323846 * std::asin(0.3), 1e-8));
  const std::vector<Marginal> pair{a, b};
  const Eigen::Matrix2d target = (Eigen::Matrix2d() << 1.0, 0.4, 0.4, 1.0).finished();
  const Eigen::MatrixXd scores = tmcmc::normal_score_correlation({target, CorrelationOf::parameters}, pair);
  CHECK_THAT(exact(scores(0, 1)), WithinRel(0.4, 1e-8));

  const Prior prior({{"a", "", a}, {"b", "", b}}, {target, CorrelationOf::parameters});
  constexpr Index n = 100000;
  const Population x = prior.sample(n, {.seed = 8});
  std::vector<double> products;
  const double mean_a = std::exp(0.125);
  const double mean_b = std::exp(1.32);
  const double unit = mean_a * mean_b * std::sqrt(std::expm1(0.25) * std::expm1(0.64));
  for (Index i = 0; i < n; ++i) {
    products.push_back((x(i, 0) - mean_a) * (x(i, 1) - mean_b) / unit);
  }
  CHECK(statistics::estimate(products).errors_from(0.4) < statistics::standard_errors);
}

TEST_CASE("correlations that cannot be are refused with what can", "[tmcmc][prior]") {
  const auto with = [](const Eigen::MatrixXd& matrix, CorrelationOf of = CorrelationOf::normal_scores) {
    return refused([&] {
      Prior({{"a", "", Marginal::log_normal(0.0, 1.5)},
             {"b", "", Marginal::normal(0.0, 1.0)},
             {"c", "", Marginal::student_t(2.0, 0.0, 1.0)}},
            {matrix, of});
    });
  };
  Eigen::Matrix3d r = Eigen::Matrix3d::Identity();
  CHECK(with(r) == "accepted");
  CHECK_THAT(with(Eigen::Matrix2d::Identity()),
             Contains("2 x 2: expected a row and a column for each of the 3"));
  r(0, 1) = 0.5;
  CHECK_THAT(with(r), Contains("the same number as on the other side"));
  r(1, 0) = 0.5;
  r(2, 0) = r(0, 2) = 0.9;
  r(2, 1) = r(1, 2) = -0.9;
  CHECK_THAT(with(r), Contains("positive definite"));
  r(2, 1) = r(1, 2) = 1.5;
  CHECK_THAT(with(r), Contains("correlation(2, 1) = 1.5: expected a number between -1 and 1"));
  r = Eigen::Matrix3d::Identity();
  r(1, 1) = 2.0;
  CHECK_THAT(with(r), Contains("1 on the diagonal"));
  r = Eigen::Matrix3d::Identity();
  r(0, 1) = r(1, 0) = -0.95;  // a log-normal of sigma 1.5 and a normal: at most 1.5 / sqrt(e^2.25 - 1) = 0.51
  CHECK_THAT(with(r, CorrelationOf::parameters), Contains("a number from -0.51"));
  r = Eigen::Matrix3d::Identity();
  r(2, 1) = r(1, 2) = 0.5;
  CHECK_THAT(with(r, CorrelationOf::parameters),
             Contains("student_t(2, 0, 1): expected a distribution with a finite variance"));
}

TEST_CASE("names and functions that a prior lacks are named", "[tmcmc][prior]") {
  CHECK_THAT(refused([] { Prior(std::vector<tmcmc::Parameter>{}); }), Contains("at least one"));
  CHECK_THAT(refused([] {
               Prior({{"k", "", Marginal::half_normal(1.0)}, {"k", "", Marginal::half_normal(1.0)}});
             }),
             Contains("name = k: expected a name for each parameter that no other has"));
  auto own = hierarchy();
  own.description = "two\nlines";
  CHECK_THAT(refused([&] { Prior{own}; }), Contains("one line"));
  own = hierarchy();
  own.draw = {};
  CHECK_THAT(refused([&] { Prior{own}; }), Contains("a function draw"));
  own = hierarchy();
  own.parameters[1].support = {2.0, 2.0};
  CHECK_THAT(refused([&] { Prior{own}; }), Contains("value.support.upper = 2"));
}

TEST_CASE("a prior of the user's own draws by itself, and errors in it are found", "[tmcmc][prior]") {
  const Prior prior(hierarchy());
  const Population points = prior.sample(20000, {.seed = 9}, /*threads=*/2);
  CHECK((prior.sample(20000, {.seed = 9}) == points));
  CHECK(statistics::kolmogorov(column(points, 1), [](double x) {
          return statistics::normal_cdf(x / std::sqrt(1.25));
        }) < statistics::kolmogorov_bound);
  CHECK(prior.text() == "normal about a normal");
  auto own = hierarchy();
  own.parameters[0].support = {0.0, 10.0};
  CHECK_THROWS_WITH(Prior{own}.sample(10, {}),
                    Contains("the prior has drawn centre = -") && Contains("in its support, from 0 to 10"));
  own = hierarchy();
  own.log_density = problems::by_rows([](const auto&) { return NAN; });
  CHECK_THROWS_WITH(Prior{own}.log_density(points.topRows(3)),
                    Contains("the log-density of the prior is nan at ("));
}

TEST_CASE("unbounded coordinates follow the support and come back", "[tmcmc][prior]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Prior prior({{"two", "", Marginal::beta(2.0, 2.0, -1.0, 3.0)},
                     {"lower", "", Marginal::truncated_normal(0.0, 1.0, -2.0, infinity)},
                     {"upper", "", Marginal::truncated_normal(0.0, 1.0, -infinity, 2.0)},
                     {"none", "", Marginal::student_t(3.0, 0.0, 1.0)}});
  const Population x = prior.sample(500, {.seed = 10});
  const Population z = tmcmc::to_unbounded(x, prior);
  CHECK((z.col(3) == x.col(3)));
  CHECK_THAT(z(0, 1), WithinRel(std::log(x(0, 1) + 2.0), 1e-14));
  CHECK_THAT(z(0, 2), WithinRel(-std::log(2.0 - x(0, 2)), 1e-14));
  CHECK((tmcmc::from_unbounded(z, prior) - x).cwiseAbs().maxCoeff() < 1e-13);
  // The density of the coordinates by differences of the map.
  const Eigen::VectorXd density = tmcmc::log_prior_density(z, prior);
  for (Index i = 0; i < 5; ++i) {
    double expected = prior.log_density(x.row(i))[0];
    for (Index j = 0; j < 4; ++j) {
      Population step = z.row(i);
      step(0, j) += 1e-6;
      const double up = tmcmc::from_unbounded(step, prior)(0, j);
      step(0, j) -= 2e-6;
      expected += std::log((up - tmcmc::from_unbounded(step, prior)(0, j)) / 2e-6);
    }
    CHECK_THAT(density[i], WithinAbs(expected, 1e-7));
  }
}
