// Eq. 24 against a direct long double evaluation, and the contract of a batch.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "data/columns.hpp"
#include "errors/invalid_value.hpp"
#include "friction/likelihood.hpp"
#include "friction/long_double.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using friction::Likelihood;
using friction::LimitRule;
using friction::Observations;
using friction::PhaseRule;
using friction::Physics;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double reference_tolerance = 1e-9;  // relative; the table has 15 digits
constexpr double direct_tolerance = 1e-11;    // relative
constexpr double penalty = -1e10;

const Physics exact{};
const Physics published{.limit = LimitRule::grid, .phase = PhaseRule::discrete_bin};

/// Rows of (F_mu, omega_n, sigma_phase, sigma_r), uniform on a box; F_mu up to 1.3 times the exact
/// limit.
Eigen::MatrixXd random_points(Eigen::Index n, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(generator() >> 11U) * 0x1p-53);
  };
  Eigen::MatrixXd points(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    points.row(i) << uniform(0.01, 2.0), uniform(0.01, 10.0), uniform(0.001, 10.0), uniform(0.001, 1.0);
  }
  return points;
}

Eigen::VectorXd evaluate(const Likelihood& likelihood, const Eigen::MatrixXd& points) {
  Eigen::VectorXd values = Eigen::VectorXd::Constant(points.rows(), not_a_number);
  likelihood(points, values);
  return values;
}

/// Eq. 24 in long double: the product over the observations of two normal densities, one factor
/// after the other.
class DirectLikelihood {
 public:
  DirectLikelihood(const Observations& data, const Physics& physics)
      : data_(data),
        driving_force_n_(physics.driving_force_n),
        phases_(long_double::phases(data.measured_ratio, physics.phase)) {
    for (const double r : data.measured_ratio) {
      limit_ = std::min(limit_, friction::response_constants(r, physics).limit_force_ratio);
    }
  }

  double operator()(const Eigen::RowVector4d& theta) const {
    const auto log_normal = [](long double x, long double mean, long double sigma) {
      const long double z = (x - mean) / sigma;
      return -0.5L * z * z - std::log(sigma) - 0.5L * std::log(2.0L * long_double::pi);
    };
    if (theta[0] / driving_force_n_ > limit_) {
      return -infinity;
    }
    long double sum = 0.0L;
    for (std::size_t n = 0; n < data_.size(); ++n) {
      sum += log_normal(data_.nominal_ratio[n],
                        static_cast<long double>(data_.driving_frequency_hz[n]) / theta[1], theta[3]);
      sum += log_normal(data_.phase_deg[n], phases_[n](static_cast<long double>(theta[0]) / driving_force_n_),
                        theta[2]);
    }
    return static_cast<double>(sum);
  }

 private:
  const Observations& data_;
  double driving_force_n_;
  std::vector<long_double::Phase> phases_;
  double limit_ = infinity;
};

}  // namespace

TEST_CASE("log-likelihoods of the published physics against reference values", "[friction][likelihood]") {
  const auto reference =
      test_data::read_columns(test_data::source_directory() + "/tests/data/log_likelihood_discrete_bin.csv");
  const auto& expected = reference.at("log_likelihood");
  const auto n = static_cast<Eigen::Index>(expected.size());
  REQUIRE(n == 10);
  Eigen::MatrixXd points(n, 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(i);
    points.row(i) << reference.at("friction_force_n")[row], reference.at("natural_frequency_hz")[row],
        reference.at("phase_noise_deg")[row], reference.at("frequency_ratio_noise")[row];
  }
  const Likelihood likelihood(test_data::table1(), published, penalty);
  CHECK_THAT(likelihood.limit_friction_force_n(), WithinAbs(1.543632, 5e-7));
  const Eigen::VectorXd values = evaluate(likelihood, points);
  for (Eigen::Index i = 0; i < n; ++i) {
    CAPTURE(i);
    CHECK_THAT(values[i], WithinRel(expected[static_cast<std::size_t>(i)], reference_tolerance));
  }
}

