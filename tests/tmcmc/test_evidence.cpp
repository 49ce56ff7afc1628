// Log-evidence: the bridge estimate, its standard error, constants in the likelihood and excluded
// points.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "tmcmc/evidence.hpp"
#include "tmcmc/replicates.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using problems::by_rows;
using replicates::over_runs;
using replicates::problem_of;
using replicates::replicate;
using statistics::Estimate;
using statistics::standard_errors;
using tmcmc::BoxPrior;
using tmcmc::BridgeEvidence;
using tmcmc::Coordinates;
using tmcmc::Index;
using tmcmc::Options;
using tmcmc::Problem;
using tmcmc::Result;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// A bridge together with the genealogy that belongs to it.
struct Bridge {
  void add(tmcmc::ConstDoubles before, tmcmc::ConstDoubles after, std::vector<Index> parents, double step) {
    genealogy.chains = static_cast<Index>(parents.size());
    evidence.add(before, after, genealogy.chains, step);
    genealogy.parents.push_back(std::move(parents));
  }
  [[nodiscard]] double log_evidence() const { return evidence.log_evidence(); }
  [[nodiscard]] double standard_error() const { return evidence.standard_error(genealogy); }

  BridgeEvidence evidence;
  tmcmc::Genealogy genealogy;
};

std::vector<Index> own_parents(std::size_t n) {
  std::vector<Index> parents(n);
  std::iota(parents.begin(), parents.end(), Index{0});
  return parents;
}

/// Ratio of the root-mean-square standard error to the root-mean-square error.
double honesty(const std::vector<double>& errors, const std::vector<double>& standard_errors_of) {
  const auto square = [](double sum, double x) { return sum + x * x; };
  return std::sqrt(std::accumulate(standard_errors_of.begin(), standard_errors_of.end(), 0.0, square) /
                   std::accumulate(errors.begin(), errors.end(), 0.0, square));
}

/// A correlated Gaussian of dimension d in a box of width 20; far smaller than the box, and not in
/// its middle.
Problem narrow_gaussian(Index d) {
  return problem_of(
      [=](const auto& x) {
        double value = 0.0;
        for (Index j = 0; j < d; ++j) {
          const double z =
              (x[j] - 1.0 - (j > 0 ? 0.5 * x[j - 1] : 0.0)) / (0.05 + 0.3 * static_cast<double>(j));
          value -= 0.5 * z * z;
        }
        return value;
      },
      Eigen::VectorXd::Constant(d, -8.0), Eigen::VectorXd::Constant(d, 12.0));
}

double narrow_gaussian_log_evidence(Index d) {
  double value = 0.0;
  for (Index j = 0; j < d; ++j) {
    value += std::log((0.05 + 0.3 * static_cast<double>(j)) * 2.5066282746310002 / 20.0);
  }
  return value;
}

const tmcmc::Move resample_move = tmcmc::ResampleMove{.steps = 8};
const tmcmc::Move waste_free = tmcmc::WasteFree{40};

Options with_moves(const tmcmc::Move& move) {
  Options options;
  options.samples = std::holds_alternative<tmcmc::WasteFree>(move) ? 1600 : 400;  // at no higher cost
  options.move = move;
  options.scale_rule = tmcmc::DimensionScale{};
  options.resampling = tmcmc::Resampling::systematic;
  return options;
}

}  // namespace

