#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "errors/invalid_value.hpp"
#include "problems.hpp"
#include "tmcmc/modes.hpp"
#include "tmcmc/random_stream.hpp"

using namespace tmcmc;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

/// n rows, each made by a function of a stream of random numbers.
template <class Row>
Population rows_of(Index n, Index d, std::uint64_t seed, Row row) {
  Population points(n, d);
  for (Index i = 0; i < n; ++i) {
    RandomStream random({.seed = seed}, {.row = static_cast<std::uint64_t>(i)});
    points.row(i) = row(random).transpose();
  }
  return points;
}

Eigen::VectorXd normals(RandomStream& random, Index d) {
  Eigen::VectorXd x(d);
  for (Index j = 0; j < d; ++j) {
    x[j] = random.normal();
  }
  return x;
}

/// Centre of the k-th of five modes of unit width, 12 from each other or more.
Eigen::VectorXd centre(int k, Index d) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(d);
  if (k > 0) {
    x[(k - 1) % 2] = k < 3 ? 12.0 : -12.0;
    x[d - 1] += d > 2 ? 5.0 : 0.0;
  }
  return x;
}

/// Masses 1 : 2 : 3 : 4 : 5.
int mode_of_uniform(double u) {
  const double place = 15.0 * u;
  return place < 1 ? 0 : place < 3 ? 1 : place < 6 ? 2 : place < 10 ? 3 : 4;
}

Population five_modes(Index n, Index d, std::uint64_t seed) {
  return rows_of(n, d, seed, [d](RandomStream& random) -> Eigen::VectorXd {
    const int k = mode_of_uniform(random.uniform());
    return centre(k, d) + normals(random, d);
  });
}

}  // namespace

TEST_CASE("five narrow modes are told apart, with weights within their errors", "[modes]") {
  const Index d = GENERATE(2, 6);
  const Index n = GENERATE(1000, 5000);
  for (std::uint64_t seed = 1; seed <= (n < 2000 ? 4U : 1U); ++seed) {
    const auto modes = find_modes(five_modes(n, d, seed));
    REQUIRE(modes.modes.size() == 5);
    for (std::size_t k = 0; k < 5; ++k) {  // the heaviest first
      const Mode& mode = modes.modes[k];
      const double weight = static_cast<double>(5 - k) / 15.0;
      CHECK_THAT(mode.weight, WithinAbs(weight, 4.0 * mode.standard_error));
      CHECK_THAT(mode.standard_error,
                 WithinAbs(std::sqrt(weight * (1.0 - weight) / static_cast<double>(n)), 0.2 / std::sqrt(n)));
      const double error = 4.5 / std::sqrt(weight * static_cast<double>(n));
      const Eigen::VectorXd expected = centre(static_cast<int>(4 - k), d);
      CHECK((mode.mean - expected).cwiseAbs().maxCoeff() < error);
      CHECK((mode.standard_deviation.array() - 1.0).abs().maxCoeff() < error);
    }
    CHECK(modes.warnings.empty());
    CHECK(modes.of_sample.size() == static_cast<std::size_t>(n));
  }
}

TEST_CASE("modes are told apart whatever their widths, and however the space is stretched", "[modes]") {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto modes = find_modes(rows_of(1500, 3, seed, [](RandomStream& random) -> Eigen::VectorXd {
      Eigen::VectorXd x = normals(random, 3);
      if (random.uniform() < 0.3) {
        x *= 0.02;
        x[0] += 8.0;
      }
      x[1] = 1e3 * x[0] + 1e-2 * x[1];  // almost a function of the first
      x[2] *= 1e-6;
      return x;
    }));
    REQUIRE(modes.modes.size() == 2);
    CHECK_THAT(modes.modes[1].weight, WithinAbs(0.3, 4.0 * modes.modes[1].standard_error));
    CHECK_THAT(modes.modes[1].standard_deviation[2], WithinAbs(2e-8, 3e-9));
  }
}

