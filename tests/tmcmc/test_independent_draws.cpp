// A posterior measured by independent draws from a fitted density.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "errors/invalid_value.hpp"
#include "problems.hpp"
#include "tmcmc/reference_search.hpp"
#include "tmcmc/sampler.hpp"
#include "tmcmc/weighted_samples.hpp"

using namespace tmcmc;

namespace {

const double log_two_pi = std::log(2.0 * std::acos(-1.0));

/// Correlated normal density in two dimensions on [-10, 10]^2: log-evidence -2 log 20.
Problem normal() {
  return {problems::by_rows([](const auto& x) {
            constexpr double rho = 0.7;
            const double q = (x[0] * x[0] - 2.0 * rho * x[0] * x[1] + x[1] * x[1]) / (1.0 - rho * rho);
            return -0.5 * q - 0.5 * std::log(1.0 - rho * rho) - log_two_pi;
          }),
          BoxPrior(Eigen::Vector2d(-10.0, -10.0), Eigen::Vector2d(10.0, 10.0))};
}
const double log_evidence_of_normal = -2.0 * std::log(20.0);

/// Five normal modes of equal mass, 0.1 wide, in the same square.
Problem five_modes() {
  return {problems::by_rows([](const auto& x) {
            constexpr double places[5][2] = {{-5, -5}, {6, -3}, {-6, 5}, {1, 1}, {5, 6}};
            double sum = 1e-300;
            for (const auto& place : places) {
              const double a = x[0] - place[0];
              const double b = x[1] - place[1];
              sum += std::exp(-50.0 * (a * a + b * b));
            }
            return std::log(sum);
          }),
          BoxPrior(Eigen::Vector2d(-10.0, -10.0), Eigen::Vector2d(10.0, 10.0))};
}

/// Two normal modes in ten coordinates with the masses 3/4 and 1/4, which one search or both lose
/// in most runs.
Problem two_far_modes() {
  return {problems::by_rows([](const auto& x) {
            const double first = -2.0 * (x.array() - 4.0).square().sum();
            const double second = -2.0 * (x.array() + 4.0).square().sum();
            const double largest = std::max(first, second);
            return largest + std::log(0.75 * std::exp(first - largest) + 0.25 * std::exp(second - largest));
          }),
          BoxPrior(Eigen::VectorXd::Constant(10, -10.0), Eigen::VectorXd::Constant(10, 10.0))};
}

/// A wide normal with a tenth of the mass, and a spike with the rest.
Problem slab_and_spike(double spike_width) {
  return {problems::by_rows([=](const auto& x) {
            const double q = x[0] * x[0] + x[1] * x[1];
            const double p = (x[0] - 3.0) * (x[0] - 3.0) + (x[1] - 3.0) * (x[1] - 3.0);
            return std::log(0.1 / (2.0 * std::acos(-1.0)) * std::exp(-0.5 * q) +
                            0.9 / (2.0 * std::acos(-1.0) * spike_width * spike_width) *
                                std::exp(-0.5 * p / (spike_width * spike_width)));
          }),
          BoxPrior(Eigen::Vector2d(-10.0, -10.0), Eigen::Vector2d(10.0, 10.0))};
}

Options by_draws(Index evaluations = 31000) {
  Options options = recommended_moves(evaluations);
  options.finish = IndependentDraws{};
  return options;
}

bool warns(const Result& result, WarningKind kind) {
  for (const auto& warning : result.diagnostics.warnings) {
    if (warning.kind == kind) {
      return true;
    }
  }
  return false;
}

}  // namespace

TEST_CASE("The log-evidence of a normal posterior is right within an honest error") {
  constexpr int runs = 40;
  double squares = 0.0;
  double error = 0.0;
  int warned = 0;
  for (std::uint32_t run = 0; run < runs; ++run) {
    const auto measured = tmcmc::run(normal(), by_draws(10000), {.seed = 1, .run = run});
    const double z =
        (measured.evidence.log_evidence - log_evidence_of_normal) / measured.evidence.standard_error;
    squares += z * z / runs;
    error += measured.evidence.standard_error / runs;
    warned += measured.diagnostics.warnings.empty() ? 0 : 1;
    CHECK(measured.final.evaluations == 10000);
    CHECK(measured.weights.sum() == Approx(static_cast<double>(measured.final.points.rows())));
  }
  CHECK(std::sqrt(squares) < 1.5);
  CHECK(std::sqrt(squares) > 0.6);
  CHECK(error < 0.01);
  CHECK(warned <= 1);
}

