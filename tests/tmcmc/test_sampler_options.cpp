// The posterior and the evidence under the options beyond the paper's, and options that do not go together.

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

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
using tmcmc::Boundary;
using tmcmc::Coordinates;
using tmcmc::Index;
using tmcmc::MoveKind;
using tmcmc::Options;
using tmcmc::Resampling;
using tmcmc::Result;
using tmcmc::ScaleRule;

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
  for (const ScaleRule rule :
       {ScaleRule::dimension, ScaleRule::target_acceptance, ScaleRule::acceptance_linked}) {
    CAPTURE(static_cast<int>(rule));
    Options options = good_options(2);
    options.scale_rule = rule;
    check_gamma_normal(replicate(gamma_normal(), options, 62), options.samples);
  }
  Options options = good_options(2);
  options.proposal_scale = 0.4;
  options.move_steps = 1;
  options.mixing_correlation = 0.3;
  check_gamma_normal(replicate(gamma_normal(), options, 62), options.samples);
}

TEST_CASE("so do waste-free chains, with proposals of every kind", "[tmcmc][sampler]") {
  for (const Coordinates coordinates : {Coordinates::natural, Coordinates::unbounded}) {
    for (const bool subsets : {false, true}) {
      for (const double independent : {0.0, 0.5}) {
        CAPTURE(static_cast<int>(coordinates), subsets, independent);
        Options options;
        options.samples = 2000;
        options.move = MoveKind::waste_free;
        options.chains = 50;
        options.resampling = Resampling::systematic;
        options.scale_rule = ScaleRule::dimension;
        options.coordinates = coordinates;
        options.random_subsets = subsets;
        options.independent_fraction = independent;
        const auto results = replicate(gamma_normal(), options, 63);
        check_gamma_normal(results, 500);
        check(over_runs(results, [](const Result& r) { return r.evidence.log_evidence; }),
              replicates::gamma_normal_log_evidence, 10.0, 500);
      }
    }
  }
}

TEST_CASE("so do cross-fitted proposals, whatever the kind of move", "[tmcmc][sampler]") {
  for (const MoveKind move : {MoveKind::resample_move, MoveKind::waste_free}) {
    CAPTURE(static_cast<int>(move));
    Options options = good_options(2);
    options.move = move;
    options.samples = move == MoveKind::waste_free ? 2000 : 500;
    options.cross_fit = true;
    options.independent_fraction = 0.3;
    options.scale_rule = ScaleRule::target_acceptance;
    check_gamma_normal(replicate(gamma_normal(), options, 67), 500);
  }
}

TEST_CASE("so do the recommended options, each time within their budget", "[tmcmc][sampler]") {
  const Options options = tmcmc::recommended_options(13000);
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
  for (const ScaleRule rule : {ScaleRule::fixed, ScaleRule::dimension}) {
    Options options = good_options(2);
    options.samples = 2000;
    options.proposal_scale = 0.2;
    options.scale_rule = rule;
    options.independent_fraction = 1.0;
    CHECK(tmcmc::run(gaussian, options, {.seed = 68}).stages.back().acceptance_rate > 0.85);
  }
}

TEST_CASE("unbounded coordinates are right where the posterior lies at a bound", "[tmcmc][sampler]") {
  // exp(-40 x) on [0, 1]: nearly all of it in the lowest tenth.
  const auto problem = replicates::problem_of([](const auto& x) { return -40.0 * x[0]; },
                                              Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  Options options = good_options(1);
  options.coordinates = Coordinates::unbounded;
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
  for (const ScaleRule rule : {ScaleRule::dimension, ScaleRule::target_acceptance}) {
    Options options = tmcmc::recommended_options(4000);
    options.chains = 100;
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
    CHECK_THROWS_AS(options.validate(), std::invalid_argument);
    CHECK_THROWS_WITH(options.validate(), Contains("options." + field) && Contains("expected " + expected));
  };
  refused([](Options& o) { o.max_move_steps = 0; }, "max_move_steps = 0", "at least 1");
  for (const double bad : {-0.1, 1.0, not_a_number}) {
    refused([=](Options& o) { o.mixing_correlation = bad; }, "mixing_correlation = ", "a number in [0, 1)");
  }
  refused([](Options& o) { o.mixing_correlation = 1.25; }, "mixing_correlation = 1.25", "a number");
  refused(
      [](Options& o) {
        o.mixing_correlation = 0.5;
        o.move_steps = 20;
        o.max_move_steps = 10;
      },
      "max_move_steps = 10", "at least options.move_steps");
  for (const MoveKind move : {MoveKind::growing_chains, MoveKind::waste_free}) {
    refused(
        [=](Options& o) {
          o.mixing_correlation = 0.5;
          o.move = move;
        },
        "mixing_correlation = 0.5", "0 unless move is resample_move");
  }
  for (const Index chains : {0, -5, 3, 1000, 2000}) {
    refused(
        [=](Options& o) {
          o.move = MoveKind::waste_free;
          o.chains = chains;
        },
        "chains = " + std::to_string(chains), "a divisor of the number of samples");
    Options options;
    options.chains = chains;
    CHECK_NOTHROW(options.validate());  // not used
  }
  for (const double bad : {0.0, 1.0, -0.3, not_a_number}) {
    refused([=](Options& o) { o.target_acceptance = bad; },
            "target_acceptance = ", "a number between 0 and 1");
  }
  refused(
      [](Options& o) {
        o.scale_rule = ScaleRule::target_acceptance;
        o.move = MoveKind::growing_chains;
      },
      "scale_rule = target_acceptance", "another rule with growing chains");
  for (const double bad : {-0.01, 1.01, infinity, not_a_number}) {
    refused([=](Options& o) { o.independent_fraction = bad; },
            "independent_fraction = ", "a number in [0, 1]");
  }
  const auto redrawn = [&](auto change) {
    refused(
        [=](Options& o) {
          o.boundary = Boundary::redraw;
          change(o);
        },
        "boundary = redraw", "reject");
  };
  refused(
      [](Options& o) {
        o.cross_fit = true;
        o.move = MoveKind::growing_chains;
      },
      "cross_fit = true", "false with growing chains");
  redrawn([](Options& o) { o.coordinates = Coordinates::unbounded; });
  redrawn([](Options& o) { o.random_subsets = true; });
  redrawn([](Options& o) { o.independent_fraction = 0.1; });
  refused([](Options& o) { o.infeasible_level = not_a_number; }, "infeasible_level = nan", "a number");
  refused([](Options& o) { o.evaluation_budget = -1; }, "evaluation_budget = -1", "a number of evaluations");
  refused([](Options& o) { o.evaluation_budget = 1000; }, "evaluation_budget = 1000",
          "more than options.samples");
  refused(
      [](Options& o) {
        o.evaluation_budget = 5000;
        o.move = MoveKind::growing_chains;
      },
      "evaluation_budget = 5000", "0 with growing chains");
}