TEST_CASE("a batch is Eq. 24, row by row, at every size", "[friction][likelihood]") {
  const Observations data = test_data::table1();
  for (const Physics& physics : {exact, published}) {
    const Likelihood likelihood(data, physics);
    const DirectLikelihood direct(data, physics);
    for (const Eigen::Index n : {1, 63, 64, 65, 1000}) {
      const Eigen::MatrixXd points = random_points(n, static_cast<std::uint64_t>(n));
      const Eigen::VectorXd values = evaluate(likelihood, points);
      Eigen::Index infeasible = 0;
      for (Eigen::Index i = 0; i < n; ++i) {
        CAPTURE(n, i, points.row(i));
        const double expected = direct(points.row(i));
        if (expected == -infinity) {
          CHECK(values[i] == -infinity);
          ++infeasible;
        } else {
          CHECK_THAT(values[i], WithinRel(expected, direct_tolerance) || WithinAbs(expected, 1e-11));
        }
      }
      CHECK((n == 1 || (infeasible > n / 10 && infeasible < n / 2)));
    }
  }
}

TEST_CASE("the log-likelihood is accurate up to the stick-slip limit", "[friction][likelihood]") {
  const Observations data = test_data::table1();
  for (const Physics& physics : {exact, published}) {
    const Likelihood likelihood(data, physics);
    const DirectLikelihood direct(data, physics);
    Eigen::MatrixXd points = random_points(2000, 11);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {  // below the limit by 1e-15 to 1 of it
      points(i, 0) = likelihood.limit_friction_force_n() *
                     (1.0 - std::pow(10.0, -15.0 * static_cast<double>(i) / 1999.0));
    }
    const Eigen::VectorXd values = evaluate(likelihood, points);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      CAPTURE(i, points.row(i));
      CHECK_THAT(values[i], WithinRel(direct(points.row(i)), direct_tolerance));
    }
  }
}

TEST_CASE("the phases of a batch are accurate to 1e-10 deg", "[friction][likelihood]") {
  // One observation of 0 deg with unit noise levels and no misfit of the frequency: the phase is
  // what is left.
  constexpr double phase_tolerance = 1e-10;  // deg
  constexpr Eigen::Index n = 1000;
  std::vector<double> ratios = test_data::table1().measured_ratio;
  // Not within 1 % of a resonance, where U has the condition number of tan beside pi/2: 1e-9 deg
  // there.
  ratios.insert(ratios.end(), {0.22, 0.38, 0.5, 0.55, 0.9, 1.1, 2.5, 4.0, 10.0});
  const Eigen::MatrixXd random = random_points(n, 12);
  for (const Physics& physics : {exact, published}) {
    for (const double r : ratios) {
      const Likelihood likelihood({{r}, {r}, {r}, {0.0}}, physics);
      const long_double::Phase phase(r, physics.phase);
      Eigen::MatrixXd points = Eigen::MatrixXd::Ones(n, 4);
      for (Eigen::Index i = 0; i < n; ++i) {  // half of them uniform, half of them close to the limit
        const double fraction = i % 2 == 0 ? random(i, 0) / 2.0 : 1.0 - std::pow(10.0, -1.6 * random(i, 1));
        points(i, 0) = likelihood.limit_friction_force_n() * fraction;
      }
      points(n - 1, 0) = likelihood.limit_friction_force_n() * (1.0 - 1e-15);
      const Eigen::VectorXd values = evaluate(likelihood, points);
      for (Eigen::Index i = 0; i < n; ++i) {
        const long double squared = -2.0L * (values[i] + std::log(2.0L * long_double::pi));
        const auto found = static_cast<double>(std::sqrt(std::max(squared, 0.0L)));
        CAPTURE(r, i, points(i, 0));
        CHECK_THAT(found, WithinAbs(static_cast<double>(phase(points(i, 0) / physics.driving_force_n)),
                                    phase_tolerance));
      }
    }
  }
}