TEST_CASE("a curved, skewed, heavy-tailed or flat posterior is one mode", "[modes]") {
  struct Shape {
    const char* name;
    Index d;
    Eigen::VectorXd (*row)(RandomStream&);
  };
  const std::vector<Shape> shapes = {
      {"normal, 2-D", 2, [](RandomStream& r) -> Eigen::VectorXd { return normals(r, 2); }},
      {"normal, 6-D", 6, [](RandomStream& r) -> Eigen::VectorXd { return normals(r, 6); }},
      {"normal, 15-D", 15, [](RandomStream& r) -> Eigen::VectorXd { return normals(r, 15); }},
      {"banana", 2,
       [](RandomStream& r) -> Eigen::VectorXd {
         const double x = r.normal();
         return Eigen::Vector2d(x, 2.0 * x * x + 0.1 * r.normal());
       }},
      {"horseshoe", 2,
       [](RandomStream& r) -> Eigen::VectorXd {
         const double angle = 5.5 * r.uniform();
         return Eigen::Vector2d(std::cos(angle) + 0.05 * r.normal(), std::sin(angle) + 0.05 * r.normal());
       }},
      {"funnel", 3,
       [](RandomStream& r) -> Eigen::VectorXd {
         const double v = 1.5 * r.normal();
         return Eigen::Vector3d(v, std::exp(v) * r.normal(), std::exp(v) * r.normal());
       }},
      {"heavy tails", 3,
       [](RandomStream& r) -> Eigen::VectorXd { return normals(r, 3) / std::fabs(r.normal()); }},
      {"uniform", 4,
       [](RandomStream& r) -> Eigen::VectorXd {
         Eigen::VectorXd x(4);
         for (Index j = 0; j < 4; ++j) {
           x[j] = r.uniform();
         }
         return x;
       }},
      {"one constant parameter", 2,
       [](RandomStream& r) -> Eigen::VectorXd { return Eigen::Vector2d(r.normal(), 3.0); }},
  };
  for (const auto& shape : shapes) {
    for (const Index n : {30, 300, 2000}) {
      for (std::uint64_t seed = 1; seed <= (n < 2000 ? 4U : 1U); ++seed) {
        INFO(shape.name << ", n = " << n << ", seed " << seed);
        const auto modes = find_modes(rows_of(n, shape.d, seed, shape.row));
        CHECK(modes.modes.size() == 1);
        CHECK(modes.modes[0].weight == Approx(1.0));
        CHECK(modes.modes[0].standard_error == 0.0);
        CHECK(modes.warnings.empty());
      }
    }
  }
}

TEST_CASE("samples that related chains have left around one maximum are one mode", "[modes]") {
  // Families of ten, each around an ancestor: what few moves after a resampling leave.
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto ancestors =
        rows_of(100, 4, seed, [](RandomStream& r) -> Eigen::VectorXd { return normals(r, 4); });
    Population points(1000, 4);
    for (Index i = 0; i < 1000; ++i) {
      RandomStream random({.seed = seed + 100}, {.row = static_cast<std::uint64_t>(i)});
      points.row(i) = ancestors.row(i % 100) + 0.3 * normals(random, 4).transpose();
    }
    CHECK(find_modes(points).modes.size() == 1);
  }
}

TEST_CASE("weighted draws have the modes of what they stand for", "[modes]") {
  // Draws from a wide normal, weighted to two narrow ones of 1 : 3 at -3 and 3.
  const auto points =
      rows_of(20000, 2, 3, [](RandomStream& r) -> Eigen::VectorXd { return 3.0 * normals(r, 2); });
  std::vector<double> weights;
  for (Index i = 0; i < points.rows(); ++i) {
    const auto log_normal = [&](double m) {
      const double a = (points(i, 0) - m) / 0.4;
      const double b = points(i, 1) / 0.4;
      return -0.5 * (a * a + b * b);
    };
    const double proposal = -0.5 * (points(i, 0) * points(i, 0) + points(i, 1) * points(i, 1)) / 9.0;
    weights.push_back((std::exp(log_normal(-3.0)) + 3.0 * std::exp(log_normal(3.0))) / std::exp(proposal));
  }
  const auto modes = find_modes(points, weights);
  REQUIRE(modes.modes.size() == 2);
  CHECK_THAT(modes.modes[0].weight, WithinAbs(0.75, 4.0 * modes.modes[0].standard_error));
  CHECK(modes.modes[0].standard_error < 0.03);
  CHECK(modes.modes[0].standard_error > 0.005);
  CHECK_THAT(modes.modes[0].mean[0], WithinAbs(3.0, 0.1));
  CHECK_THAT(modes.modes[1].mean[0], WithinAbs(-3.0, 0.1));
}

