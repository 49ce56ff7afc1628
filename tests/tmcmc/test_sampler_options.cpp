// The posterior and the evidence under the options beyond the paper's, and options that do not go
// together.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "errors/invalid_value.hpp"
#include "names/names.hpp"
#include "tmcmc/replicates.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using replicates::check;
using replicates::check_gamma_normal;
using replicates::gamma_normal;
using replicates::good_options;
using replicates::over_runs;
using replicates::replicate;
using statistics::Estimate;
using statistics::standard_errors;
using tmcmc::AcceptanceLinked;
using tmcmc::Coordinates;
using tmcmc::DimensionScale;
using tmcmc::FixedScale;
using tmcmc::GrowingChains;
using tmcmc::Index;
using tmcmc::MetropolisProposal;
using tmcmc::Options;
using tmcmc::ResampleMove;
using tmcmc::Resampling;
using tmcmc::Result;
using tmcmc::ScaleRule;
using tmcmc::TargetAcceptance;
using tmcmc::WasteFree;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("every resampling scheme samples an asymmetric, correlated posterior", "[tmcmc][sampler]") {
  for (const Resampling scheme : {Resampling::residual, Resampling::stratified, Resampling::systematic}) {
    CAPTURE(static_cast<int>(scheme));
    Options options = good_options(2);
    options.resampling = scheme;
    check_gamma_normal(replicate(gamma_normal(), options, 61), options.samples);
  }
}

TEST_CASE("so does every scale rule, and a stage that goes on until it has mixed", "[tmcmc][sampler]") {
  for (const ScaleRule& rule :
       {ScaleRule(DimensionScale{}), ScaleRule(TargetAcceptance{}), ScaleRule(AcceptanceLinked{})}) {
    CAPTURE(names::name_of(rule));
    Options options = good_options(2);
    options.scale_rule = rule;
    check_gamma_normal(replicate(gamma_normal(), options, 62), options.samples);
  }
  Options options = good_options(2);
  options.scale_rule = tmcmc::FixedScale{0.4};
  options.move = tmcmc::ResampleMove{.steps = 1, .mixing_correlation = 0.3};
  check_gamma_normal(replicate(gamma_normal(), options, 62), options.samples);
}

TEST_CASE("so do waste-free chains, with proposals of every kind", "[tmcmc][sampler]") {
  for (const Coordinates coordinates : {Coordinates::natural, Coordinates::unbounded}) {
    for (const bool subsets : {false, true}) {
      for (const double independent : {0.0, 0.5}) {
        CAPTURE(static_cast<int>(coordinates), subsets, independent);
        Options options;
        options.samples = 2000;
        options.move = WasteFree{50};
        options.resampling = Resampling::systematic;
        options.scale_rule = tmcmc::DimensionScale{};
        options.proposal = MetropolisProposal{coordinates, subsets, independent};
        const auto results = replicate(gamma_normal(), options, 63);
        check_gamma_normal(results, 500);
        check(over_runs(results, [](const Result& r) { return r.evidence.log_evidence; }),
              replicates::gamma_normal_log_evidence, 10.0, 500);
      }
    }
  }
}

TEST_CASE("so do cross-fitted proposals, whatever the kind of move", "[tmcmc][sampler]") {
  for (const bool waste_free : {false, true}) {
    CAPTURE(waste_free);
    Options options = good_options(2);
    if (waste_free) options.move = WasteFree{};
    options.samples = waste_free ? 2000 : 500;
    options.cross_fit = true;
    options.proposal = MetropolisProposal{.independent_fraction = 0.3};
    options.scale_rule = TargetAcceptance{};
    check_gamma_normal(replicate(gamma_normal(), options, 67), 500);
  }
}

TEST_CASE("so do the better moves, each time within their budget", "[tmcmc][sampler]") {
  const Options options = tmcmc::recommended_moves(13000);
  const auto results = replicate(gamma_normal(), options, 64);
  check_gamma_normal(results, options.samples);
  for (const Result& result : results) {
    CHECK(result.final.evaluations <= 13000);
    CHECK(result.diagnostics.warnings.empty());
  }
}

TEST_CASE("independent proposals follow the population itself, whatever the scale of the random walks",
          "[tmcmc][sampler]") {
  const auto gaussian = replicates::problem_of(
      [](const auto& x) { return -0.5 * (x[0] * x[0] + (x[1] - x[0]) * (x[1] - x[0])); },
      Eigen::Vector2d::Constant(-20.0), Eigen::Vector2d::Constant(20.0));
  for (const ScaleRule& rule : {ScaleRule(FixedScale{0.2}), ScaleRule(DimensionScale{})}) {
    Options options = good_options(2);
    options.samples = 2000;
    options.scale_rule = rule;
    options.proposal = MetropolisProposal{.independent_fraction = 1.0};
    CHECK(tmcmc::run(gaussian, options, {.seed = 68}).stages.back().acceptance_rate > 0.85);
  }
}