TEST_CASE("a row has the same bits alone, in any batch, in any order and in a block of a larger matrix",
          "[friction][likelihood]") {
  const Likelihood likelihood(test_data::table1(), exact);
  constexpr Eigen::Index n = 200;
  const Eigen::MatrixXd points = random_points(n, 7);
  const Eigen::VectorXd values = evaluate(likelihood, points);

  const Eigen::MatrixXd reversed = points.colwise().reverse();
  CHECK((evaluate(likelihood, reversed) == values.reverse()));

  for (Eigen::Index i = 0; i < n; ++i) {
    CAPTURE(i);
    CHECK(evaluate(likelihood, points.row(i))[0] == values[i]);
  }

  for (const Eigen::Index first : {1, 63, 100}) {
    CHECK((evaluate(likelihood, points.bottomRows(n - first)) == values.tail(n - first)));
  }

  Eigen::MatrixXd frame = Eigen::MatrixXd::Constant(n + 9, 7, not_a_number);
  frame.block(3, 2, n, 4) = points;
  Eigen::VectorXd long_values = Eigen::VectorXd::Constant(n + 5, 77.0);
  likelihood(frame.block(3, 2, n, 4), long_values.segment(2, n));
  CHECK((long_values.segment(2, n) == values));
  CHECK(long_values.head(2) == Eigen::Vector2d::Constant(77.0));
  CHECK(long_values.tail(3) == Eigen::Vector3d::Constant(77.0));
}

TEST_CASE("an empty batch is no error", "[friction][likelihood]") {
  const Likelihood likelihood(test_data::table1(), exact);
  CHECK(evaluate(likelihood, Eigen::MatrixXd(0, 4)).size() == 0);
}

TEST_CASE("infeasible friction forces have the value asked for", "[friction][likelihood]") {
  for (const double value : {-infinity, penalty, -1.0}) {
    const Likelihood likelihood(test_data::table1(), exact, value);
    CHECK(likelihood.infeasible_log_likelihood() == value);
    const double limit = likelihood.limit_friction_force_n();
    CHECK_THAT(limit, WithinAbs(1.501094, 5e-7));
    Eigen::MatrixXd points(5, 4);
    for (Eigen::Index i = 0; i < 5; ++i) {
      points.row(i) << 0.0, 3.0, 2.0, 0.01;
    }
    points(0, 0) = limit * (1.0 - 1e-12);
    points(1, 0) = limit * (1.0 + 1e-12);
    points(2, 0) = -1e-9;
    points(3, 0) = 1e300;
    points(4, 0) = 0.0;
    const Eigen::VectorXd values = evaluate(likelihood, points);
    CHECK(std::isfinite(values[0]));
    CHECK(values[0] < -20.0);
    CHECK(values[1] == value);
    CHECK(values[2] == value);
    CHECK(values[3] == value);
    CHECK(std::isfinite(values[4]));
    CHECK(values[4] < -20.0);
  }
  CHECK(Likelihood(test_data::table1(), exact).infeasible_log_likelihood() == -infinity);
}

TEST_CASE("the order of the observations leaves the limit of continuous motion as it is",
          "[friction][likelihood]") {
  const Observations data = test_data::table1();
  Observations reversed = data;
  for (auto* column : {&reversed.nominal_ratio, &reversed.measured_ratio, &reversed.driving_frequency_hz,
                       &reversed.phase_deg}) {
    std::reverse(column->begin(), column->end());
  }
  const Eigen::MatrixXd points = random_points(500, 8);
  const Eigen::VectorXd values = evaluate(Likelihood(data, exact), points);
  const Eigen::VectorXd others = evaluate(Likelihood(reversed, exact), points);
  CHECK((values.array() == -infinity).count() > 50);
  CHECK(((values.array() == -infinity) == (others.array() == -infinity)).all());
}

TEST_CASE("the likelihood is the product of its two parts", "[friction][likelihood]") {
  const Observations data = test_data::table1();
  const Likelihood likelihood(data, exact);
  const Eigen::MatrixXd points = random_points(100, 8);
  const Eigen::VectorXd values = evaluate(likelihood, points);
  const double n = static_cast<double>(likelihood.observation_count());
  CHECK(likelihood.observation_count() == 10);
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    CAPTURE(points.row(i));
    const double phase = likelihood.phase_misfit(points(i, 0));
    double frequency = 0.0;
    for (std::size_t j = 0; j < data.size(); ++j) {
      frequency += std::pow(data.nominal_ratio[j] - data.driving_frequency_hz[j] / points(i, 1), 2);
    }
    CHECK_THAT(likelihood.frequency_misfit(points(i, 1)), WithinRel(frequency, direct_tolerance));
    if (values[i] == -infinity) {
      CHECK(std::isnan(phase));
    } else {
      const double expected = -n * std::log(2.0 * std::numbers::pi * points(i, 2) * points(i, 3)) -
                              0.5 * phase / (points(i, 2) * points(i, 2)) -
                              0.5 * frequency / (points(i, 3) * points(i, 3));
      CHECK_THAT(values[i], WithinRel(expected, direct_tolerance) || WithinAbs(expected, direct_tolerance));
    }
  }
}