TEST_CASE("shares that few chains decide come with a large error and a warning", "[modes]") {
  auto points = five_modes(1000, 2, 4);
  Genealogy genealogy{10, {}};
  for (Index i = 0; i < points.rows(); ++i) {  // ten chains, each in one mode all the time
    RandomStream random({.seed = 5}, {.row = static_cast<std::uint64_t>(i)});
    points.row(i) = (centre(i % 10 < 3 ? 0 : 1, 2) + normals(random, 2)).transpose();
  }
  const auto modes = find_modes(points, {}, &genealogy);
  REQUIRE(modes.modes.size() == 2);
  CHECK_THAT(modes.modes[1].weight, WithinAbs(0.3, 1e-12));
  CHECK_THAT(modes.modes[1].standard_error, WithinAbs(std::sqrt(0.3 * 0.7 / 10.0), 0.05));
  REQUIRE(modes.warnings.size() == 2);
  CHECK_THAT(modes.warnings[1], Contains("mode 2"));
}

TEST_CASE("a run reports its modes: two of the same weight, and a ridge as one", "[modes]") {
  const Problem two{problems::by_rows([](const auto& x) {
                      const double a = -0.5 * ((x[0] - 3.0) * (x[0] - 3.0) + x[1] * x[1]) / 0.09;
                      const double b = -0.5 * ((x[0] + 3.0) * (x[0] + 3.0) + x[1] * x[1]) / 0.09;
                      const double larger = std::max(a, b);
                      return larger + std::log(std::exp(a - larger) + std::exp(b - larger));
                    }),
                    BoxPrior(Eigen::Vector2d(-5.0, -5.0), Eigen::Vector2d(5.0, 5.0))};
  const auto modes = find_modes(run(two, recommended_options(), {.seed = 2}));
  REQUIRE(modes.modes.size() == 2);
  CHECK_THAT(modes.modes[0].weight, WithinAbs(0.5, 4.0 * modes.modes[0].standard_error));
  CHECK_THAT(std::fabs(modes.modes[0].mean[0]), WithinAbs(3.0, 0.1));
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    CHECK(find_modes(problems::run_ridge(problems::few_samples(), {.seed = seed})).modes.size() == 1);
    CHECK(find_modes(problems::run_ridge(recommended_options(), {.seed = seed})).modes.size() == 1);
  }
}

TEST_CASE("points and weights that are invalid are refused", "[modes]") {
  const Population points = Population::Zero(3, 2);
  CHECK(find_modes(points).modes.size() == 1);
  CHECK_THROWS_AS(find_modes(Population(0, 2)), errors::InvalidValue);
  CHECK_THROWS_AS(find_modes(points, std::vector<double>{1.0}), errors::InvalidValue);
  CHECK_THROWS_AS(find_modes(points, std::vector<double>(3, 0.0)), errors::InvalidValue);
  CHECK_THROWS_AS(find_modes(points, std::vector<double>{1.0, -1.0, 1.0}), errors::InvalidValue);
  Population infinite = points;
  infinite(1, 1) = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(find_modes(infinite), errors::InvalidValue);
  CHECK_THROWS_AS(find_modes(points, {}, nullptr, {.neighbours = 1}), errors::InvalidValue);
}