TEST_CASE("the bridge between exponential populations is right, and so is its standard error",
          "[tmcmc][evidence]") {
  // Likelihood exp(-x): exp(-a x) on x > 0 has the evidence 1/a.
  statistics::Uniforms uniform(31);
  struct Stage {
    double rate;
    std::size_t size;
  };
  for (const std::vector<Stage>& stages : std::vector<std::vector<Stage>>{
           {{1.0, 400}, {1.7, 150}, {4.0, 1000}, {5.0, 300}}, {{1.0, 2000}, {40.0, 1000}}}) {
    std::vector<double> errors;
    std::vector<double> own;
    for (int repetition = 0; repetition < 400; ++repetition) {
      Bridge bridge;
      CHECK(bridge.log_evidence() == 0.0);
      CHECK(bridge.standard_error() == 0.0);
      std::vector<double> before;
      for (std::size_t t = 0; t < stages.size(); ++t) {
        std::vector<double> log_likelihood;
        std::vector<Index> parents;
        for (std::size_t i = 0; i < stages[t].size; ++i) {
          log_likelihood.push_back(std::log(uniform()) / stages[t].rate);
          parents.push_back(t > 0 ? static_cast<Index>(i % stages[t - 1].size) : 0);
        }
        if (t > 0) {
          bridge.add(before, log_likelihood, parents, stages[t].rate - stages[t - 1].rate);
        }
        before = log_likelihood;
      }
      errors.push_back(bridge.log_evidence() - std::log(stages.front().rate / stages.back().rate));
      own.push_back(bridge.standard_error());
    }
    CHECK(statistics::estimate(errors).errors_from(0.0) < standard_errors);
    // The standard error of a standard deviation from 400 values is 3.5 %.
    CHECK_THAT(honesty(errors, own), WithinAbs(1.0, standard_errors * 0.035));
  }
}

TEST_CASE("chains of equal states and relatives count as one in the standard error", "[tmcmc][evidence]") {
  // Each of 40 independent values fills a chain of 25 states, or a family of 25 chains.
  statistics::Uniforms uniform(32);
  constexpr std::size_t distinct = 40;
  constexpr std::size_t copies = 25;
  std::vector<double> errors;
  std::vector<double> of_chains;
  std::vector<double> of_families;
  std::vector<double> blind;
  for (int repetition = 0; repetition < 300; ++repetition) {
    std::vector<double> before(4000);
    std::vector<double> chained(distinct * copies);
    std::vector<double> families(distinct * copies);
    std::vector<Index> family(distinct * copies);
    for (double& value : before) {
      value = std::log(uniform());
    }
    for (std::size_t c = 0; c < distinct; ++c) {
      const double value = std::log(uniform()) / 2.0;
      for (std::size_t k = 0; k < copies; ++k) {
        chained[c + distinct * k] = value;
        families[c * copies + k] = value;
        family[c * copies + k] = static_cast<Index>(c);
      }
    }
    Bridge by_chain;
    by_chain.add(before, chained, own_parents(distinct), 1.0);
    Bridge by_family;
    by_family.add(before, families, family, 1.0);
    Bridge unrelated;
    unrelated.add(before, families, own_parents(distinct * copies), 1.0);
    errors.push_back(by_chain.log_evidence() - std::log(0.5));
    of_chains.push_back(by_chain.standard_error());
    of_families.push_back(by_family.standard_error());
    blind.push_back(unrelated.standard_error());
    CHECK_THAT(by_family.log_evidence(), WithinAbs(by_chain.log_evidence(), 1e-12));
  }
  CHECK_THAT(honesty(errors, of_chains), WithinAbs(1.0, 0.2));
  CHECK_THAT(honesty(errors, of_families), WithinAbs(1.0, 0.2));
  CHECK(honesty(errors, blind) < 0.6);
}