TEST_CASE("Weighted moments and equally weighted points are those of the posterior") {
  const auto measured = run(normal(), by_draws(20000), {.seed = 2});
  const double n = static_cast<double>(measured.final.points.rows());
  const double independent = measured.measurement->effective_sample_size;
  CHECK(independent > 0.5 * n);
  const double mean = measured.final.points.col(0).dot(measured.weights) / n;
  const double product =
      (measured.final.points.col(0).array() * measured.final.points.col(1).array() * measured.weights.array())
          .sum() /
      n;
  CHECK(mean == Approx(0.0).margin(5.0 / std::sqrt(independent)));
  CHECK(product == Approx(0.7).margin(5.0 * std::sqrt(1.49 / independent)));
  const Population equal = equally_weighted(measured, 4000, {.seed = 2});
  CHECK(equal.rows() == 4000);
  CHECK(equal.col(1).squaredNorm() / 4000.0 == Approx(1.0).margin(5.0 * std::sqrt(2.0 / 4000.0)));
  CHECK_THROWS_AS(equally_weighted(measured, 0, {.seed = 2}), errors::InvalidValue);
}

TEST_CASE("A posterior against a corner of its box, a thousandth of it wide, is measured") {
  const Problem corner{
      problems::by_rows([](const auto& x) { return -(x[0] + x[1]) / 0.001 - 2.0 * std::log(0.001); }),
      BoxPrior(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, 1.0))};
  const auto measured = run(corner, by_draws(20000), {.seed = 3});
  CHECK(measured.evidence.standard_error < 0.02);
  CHECK(measured.evidence.log_evidence == Approx(0.0).margin(5.0 * measured.evidence.standard_error));
}

TEST_CASE("The same seed gives the same draws for any number of threads and size of batches") {
  Options options = by_draws(12000);
  const auto one = run(normal(), options, {.seed = 4});
  options.threads = 3;
  options.batch_rows = 100;
  const auto three = run(normal(), options, {.seed = 4});
  CHECK(one.final.points == three.final.points);
  CHECK(one.weights == three.weights);
  CHECK(one.evidence.log_evidence == three.evidence.log_evidence);
  const auto other = run(normal(), options, {.seed = 4, .run = 1});
  CHECK(one.evidence.log_evidence != other.evidence.log_evidence);
}

TEST_CASE("Between the evaluations the run looks at each iteration of a fit and each density of a sum") {
  Problem problem = normal();
  const auto plain = run(problem, by_draws(12000), {.seed = 4});
  std::string order;  // of calls: evaluations and looks
  problem.log_likelihood = [&, model = problem.log_likelihood](const auto& points, auto values) {
    order += 'e';
    model(points, values);
  };
  problem.look = [&] { order += 'l'; };
  const auto looking = run(problem, by_draws(12000), {.seed = 4});
  CHECK(plain.final.points == looking.final.points);
  CHECK(plain.weights == looking.weights);
  CHECK(plain.evidence.log_evidence == looking.evidence.log_evidence);
  // Each round of a search but the first is drawn from a fit, of three iterations at least.
  const auto rounds = looking.stages.size();
  CHECK(rounds > 5);
  CHECK(std::count(order.begin(), order.end(), 'l') > static_cast<std::ptrdiff_t>(3 * rounds));
  CHECK(order.back() == 'l');  // the densities of the searches at the final draws
  CHECK(order.substr(order.find('l')).find("ee") != std::string::npos);
  const std::size_t joint = order.rfind("le");
  CHECK(order.find("lll") < joint);

  for (const int calls : {1, 50, 400}) {
    int left = calls;
    problem.look = [&] {
      if (--left == 0) {
        throw std::domain_error("an interrupt");
      }
    };
    CHECK_THROWS_AS(run(problem, by_draws(12000), {.seed = 4}), std::domain_error);
    CHECK(left == 0);
  }
  problem.look = [] { throw std::domain_error("an interrupt"); };
  const Observer observer = [](const Progress&) {};
  CHECK_THROWS_AS(run(problem, by_draws(12000), {.seed = 4}, observer), std::domain_error);
}