TEST_CASE("noise levels and natural frequency have their closed-form maximum", "[friction][likelihood]") {
  // At given F_mu the best sigma_phase is sqrt(misfit / n); the best 1/omega_n is linear least
  // squares.
  const Observations data = test_data::table1();
  double squares = 0.0;
  double products = 0.0;
  for (std::size_t j = 0; j < data.size(); ++j) {
    squares += data.driving_frequency_hz[j] * data.driving_frequency_hz[j];
    products += data.driving_frequency_hz[j] * data.nominal_ratio[j];
  }
  const double best_frequency = squares / products;
  for (const Physics& physics : {exact, published}) {
    const Likelihood likelihood(data, physics);
    CHECK_THAT(std::sqrt(likelihood.frequency_misfit(best_frequency) / 10.0), WithinAbs(0.01222, 5e-6));
    for (const double force : {0.5, 0.98, 1.086, 1.4}) {
      Eigen::MatrixXd best(1, 4);
      best << force, best_frequency, std::sqrt(likelihood.phase_misfit(force) / 10.0),
          std::sqrt(likelihood.frequency_misfit(best_frequency) / 10.0);
      for (Eigen::Index j = 1; j < 4; ++j) {
        for (const double factor : {0.9999, 1.0001}) {
          CAPTURE(force, j, factor);
          Eigen::MatrixXd beside = best;
          beside(0, j) *= factor;
          CHECK(evaluate(likelihood, beside)[0] < evaluate(likelihood, best)[0]);
        }
      }
    }
  }
}

TEST_CASE("the driving force scales the friction force", "[friction][likelihood]") {
  Physics doubled = exact;
  doubled.driving_force_n = 5.0;
  const Likelihood once(test_data::table1(), exact);
  const Likelihood twice(test_data::table1(), doubled);
  CHECK(twice.driving_force_n() == 5.0);
  CHECK_THAT(twice.limit_friction_force_n(), WithinRel(2.0 * once.limit_friction_force_n(), 1e-14));
  CHECK_THAT(twice.phase_misfit(2.0), WithinRel(once.phase_misfit(1.0), direct_tolerance));
}

TEST_CASE("shapes that do not fit are refused", "[friction][likelihood]") {
  const Likelihood likelihood(test_data::table1(), exact);
  Eigen::VectorXd values(3);
  CHECK_THROWS_AS(likelihood(Eigen::MatrixXd::Ones(3, 3), values), errors::InvalidValue);
  CHECK_THROWS_AS(likelihood(Eigen::MatrixXd::Ones(3, 5), values), errors::InvalidValue);
  CHECK_THROWS_AS(likelihood(Eigen::MatrixXd::Ones(2, 4), values), errors::InvalidValue);
  CHECK_NOTHROW(likelihood(Eigen::MatrixXd::Ones(3, 4), values));
}

TEST_CASE("observations out of range are refused by field, row and value", "[friction][likelihood]") {
  const auto refused = [](const std::function<void(Observations&)>& change, const std::string& message) {
    Observations data = test_data::table1();
    change(data);
    CHECK_THROWS_AS(data.validate(), errors::InvalidValue);
    CHECK_THROWS_WITH(data.validate(), Contains(message));
    CHECK_THROWS_AS(Likelihood(data, exact), errors::InvalidValue);
  };
  CHECK_NOTHROW(test_data::table1().validate());
  CHECK(test_data::table1().size() == 10);
  refused([](Observations& o) { o = {}; }, "at least one row");
  refused([](Observations& o) { o.nominal_ratio.pop_back(); }, "length");
  refused([](Observations& o) { o.measured_ratio.pop_back(); }, "length");
  refused([](Observations& o) { o.driving_frequency_hz.pop_back(); }, "length");
  refused([](Observations& o) { o.phase_deg.pop_back(); }, "length");
  for (const double bad : {0.0, -1.0, infinity, not_a_number}) {
    CAPTURE(bad);
    refused([=](Observations& o) { o.nominal_ratio[2] = bad; }, "nominal_ratio[2] = ");
    refused([=](Observations& o) { o.measured_ratio[0] = bad; }, "measured_ratio[0] = ");
    refused([=](Observations& o) { o.driving_frequency_hz[9] = bad; }, "driving_frequency_hz[9] = ");
  }
  for (const double bad : {infinity, -infinity, not_a_number, 360.5, -1e4}) {
    refused([=](Observations& o) { o.phase_deg[4] = bad; }, "phase_deg[4] = ");
  }
  refused([](Observations& o) { o.measured_ratio[3] = 1.0; }, "measured_ratio[3] = 1:");
  refused([](Observations& o) { o.measured_ratio[3] = 1.0 / 3.0; }, "measured_ratio[3]");
}