TEST_CASE("the bridge at its edges", "[tmcmc][evidence]") {
  const std::vector<double> before{-3.0, -infinity, -1.0, -infinity, -0.5, -0.2};
  const std::vector<double> after{-0.5, -0.2, -0.4};
  SECTION("a step of 0 adds nothing") {
    Bridge bridge;
    bridge.add(before, after, own_parents(3), 0.0);
    CHECK(bridge.log_evidence() == 0.0);
    CHECK_THAT(bridge.standard_error(), WithinAbs(0.0, 1e-7));  // the root of a rounded 0
  }
  SECTION("equal log-likelihoods give step times their value") {
    Bridge bridge;
    bridge.add(std::vector<double>(7, -30.0), std::vector<double>(4, -30.0), own_parents(4), 0.25);
    CHECK_THAT(bridge.log_evidence(), WithinRel(-7.5, 1e-14));
    CHECK_THAT(bridge.standard_error(), WithinAbs(0.0, 1e-7));
  }
  SECTION("the root meets the equation of the bridge") {
    Bridge bridge;
    bridge.add(before, after, own_parents(3), 0.8);
    const double r = std::exp(bridge.log_evidence());
    const double s = 1.0 / 3.0;
    const auto mean = [=](const std::vector<double>& values, bool of_before) {
      double sum = 0.0;
      for (const double value : values) {
        const double w = std::exp(0.8 * value);
        sum += (of_before ? w : r) / (s * w + (1.0 - s) * r);
      }
      return sum / static_cast<double>(values.size());
    };
    CHECK_THAT(mean(before, true), WithinRel(mean(after, false), 1e-12));
  }
  SECTION("populations without overlap: between both, with a standard error that says so") {
    for (const double gap : {50.0, 800.0, 1e5}) {
      CAPTURE(gap);
      Bridge bridge;
      bridge.add(std::vector<double>{-gap, -gap - 1.0}, std::vector<double>{0.0, -1.0}, own_parents(2), 1.0);
      CHECK(bridge.log_evidence() < -1.0);
      CHECK(bridge.log_evidence() > -gap);
      CHECK(bridge.standard_error() > 1e3);
    }
  }
  SECTION("a single chain has no standard error") {
    Bridge bridge;
    bridge.add(before, after, std::vector<Index>{0}, 0.5);
    CHECK(bridge.standard_error() == infinity);
    CHECK(std::isfinite(bridge.log_evidence()));
  }
}

TEST_CASE("groups: their effective number and the variance of a sum", "[tmcmc][evidence]") {
  CHECK(tmcmc::effective_groups(std::vector<Index>{0, 1, 2, 3}) == 4.0);
  CHECK(tmcmc::effective_groups(std::vector<Index>{2, 2, 5, 5}) == 2.0);
  CHECK(tmcmc::effective_groups(std::vector<Index>{1, 1, 1}) == 1.0);
  CHECK(tmcmc::effective_groups(std::vector<Index>{0, 0, 0, 1}) == 1.6);
  const std::vector<double> values{1.0, -2.0, 3.0, -2.0};
  CHECK(tmcmc::grouped_variance(values, std::vector<Index>{0, 1, 2, 3}) == 18.0 * 4.0 / 3.0);
  CHECK(tmcmc::grouped_variance(values, std::vector<Index>{0, 0, 1, 1}) == 2.0 * 2.0);
  CHECK(tmcmc::grouped_variance(values, std::vector<Index>{4, 4, 4, 4}) == infinity);
}

TEST_CASE("evidence and its standard error from a single run, over many runs", "[tmcmc][evidence]") {
  for (const Index d : {2, 6}) {
    for (const tmcmc::Move& move : {resample_move, waste_free}) {
      CAPTURE(d, move.index());
      const auto results = replicate(narrow_gaussian(d), with_moves(move), 33, 100);
      std::vector<double> errors;
      std::vector<double> own;
      for (const Result& result : results) {
        errors.push_back(result.evidence.log_evidence - narrow_gaussian_log_evidence(d));
        own.push_back(result.evidence.standard_error);
      }
      const Estimate e = statistics::estimate(errors);
      // An estimate of Z with little bias has one of minus half its variance in the logarithm.
      const double bias = e.standard_deviation * e.standard_deviation;
      CHECK_THAT(e.mean, WithinAbs(0.0, standard_errors * e.standard_error + bias));
      CHECK(e.standard_deviation < 0.6);
      const double ratio = honesty(errors, own);
      CHECK(ratio > 1.0 / 1.5);
      CHECK(ratio < 1.5);
    }
  }
}