TEST_CASE("Each iteration of a fit and each density that is added looks once") {
  StudentMixture mixture;
  mixture.degrees_of_freedom = 8;
  mixture.weights = Eigen::VectorXd::Ones(1);
  mixture.means = Eigen::MatrixXd::Zero(2, 1);
  mixture.factors = {Eigen::MatrixXd::Identity(2, 2)};
  int looks = 0;
  const auto look = [&] { ++looks; };
  WeightedPoints data{sample(mixture, 400, {.seed = 7}, 0), Eigen::VectorXd::Ones(400), {}};
  for (Index i = 0; i < 400; ++i) {
    data.groups.push_back(i);
  }
  MixtureFitOptions options;
  options.tolerance = -1.0;  // never ends early
  static_cast<void>(fit_mixture(data, 1, options, {.seed = 7}, 0, look));
  CHECK(looks == options.most_iterations);
  looks = 0;
  static_cast<void>(improve_mixture(data, mixture, options, look));
  CHECK(looks == options.most_iterations);
  looks = 0;  // each number of components is fitted to both halves with half of the iterations
  options.most_components = 1;
  static_cast<void>(fit_mixture(data, options, {.seed = 7}, 0, look));
  CHECK(looks == 2 * ((options.most_iterations + 1) / 2) + options.most_iterations);

  const Problem problem = normal();
  const ReferenceDensity reference{.fitted = mixture, .prior_share = 0.1};
  ReferenceDraws draws;
  for (std::uint32_t stage = 0; stage < 3; ++stage) {
    looks = 0;
    draws.append(draw_and_evaluate(problem, reference, 100, {.seed = 7}, stage), 1, look);
    // The new density at the draws so far, and those so far at the new draws.
    CHECK(looks == static_cast<int>(stage) + 1);
  }
}

TEST_CASE("Two modes of different mass are both measured") {
  const Problem two{problems::by_rows([](const auto& x) {
                      const double a = (x[0] + 4.0) * (x[0] + 4.0) + (x[1] + 4.0) * (x[1] + 4.0);
                      const double b = (x[0] - 3.0) * (x[0] - 3.0) + (x[1] - 3.0) * (x[1] - 3.0);
                      return std::log(0.3 / (2.0 * std::acos(-1.0) * 0.04) * std::exp(-0.5 * a / 0.04) +
                                      0.7 / (2.0 * std::acos(-1.0) * 0.25) * std::exp(-0.5 * b / 0.25) +
                                      1e-300);
                    }),
                    BoxPrior(Eigen::Vector2d(-10.0, -10.0), Eigen::Vector2d(10.0, 10.0))};
  const auto measured = run(two, by_draws(), {.seed = 5});
  CHECK(measured.evidence.log_evidence ==
        Approx(log_evidence_of_normal).margin(5.0 * measured.evidence.standard_error));
  double mass = 0.0;
  for (Index i = 0; i < measured.final.points.rows(); ++i) {
    mass += measured.final.points(i, 0) < 0.0 ? measured.weights[i] : 0.0;
  }
  CHECK(mass / static_cast<double>(measured.final.points.rows()) == Approx(0.3).margin(0.02));
}