TEST_CASE("a driving force that is none is refused by value", "[friction][likelihood]") {
  for (const double bad : {0.0, -2.5, infinity, not_a_number}) {
    Physics physics = exact;
    physics.driving_force_n = bad;
    CHECK_THROWS_AS(Likelihood(test_data::table1(), physics), errors::InvalidValue);
    CHECK_THROWS_WITH(Likelihood(test_data::table1(), physics), Contains("driving_force_n = "));
  }
}

TEST_CASE("a phase written with a turn more or less has the same likelihood", "[friction][likelihood]") {
  // A rig that is driven ten times as hard has phases close to 0 and 180 deg, where noise crosses
  // the half turn.
  const Physics hard{.driving_force_n = 25.0};
  Observations data = test_data::table1();
  for (std::size_t i = 0; i < data.size(); ++i) {
    const double phase =
        friction::phase_deg(friction::response_constants(data.measured_ratio[i], hard), 0.02);
    data.phase_deg[i] = phase + (i % 2 == 0 ? 2.75 : -2.75);
  }
  const auto above =
      std::count_if(data.phase_deg.begin(), data.phase_deg.end(), [](double p) { return p > 180.0; });
  REQUIRE(above > 0);
  const Eigen::MatrixXd points = random_points(200, 11);
  const Likelihood likelihood(data, hard);
  const Eigen::VectorXd expected = evaluate(likelihood, points);
  for (std::size_t i = 0; i < data.size(); ++i) {
    CAPTURE(i);
    Observations same = data;
    same.phase_deg[i] -= same.phase_deg[i] > 0.0 ? 360.0 : -360.0;
    const Likelihood turned(same, hard);
    const Eigen::VectorXd values = evaluate(turned, points);
    for (Eigen::Index row = 0; row < points.rows(); ++row) {
      REQUIRE_THAT(values[row], WithinRel(expected[row], direct_tolerance));
    }
    CHECK_THAT(turned.phase_misfit(0.5), WithinRel(likelihood.phase_misfit(0.5), direct_tolerance));
  }
}

TEST_CASE("phases of a doubtful unit or sign are told apart from phases", "[friction]") {
  using friction::doubtful_unit_or_sign;
  const auto lags = test_data::table1().phase_deg;
  CHECK(doubtful_unit_or_sign(lags).empty());
  std::vector<double> radians, leads, both;
  for (const double phase : lags) {
    radians.push_back(phase * std::numbers::pi / 180.0);
    leads.push_back(-phase);
    both.push_back(-radians.back());
  }
  CHECK_THAT(doubtful_unit_or_sign(radians), Contains("as degrees") && !Contains("negative"));
  CHECK_THAT(doubtful_unit_or_sign(leads), Contains("negative") && !Contains("degrees"));
  CHECK_THAT(doubtful_unit_or_sign(both), Contains("as degrees") && Contains("negative"));
  leads[4] = 150.0;
  CHECK(doubtful_unit_or_sign(leads).empty());
  radians[4] = 6.3;
  CHECK(doubtful_unit_or_sign(radians).empty());
  CHECK(doubtful_unit_or_sign({3.0, -2.0}).empty());  // two rows are not several
  CHECK(doubtful_unit_or_sign({0.0, 0.0, 0.0}).empty());
}