TEST_CASE(
    "a constant in the log-likelihood changes no sample and no temperature, and moves the evidence by itself",
    "[tmcmc][evidence]") {
  // Values on a grid, so that the constants are added without rounding; a third of the box is
  // excluded.
  const auto shifted = [](double constant) {
    return problem_of(
        [constant](const auto& x) {
          const double a = (x[0] - 1.0) / 0.1;
          const double b = (x[1] - x[0]) / 0.3;
          const double value = std::round(-0.5 * (a * a + b * b) * 0x1p16) * 0x1p-16;
          return x[0] > 4.0 ? -infinity : value + constant;
        },
        Eigen::Vector2d(-2.0, -5.0), Eigen::Vector2d(7.0, 5.0));
  };
  std::vector<Options> all;
  for (const tmcmc::Move& move : {resample_move, tmcmc::Move(tmcmc::GrowingChains{}), waste_free}) {
    for (const Coordinates coordinates : {Coordinates::natural, Coordinates::unbounded}) {
      Options options = with_moves(move);
      const bool unbounded = coordinates == Coordinates::unbounded;
      options.proposal = tmcmc::MetropolisProposal{coordinates, unbounded, unbounded ? 0.5 : 0.0};
      all.push_back(options);
    }
  }
  all.push_back(tmcmc::recommended_moves(5000));
  for (const Options& options : all) {
    CAPTURE(options.move.index(), options.proposal.index(), options.samples);
    const Result reference = tmcmc::run(shifted(0.0), options, {.seed = 34});
    CHECK(reference.stages.front().feasible < options.samples * 3 / 4);
    for (const double constant : {1000.0, -65536.0, 1e6, 1e9}) {
      CAPTURE(constant);
      const Result result = tmcmc::run(shifted(constant), options, {.seed = 34});
      CHECK((result.final.points == reference.final.points));
      REQUIRE(result.stages.size() == reference.stages.size());
      for (std::size_t s = 0; s < result.stages.size(); ++s) {
        CHECK(result.stages[s].beta == reference.stages[s].beta);
      }
      const double rounding = 1e-14 * std::fabs(constant) + 1e-10;
      CHECK_THAT(result.final.log_evidence - reference.final.log_evidence, WithinAbs(constant, rounding));
      CHECK_THAT(result.evidence.log_evidence - reference.evidence.log_evidence,
                 WithinAbs(constant, rounding));
      CHECK_THAT(result.evidence.standard_error, WithinRel(reference.evidence.standard_error, 1e-9));
    }
  }
}

TEST_CASE("the standard error hears of poor mixing, as far as the genealogy goes", "[tmcmc][evidence]") {
  Options
      options;  // the published moves: three steps of scale 0.2, after which a state still resembles its start
  options.samples = 500;
  options.criterion = tmcmc::effective_sample_size_rule(0.5);
  std::vector<double> errors;
  std::vector<double> own;
  for (const Result& result : replicate(narrow_gaussian(3), options, 36, 200)) {
    errors.push_back(result.evidence.log_evidence - narrow_gaussian_log_evidence(3));
    own.push_back(result.evidence.standard_error);
  }
  const double ratio = honesty(errors, own);
  CHECK(ratio > 1.0 / 1.5);
  CHECK(ratio < 1.5);
}

TEST_CASE("excluded points enter both evidences by the fraction of the box", "[tmcmc][evidence]") {
  const auto half = problem_of([](const auto& x) { return x[0] < 0.5 ? -infinity : -9.0 * x[1]; },
                               Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones());
  const double truth = std::log(0.5 * -std::expm1(-9.0) / 9.0);
  for (const tmcmc::Move& move : {resample_move, waste_free}) {
    CAPTURE(move.index());
    const auto results = replicate(half, with_moves(move), 35, 60);
    const Estimate bridge = over_runs(results, [](const Result& r) { return r.evidence.log_evidence; });
    const Estimate weights = over_runs(results, [](const Result& r) { return r.final.log_evidence; });
    for (const Estimate& e : {bridge, weights}) {
      CHECK_THAT(e.mean, WithinAbs(truth, standard_errors * e.standard_error +
                                              e.standard_deviation * e.standard_deviation));
      CHECK(e.standard_deviation < 0.2);
    }
    for (const Result& result : results) {
      CHECK(result.final.points.col(0).minCoeff() >= 0.5);
    }
  }
}