TEST_CASE("A wrong log-evidence comes with a warning where a spike holds most of the mass") {
  int wrong = 0;
  for (std::uint32_t run = 0; run < 10; ++run) {
    const auto measured = tmcmc::run(slab_and_spike(0.3), by_draws(10000), {.seed = 6, .run = run});
    const double z =
        (measured.evidence.log_evidence - log_evidence_of_normal) / measured.evidence.standard_error;
    if (measured.diagnostics.warnings.empty() && !(std::fabs(z) < 5.0)) {
      ++wrong;
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("Few effective draws behind the choice of beta are warned of where there are several modes") {
  for (std::uint32_t run = 0; run < 5; ++run) {
    CHECK(warns(tmcmc::run(five_modes(), by_draws(5000), {.seed = 11, .run = run}),
                WarningKind::few_draws_a_mode));
    CHECK_FALSE(
        warns(tmcmc::run(normal(), by_draws(5000), {.seed = 11, .run = run}), WarningKind::few_draws_a_mode));
  }
}

TEST_CASE("A part of the posterior where one search has hardly drawn is warned of") {
  CHECK(warns(tmcmc::run(two_far_modes(), by_draws(), {.seed = 14}), WarningKind::searches_differ));
  CHECK_FALSE(warns(tmcmc::run(normal(), by_draws(), {.seed = 14}), WarningKind::searches_differ));
}

TEST_CASE("Draws of one density have the weights of that density, with the share of the prior in it") {
  const auto problem = normal();
  ReferenceDensity reference{.prior_share = 0.5};
  reference.fitted.weights = Eigen::VectorXd::Ones(1);
  reference.fitted.means = Eigen::MatrixXd::Zero(2, 1);
  reference.fitted.factors = {Eigen::MatrixXd::Identity(2, 2)};
  const auto draws = draw_and_evaluate(problem, reference, 200, {.seed = 15}, 0);
  const Eigen::VectorXd expected = draws.log_prior - log_density(reference, draws.z, draws.log_prior);
  CHECK((log_prior_weights(draws) - expected).cwiseAbs().maxCoeff() < 1e-12);
}

TEST_CASE("Few draws of the searches are warned of, however simple the posterior") {
  // Such draws miss, in 3 of 200 runs, a ball of a three hundredth of the prior's volume that holds
  // the posterior.
  for (std::uint32_t run = 0; run < 5; ++run) {
    CHECK(
        warns(tmcmc::run(normal(), by_draws(3000), {.seed = 12, .run = run}), WarningKind::few_draws_a_mode));
    CHECK_FALSE(
        warns(tmcmc::run(normal(), by_draws(4000), {.seed = 12, .run = run}), WarningKind::few_draws_a_mode));
  }
}

TEST_CASE("Where the fit has failed, all draws count, and the log-evidence is not that of one of them") {
  const double log_evidence = std::log(5.0 * 2.0 * std::acos(-1.0) * 0.01) + log_evidence_of_normal;
  int poor = 0;
  for (std::uint32_t run = 0; run < 60; ++run) {
    const auto measured = tmcmc::run(five_modes(), by_draws(3000), {.seed = 13, .run = run});
    CHECK(measured.measurement.value().effective_sample_size > 1.5);
    poor += warns(measured, WarningKind::low_overlap) ? 1 : 0;
    // A search that has lost modes can find one of five: log 5 is 1.6.
    CHECK(std::fabs(measured.evidence.log_evidence - log_evidence) < 4.0);
    CHECK(measured.final.evaluations <= 3000);
  }
  CHECK(poor > 10);
}

TEST_CASE("Where the searches do not come near the posterior, TMCMC takes over, with a warning") {
  const Problem wide{problems::by_rows([](const auto& x) { return -5e5 * x.squaredNorm(); }),
                     BoxPrior(Eigen::VectorXd::Constant(40, -10.0), Eigen::VectorXd::Constant(40, 10.0))};
  const auto measured = run(wide, by_draws(6000), {.seed = 7});
  CHECK(warns(measured, WarningKind::search_not_completed));
  CHECK(!measured.measurement.has_value());
  CHECK(!measured.stages.empty());
  CHECK(measured.weights == Eigen::VectorXd::Ones(measured.final.points.rows()));
  CHECK(measured.final.evaluations <= 6000);
}

TEST_CASE("Either rule of the paper chooses the same temperatures where the targets agree") {
  Options options = by_draws(8000);
  const auto by_size = run(normal(), options, {.seed = 8});
  options.criterion = coefficient_of_variation_rule(1.0);
  const auto by_variation = run(normal(), options, {.seed = 8});
  CHECK(by_size.final.points == by_variation.final.points);
  options.criterion = effective_sample_size_rule(0.8);
  CHECK(run(normal(), options, {.seed = 8}).final.points(0, 0) != by_size.final.points(0, 0));
}

TEST_CASE("Beta is the largest with the effective size asked for, up to 3 percent of it") {
  const auto draws = draw_and_evaluate(normal(), {.prior_share = 1.0}, 20000, {.seed = 18}, 0);
  double before = 1.0;
  for (const double target : {600.0, 1000.0, 3000.0, 8000.0}) {
    const TemperedPoints tempered = tempered_points(draws, target);
    CHECK(tempered.effective_sample_size >= target);
    CHECK(tempered.effective_sample_size <= 1.03 * target);
    CHECK(tempered.beta < before);
    CHECK(tempered.points.weights.sum() == Approx(tempered.effective_sample_size));
    before = tempered.beta;
  }
  CHECK(tempered_points(draws, 10.0).beta == 1.0);
  CHECK(tempered_points(draws, 1e9).effective_sample_size == Approx(10000.0).epsilon(0.03));
}

TEST_CASE("Two modes in ten dimensions keep their masses") {
  const Problem two{
      problems::by_rows([](const auto& x) {
        const double a = (x.array() - 4.0).square().sum() / 0.25;
        const double b = (x.array() + 4.0).square().sum() / 0.25;
        const double larger = std::max(-0.5 * a, -0.5 * b);
        return larger + std::log(0.75 * std::exp(-0.5 * a - larger) + 0.25 * std::exp(-0.5 * b - larger));
      }),
      BoxPrior(Eigen::VectorXd::Constant(10, -10.0), Eigen::VectorXd::Constant(10, 10.0))};
  const auto measured = run(two, by_draws(), {.seed = 9});
  double mass = 0.0;
  for (Index i = 0; i < measured.final.points.rows(); ++i) {
    mass += measured.final.points(i, 0) > 0.0 ? measured.weights[i] : 0.0;
  }
  CHECK(mass / static_cast<double>(measured.final.points.rows()) == Approx(0.75).margin(0.05));
}

TEST_CASE("A model that excludes nearly all of the prior is measured, one that excludes all is refused") {
  const auto inside = [](double radius) {
    return Problem{problems::by_rows([=](const auto& x) {
                     return x.squaredNorm() < radius * radius ? 0.0
                                                              : -std::numeric_limits<double>::infinity();
                   }),
                   BoxPrior(Eigen::Vector2d(-1.0, -1.0), Eigen::Vector2d(1.0, 1.0))};
  };
  const auto measured = run(inside(0.1), by_draws(20000), {.seed = 10});
  const double exact = std::log(std::acos(-1.0) * 0.01 / 4.0);
  CHECK(measured.evidence.log_evidence == Approx(exact).margin(5.0 * measured.evidence.standard_error));
  CHECK(measured.evidence.standard_error < 0.1);
  CHECK_THROWS_AS(run(inside(0.0), by_draws(3000), {.seed = 10}), InfeasiblePriorError);
}

TEST_CASE("The recommended options are better moves with independent draws from 3000 evaluations on") {
  CHECK(std::holds_alternative<NoFinish>(recommended_options(2999).finish));
  Options options = recommended_options(3000, 5);
  CHECK(std::holds_alternative<IndependentDraws>(options.finish));
  CHECK(options.samples == recommended_moves(3000, 5).samples);
  CHECK(run(normal(), options, {.seed = 17}).final.evaluations == 3000);
  CHECK_THROWS_AS(recommended_options(499), errors::InvalidValue);
}

TEST_CASE("Options that do not go with independent draws are refused by name") {
  const auto field_of = [](auto change) {
    Options options = by_draws(4000);
    change(options);
    try {
      options.validate();
    } catch (const errors::InvalidValue& error) {
      return error.field();
    }
    return std::string();
  };
  const auto field_of_draws = [&](const IndependentDraws& draws) {
    return field_of([&](Options& options) { options.finish = draws; });
  };
  CHECK(field_of_draws({}).empty());
  CHECK(field_of_draws({.search_share = 0.6}) == "options.search_share");
  CHECK(field_of_draws({.search_share = 0.0}) == "options.search_share");
  CHECK(field_of_draws({.prior_share = 1.0}) == "options.prior_share");
  CHECK(field_of_draws({.fit = {.degrees_of_freedom = 7}}) == "options.mixture_degrees_of_freedom");
  CHECK(field_of_draws({.fit = {.most_components = 0}}) == "options.mixture_components");
  CHECK(field_of([](Options& options) { options.evaluation_budget = 1999; }) == "options.evaluation_budget");
  CHECK(field_of([](Options& options) { options.evaluation_budget = 0; }) == "options.evaluation_budget");
  CHECK(field_of([](Options& options) { options.move = GrowingChains{}; }) == "options.finish");
  CHECK_THROWS_AS(run(normal(), by_draws(4000), {}, {}, fixed_schedule({0.5, 1.0})), errors::InvalidValue);
}

TEST_CASE("A run that was stopped goes on to the same result, and pays for no point twice") {
  const Options options = by_draws(4000);
  Index evaluated = 0;
  Problem counted = normal();
  counted.log_likelihood = [&evaluated, inner = counted.log_likelihood](const auto& points, auto values) {
    evaluated += points.rows();
    inner(points, values);
  };
  std::vector<Progress> seen;
  const Result whole =
      run(counted, options, {.seed = 12}, [&](const Progress& progress) { seen.push_back(progress); });
  CHECK(evaluated == 4000);
  REQUIRE(seen.size() >= 30);
  for (const std::size_t stop : {std::size_t{0}, seen.size() / 2, seen.size() - 1}) {
    CAPTURE(stop);
    const Progress& from = seen[stop];
    evaluated = 0;
    std::size_t later = 0;
    const Result again = resume(counted, options, {.seed = 12}, from, [&](const Progress&) { ++later; });
    CHECK(evaluated == 4000 - from.state.evaluations);
    CHECK(later <= seen.size() - stop);
    CHECK(again.final.points == whole.final.points);
    CHECK(again.weights == whole.weights);
    CHECK(again.evidence.log_evidence == whole.evidence.log_evidence);
    CHECK(again.evidence.standard_error == whole.evidence.standard_error);
  }
  Progress wrong = seen.front();
  wrong.state.evaluations = 4001;
  CHECK_THROWS_AS(resume(counted, options, {.seed = 12}, wrong), errors::InvalidValue);
}

TEST_CASE("Three threads record what they evaluate, and a run that goes on with it is the same") {
  Options options = by_draws(4000);
  const Result whole = run(normal(), options, {.seed = 13});
  options.threads = 3;
  options.batch_rows = 50;
  Progress last;
  CHECK(run(normal(), options, {.seed = 13}, [&](const Progress& progress) {
          last = progress;
        }).final.points == whole.final.points);
  CHECK(last.state.evaluations > 3800);
  CHECK(resume(normal(), options, {.seed = 13}, last).final.points == whole.final.points);
}

TEST_CASE("Weights are one each without independent draws") {
  Options options;
  options.samples = 200;
  const Result result = run(normal(), options, {.seed = 14});
  CHECK(result.weights == Eigen::VectorXd::Ones(200));
  CHECK(!result.measurement.has_value());
}

TEST_CASE("Without diagnose there are samples and weights alone") {
  Options options = by_draws(4000);
  const Result full = run(normal(), options, {.seed = 15});
  options.diagnose = false;
  const Result bare = run(normal(), options, {.seed = 15});
  CHECK(bare.weights == full.weights);
  CHECK(bare.final.log_evidence == full.evidence.log_evidence);
  CHECK(bare.evidence.log_evidence == 0.0);
  CHECK(bare.diagnostics.effective_sample_size.size() == 0);
  CHECK(full.diagnostics.effective_sample_size.minCoeff() > 500.0);
}

TEST_CASE("Effective sizes of weighted samples are those of the variances of their means") {
  Population points(4, 2);
  points << 1.0, 3.0, 2.0, 3.0, 3.0, 3.0, 4.0, 3.0;
  CHECK(effective_sample_sizes(points, Eigen::Vector4d::Ones())[0] == Approx(4.0));
  CHECK(effective_sample_sizes(points, Eigen::Vector4d::Ones())[1] == 0.0);
  // mean 1.5, two points of weight 2 alike: two draws
  CHECK(effective_sample_sizes(points, Eigen::Vector4d(2.0, 2.0, 0.0, 0.0))[0] == Approx(2.0));
  CHECK(effective_sample_sizes(points, Eigen::Vector4d::Zero())[0] == 0.0);
}

TEST_CASE("Equally weighted points follow the weights, under every scheme") {
  Result result;
  result.final.points = Eigen::Vector3d(1.0, 2.0, 3.0);
  result.weights = Eigen::Vector3d(1.5, 0.0, 1.5);
  for (const Resampling scheme : {Resampling::multinomial, Resampling::residual, Resampling::systematic}) {
    const Population points = equally_weighted(result, 10000, {.seed = 16}, scheme);
    CHECK((points.array() == 2.0).count() == 0);
    CHECK(static_cast<double>((points.array() == 1.0).count()) == Approx(5000.0).margin(250.0));  // 5 sd
  }
  CHECK((equally_weighted(result, 10000, {.seed = 16}).array() == 1.0).count() == 5000);
  CHECK_THROWS_AS(equally_weighted(result, 0, {.seed = 16}), errors::InvalidValue);
  result.weights.resize(2);
  CHECK_THROWS_AS(equally_weighted(result, 5, {.seed = 16}), errors::InvalidValue);
}