TEST_CASE("unbounded coordinates are right where the posterior lies at a bound", "[tmcmc][sampler]") {
  // exp(-40 x) on [0, 1]: nearly all of it in the lowest tenth.
  const auto problem = replicates::problem_of([](const auto& x) { return -40.0 * x[0]; },
                                              Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  Options options = good_options(1);
  options.proposal = MetropolisProposal{.coordinates = Coordinates::unbounded};
  const auto results = replicate(problem, options, 65);
  check(replicates::mean_of(
            results, [](double x) { return x; }, 0),
        1.0 / 40.0, 1.0 / 40.0, options.samples);
  check(replicates::mean_of(
            results, [](double x) { return x < 1e-3 ? 1.0 : 0.0; }, 0),
        -std::expm1(-0.04), std::sqrt(0.04), options.samples);
  check(over_runs(results, [](const Result& r) { return r.evidence.log_evidence; }), -std::log(40.0), 2.0,
        options.samples);
}

TEST_CASE("neither threads nor batches change a bit under the new options either", "[tmcmc][sampler]") {
  for (const ScaleRule& rule : {ScaleRule(DimensionScale{}), ScaleRule(TargetAcceptance{})}) {
    Options options = tmcmc::recommended_moves(4000);
    options.move = WasteFree{100};
    options.samples = 300;
    options.scale_rule = rule;
    const Result reference = tmcmc::run(gamma_normal(), options, {.seed = 66});
    for (const int threads : {1, 3}) {
      for (const Index batch_rows : {0, 1, 70}) {
        CAPTURE(threads, batch_rows);
        options.threads = threads;
        options.batch_rows = batch_rows;
        const Result result = tmcmc::run(gamma_normal(), options, {.seed = 66});
        CHECK((result.final.points == reference.final.points));
        CHECK(result.evidence.log_evidence == reference.evidence.log_evidence);
        CHECK(result.evidence.standard_error == reference.evidence.standard_error);
        CHECK(result.final.proposal_scale == reference.final.proposal_scale);
      }
    }
  }
}

TEST_CASE("new options out of range, and options that do not go together, are refused by name",
          "[tmcmc][sampler]") {
  const auto refused = [](auto change, const std::string& field, const std::string& expected) {
    Options options;
    change(options);
    CHECK_THROWS_AS(options.validate(), errors::InvalidValue);
    CHECK_THROWS_WITH(options.validate(), Contains("options." + field) && Contains("expected " + expected));
  };
  refused([](Options& o) { o.move = ResampleMove{.mixing_correlation = 0.5, .max_steps = 0}; },
          "max_move_steps = 0", "a whole number from 1 to");
  for (const double bad : {-0.1, 1.0, not_a_number}) {
    refused([=](Options& o) { o.move = ResampleMove{.mixing_correlation = bad}; },
            "mixing_correlation = ", "a number in [0, 1)");
  }
  refused([](Options& o) { o.move = ResampleMove{.mixing_correlation = 1.25}; }, "mixing_correlation = 1.25",
          "a number");
  refused([](Options& o) { o.move = ResampleMove{.steps = 20, .mixing_correlation = 0.5, .max_steps = 10}; },
          "max_move_steps = 10", "at least the least number of steps, 20");
  for (const Index chains : {0, -5, 3, 1000, 2000}) {
    refused([=](Options& o) { o.move = WasteFree{chains}; }, "chains = " + std::to_string(chains),
            chains < 1 ? "a whole number from 1" : "a divisor of the number of samples");
  }
  for (const double bad : {0.0, 1.0, -0.3, not_a_number}) {
    refused([=](Options& o) { o.scale_rule = TargetAcceptance{bad}; },
            "target_acceptance = ", "a number in (0, 1)");
  }
  refused(
      [](Options& o) {
        o.scale_rule = TargetAcceptance{};
        o.move = GrowingChains{};
      },
      "scale_rule = target-acceptance", "another rule with growing chains");
  for (const double bad : {-0.01, 1.01, infinity, not_a_number}) {
    refused([=](Options& o) { o.proposal = MetropolisProposal{.independent_fraction = bad}; },
            "independent_fraction = ", "a number in [0, 1]");
  }
  refused(
      [](Options& o) {
        o.cross_fit = true;
        o.move = GrowingChains{};
      },
      "cross_fit = yes", "no with growing chains");
  refused([](Options& o) { o.infeasible_level = not_a_number; }, "infeasible_level = nan", "a number");
  refused([](Options& o) { o.evaluation_budget = -1; }, "evaluation_budget = -1", "a whole number from 0 to");
  refused([](Options& o) { o.evaluation_budget = 1000; }, "evaluation_budget = 1000",
          "more than the number of samples, 1000");
  refused(
      [](Options& o) {
        o.evaluation_budget = 5000;
        o.move = GrowingChains{};
      },
      "evaluation_budget = 5000", "0 with growing chains");
}
