// What a run promises besides the right distribution: records, stops and errors.

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "errors/invalid_value.hpp"
#include "tmcmc/problems.hpp"
#include "tmcmc/sampler.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using problems::by_rows;
using problems::few_samples;
using problems::ridge;
using problems::run_ridge;
using tmcmc::BoxPrior;
using tmcmc::Counted;
using tmcmc::fixed_schedule;
using tmcmc::Index;
using tmcmc::Options;
using tmcmc::Problem;
using tmcmc::Result;
using tmcmc::SamplingError;
using tmcmc::StageRecord;
using tmcmc::State;
using tmcmc::StopReason;
using tmcmc::StreamKey;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double rounding = 1e-12;

}  // namespace

TEST_CASE("the records of the stages are consistent", "[tmcmc][sampler]") {
  for (const tmcmc::Move& move : {tmcmc::Move(tmcmc::ResampleMove{}), tmcmc::Move(tmcmc::GrowingChains{})}) {
    for (const bool redraw : {false, true}) {
      for (const tmcmc::Criterion& criterion :
           {tmcmc::coefficient_of_variation_rule(), tmcmc::effective_sample_size_rule()}) {
        CAPTURE(move.index(), redraw, criterion.rule.index());
        Options options = few_samples();
        options.move = move;
        if (redraw) options.proposal = tmcmc::RedrawnWalk{};
        options.criterion = criterion;
        const Result result = run_ridge(options);
        CHECK(result.stop == StopReason::completed);
        REQUIRE(result.stages.size() > 4);
        double beta = 0.0;
        double log_evidence = 0.0;
        Index evaluations = options.samples;
        Index stage = 0;
        for (const StageRecord& record : result.stages) {
          CAPTURE(++stage);
          const bool last = stage == static_cast<Index>(result.stages.size());
          CHECK(record.stage == stage);
          CHECK(record.beta > beta);
          CHECK(record.beta == (last ? 1.0 : beta + record.step));
          CHECK_THAT(record.step, WithinAbs(record.beta - beta, rounding));
          const double half = 0.5 * static_cast<double>(options.samples);
          if (last) {
            CHECK(record.effective_sample_size >= half);
            CHECK(record.coefficient_of_variation <= 1.0);
          } else {
            CHECK_THAT(record.effective_sample_size, WithinRel(half, 1e-10));
            CHECK_THAT(record.coefficient_of_variation, WithinRel(1.0, 1e-10));
          }
          CHECK(record.feasible == options.samples);
          CHECK(record.distinct_ancestors > options.samples / 5);
          CHECK(record.distinct_ancestors < options.samples);
          CHECK(record.acceptance_rate > 0.0);
          CHECK(record.acceptance_rate < 1.0);
          CHECK(record.transition_evaluations > 0);
          CHECK(record.transition_evaluations <= 25);
          const Index proposals =
              options.samples * (std::holds_alternative<tmcmc::GrowingChains>(move) ? 1 : 3);
          CHECK(record.evaluations <= proposals);
          CHECK((!redraw || record.evaluations == proposals));
          CHECK((redraw || record.redraws == 0));
          beta = record.beta;
          log_evidence += record.log_evidence_increment;
          evaluations += record.evaluations;
        }
        CHECK(beta == 1.0);
        CHECK(result.final.beta == 1.0);
        CHECK(result.final.log_evidence == log_evidence);
        CHECK(result.final.evaluations == evaluations);
        CHECK(result.final.stage == stage);
        CHECK(result.final.points.rows() == options.samples);
        CHECK(result.final.points.cols() == 3);
        Eigen::VectorXd again(options.samples);
        ridge().log_likelihood(result.final.points, again);
        CHECK((again == result.final.log_likelihood));
        const auto& p = result.final.points.array();
        CHECK((p >= -5.0 && p <= 5.0).all());
      }
    }
  }
}

TEST_CASE("the likelihood is evaluated as often as the records say", "[tmcmc][sampler]") {
  std::atomic<Index> rows{0};
  const Problem problem = ridge();
  const Problem counting = {
      [&](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
        rows += points.rows();
        problem.log_likelihood(points, values);
      },
      problem.prior};
  for (const tmcmc::Move& move : {tmcmc::Move(tmcmc::ResampleMove{}), tmcmc::Move(tmcmc::GrowingChains{})}) {
    rows = 0;
    Options options = few_samples();
    options.move = move;
    CHECK(tmcmc::run(counting, options, {.seed = 5}).final.evaluations == rows);
  }
}

TEST_CASE("the observer sees the draws from the prior and each stage once, with the population after it",
          "[tmcmc][sampler]") {
  std::vector<StageRecord> seen;
  State last;
  Index calls = 0;
  const Result result = tmcmc::run(ridge(), few_samples(), {.seed = 5}, [&](const tmcmc::Progress& progress) {
    const State& s = progress.state;
    CHECK(s.stage == calls);
    REQUIRE(progress.stages.size() == static_cast<std::size_t>(calls++));
    if (progress.stages.empty()) {
      CHECK((s.points == ridge().prior.sample(few_samples().samples, {.seed = 5})));
      return;
    }
    const StageRecord& r = progress.stages.back();
    seen.push_back(r);
    last = s;
    CHECK(r.stage == s.stage);
    CHECK(r.beta == s.beta);
  });
  REQUIRE(seen.size() == result.stages.size());
  CHECK(calls == result.final.stage + 1);
  for (std::size_t s = 0; s < seen.size(); ++s) {
    CHECK(seen[s].stage == static_cast<Index>(s) + 1);
    CHECK(seen[s].beta == result.stages[s].beta);
    CHECK(seen[s].log_evidence_increment == result.stages[s].log_evidence_increment);
  }
  CHECK((last.points == result.final.points));
  CHECK(last.log_evidence == result.final.log_evidence);
  CHECK((result.final.points == run_ridge(few_samples()).final.points));  // and it changes nothing
}

TEST_CASE("init and step by hand make the run, and leave their arguments as they are", "[tmcmc][sampler]") {
  const Problem problem = ridge();
  const Options options = few_samples();
  const StreamKey key{.seed = 5};
  State state = tmcmc::init(problem, options, key);
  CHECK(state.beta == 0.0);
  CHECK(state.log_evidence == 0.0);
  CHECK(state.evaluations == options.samples);
  CHECK((state.points == problem.prior.sample(options.samples, key)));
  while (state.beta < 1.0) {
    const State from = state;
    const auto tempering =
        tmcmc::choose_step(tmcmc::as_span(state.log_likelihood), 1.0 - state.beta, options.criterion);
    tmcmc::NextStage next = tmcmc::step(problem, options, key, tempering, state);
    CHECK((state.points == from.points));
    CHECK(next.record.beta == next.state.beta);
    state = std::move(next.state);
  }
  const Result result = run_ridge(options);
  CHECK((state.points == result.final.points));
  CHECK(state.log_evidence == result.final.log_evidence);
}

TEST_CASE("a fixed schedule has to ascend to 1", "[tmcmc][sampler]") {
  CHECK_NOTHROW(fixed_schedule({1.0}));
  CHECK_NOTHROW(fixed_schedule({1e-300, 0.5, 1.0}));
  for (const std::vector<double>& betas : std::vector<std::vector<double>>{{},
                                                                           {0.5},
                                                                           {0.0, 1.0},
                                                                           {-0.5, 1.0},
                                                                           {0.5, 0.5, 1.0},
                                                                           {0.6, 0.5, 1.0},
                                                                           {0.5, 1.0, 2.0},
                                                                           {0.5, 1.0, 1.0},
                                                                           {not_a_number, 1.0},
                                                                           {0.5, not_a_number, 1.0},
                                                                           {not_a_number}}) {
    CHECK_THROWS_AS(fixed_schedule(betas), errors::InvalidValue);
    CHECK_THROWS_WITH(fixed_schedule(betas), Contains("fixed_schedule"));
  }
}

TEST_CASE("the stage cap ends a run that makes no progress", "[tmcmc][sampler]") {
  Options options = few_samples();
  options.criterion = tmcmc::effective_sample_size_rule(1.0);  // what the published TMCMC-II script solves
  options.minimum_step = 0.0;
  options.max_stages = 20;
  const Result result = run_ridge(options);
  CHECK(result.stop == StopReason::stage_limit);
  CHECK(result.stages.size() == 20);
  CHECK(result.final.beta == 0.0);
  CHECK(result.final.log_evidence == 0.0);
  CHECK(result.final.stage == 20);
  for (const StageRecord& record : result.stages) {
    CHECK(record.step == 0.0);
    CHECK(record.log_evidence_increment == 0.0);
  }
}

TEST_CASE("the stage cap ends a run that is under way", "[tmcmc][sampler]") {
  Options options = few_samples();
  const Result complete = run_ridge(options);
  options.max_stages = 3;
  const Result cut = run_ridge(options);
  CHECK(cut.stop == StopReason::stage_limit);
  REQUIRE(cut.stages.size() == 3);
  CHECK(cut.final.beta == complete.stages[2].beta);
  options.max_stages = static_cast<Index>(complete.stages.size());
  CHECK(run_ridge(options).stop == StopReason::completed);
}

TEST_CASE("the minimum step ends a run whose steps are below it", "[tmcmc][sampler]") {
  Options options = few_samples();
  options.criterion = tmcmc::effective_sample_size_rule(1.0);
  const Result none = run_ridge(options);  // the default minimum is positive
  CHECK(none.stop == StopReason::step_too_small);
  CHECK(none.stages.empty());
  CHECK(none.final.beta == 0.0);
  CHECK((none.final.points == tmcmc::init(ridge(), options, {.seed = 5}).points));

  options = few_samples();
  const Result complete = run_ridge(options);
  options.minimum_step = 0.5 * (complete.stages[0].step + complete.stages[1].step);
  REQUIRE(complete.stages[0].step < complete.stages[1].step);
  CHECK(run_ridge(options).stop == StopReason::step_too_small);
  options.minimum_step = 0.99 * complete.stages[0].step;
  CHECK(run_ridge(options).stop == StopReason::completed);
  options.minimum_step = 0.999999;  // does not hold for a step that reaches 1
  CHECK(tmcmc::run(ridge(), options, {.seed = 5}, {}, fixed_schedule({1.0})).stop == StopReason::completed);
}

TEST_CASE("steps of 1e-10 are no obstacle", "[tmcmc][sampler]") {
  // The penalty of the published scripts on most of the box.
  const Problem problem = {by_rows([](const auto& x) { return x[0] > 1.0 ? -1e10 : -50.0 * x[0]; }),
                           BoxPrior(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(1, 8.0))};
  Options options = few_samples();
  options.criterion.counted = Counted::all;
  options.infeasible_level = -1e10;
  const Result result = tmcmc::run(problem, options, {.seed = 5});
  CHECK(result.stop == StopReason::completed);
  CHECK(result.stages.front().step > 5e-11);
  CHECK(result.stages.front().step < 5e-10);
  CHECK(result.stages.front().feasible < 50);
  CHECK(result.stages.back().feasible == options.samples);
  CHECK(result.final.points.maxCoeff() <= 1.0);
}

TEST_CASE("a prior in which nothing is feasible ends with an error", "[tmcmc][sampler]") {
  const BoxPrior prior(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  const Problem excluded = {by_rows([](const auto&) { return -infinity; }), prior};
  CHECK_THROWS_AS(tmcmc::run(excluded, few_samples(), {}), SamplingError);
  CHECK_THROWS_AS(tmcmc::run(excluded, few_samples(), {}), tmcmc::InfeasiblePriorError);
  CHECK_THROWS_WITH(tmcmc::run(excluded, few_samples(), {}), Contains("203 draws") && Contains("feasible"));

  const Problem penalised = {by_rows([](const auto&) { return -1e10; }), prior};
  Options options = few_samples();
  CHECK_NOTHROW(tmcmc::run(penalised, options, {}));  // a constant likelihood, as far as the sampler can know
  options.infeasible_level = -1e10;
  CHECK_THROWS_AS(tmcmc::run(penalised, options, {}), tmcmc::InfeasiblePriorError);
}

TEST_CASE("a criterion that too few feasible samples can meet ends with an error", "[tmcmc][sampler]") {
  const Problem mostly_excluded = {by_rows([](const auto& x) { return x[0] < 0.2 ? -x[0] : -infinity; }),
                                   BoxPrior(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1))};
  Options options = few_samples();
  CHECK(tmcmc::run(mostly_excluded, options, {}).stop == StopReason::completed);
  options.criterion.counted = Counted::all;
  CHECK_THROWS_AS(tmcmc::run(mostly_excluded, options, {}), SamplingError);
  CHECK_THROWS_WITH(tmcmc::run(mostly_excluded, options, {}),
                    Contains("stage 1") && Contains("of 203") && Contains("Criterion::counted"));
}

TEST_CASE("a likelihood of NaN or plus infinity ends the run, naming the point", "[tmcmc][sampler]") {
  const BoxPrior prior(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  for (const double bad : {not_a_number, infinity}) {
    const Problem at_once = {by_rows([=](const auto& x) { return x[0] > 0.5 ? bad : 0.0; }), prior};
    CHECK_THROWS_AS(tmcmc::run(at_once, few_samples(), {}), SamplingError);
    CHECK_THROWS_WITH(tmcmc::run(at_once, few_samples(), {}), Contains(" at (0."));
    // In a gap that no prior draw hits but some proposal does.
    const auto initial =
        tmcmc::init(Problem{by_rows([](const auto&) { return 0.0; }), prior}, few_samples(), {});
    std::vector<double> drawn(initial.points.col(0).begin(), initial.points.col(0).end());
    const Problem later = {by_rows([=](const auto& x) {
                             return std::find(drawn.begin(), drawn.end(), x[0]) == drawn.end() ? bad : -x[0];
                           }),
                           prior};
    CHECK_THROWS_AS(tmcmc::run(later, few_samples(), {}), SamplingError);
  }
}

TEST_CASE("a row whose log-likelihood is not written ends the run", "[tmcmc][sampler]") {
  const BoxPrior prior(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1));
  int calls = 0;
  const int complete = GENERATE(0, 1);  // calls that write every row: none, that of the prior draws
  const Problem problem = {
      [&](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
        const auto written = calls++ < complete ? values.size() : values.size() - 1;
        values.head(written) = -points.col(0).head(written);
      },
      prior};
  CHECK_THROWS_WITH(tmcmc::run(problem, few_samples(), {}), Contains("nan at ("));
}

TEST_CASE("an exception of the likelihood reaches the caller, from any thread", "[tmcmc][sampler]") {
  std::atomic<int> calls{0};
  const Problem problem = {
      [&](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
        if (++calls > 5) {
          throw std::domain_error("model failed");
        }
        values = -points.col(0);
      },
      BoxPrior(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1))};
  for (const int threads : {1, 3}) {
    calls = 0;
    Options options = few_samples();
    options.threads = threads;
    options.batch_rows = 10;
    CHECK_THROWS_AS(tmcmc::run(problem, options, {}), std::domain_error);
  }
}

TEST_CASE("two samples run", "[tmcmc][sampler]") {
  Options options;
  options.samples = 2;
  options.criterion = tmcmc::effective_sample_size_rule(0.9);
  const Result result = run_ridge(options);
  CHECK(result.stop == StopReason::completed);
  CHECK(result.final.points.rows() == 2);
}

TEST_CASE("a constant likelihood takes one stage and has evidence of its value", "[tmcmc][sampler]") {
  const Problem flat = {by_rows([](const auto&) { return -7.5; }),
                        BoxPrior(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Ones(1))};
  const Result result = tmcmc::run(flat, few_samples(), {});
  CHECK(result.stages.size() == 1);
  CHECK_THAT(result.final.log_evidence, WithinAbs(-7.5, rounding));
}

TEST_CASE("options out of range are refused by name", "[tmcmc][sampler]") {
  const auto refused = [](auto change, const char* field) {
    Options options;
    change(options);
    CHECK_THROWS_AS(options.validate(), errors::InvalidValue);
    CHECK_THROWS_WITH(options.validate(), Contains(field));
    CHECK_THROWS_AS(run_ridge(options), errors::InvalidValue);
  };
  CHECK_NOTHROW(Options{}.validate());
  refused([](Options& o) { o.samples = 1; }, "options.samples = 1");
  refused([](Options& o) { o.move = tmcmc::ResampleMove{.steps = 0}; }, "options.move_steps = 0");
  for (const double scale : {0.0, -0.2, infinity, not_a_number}) {
    refused([=](Options& o) { o.scale_rule = tmcmc::FixedScale{scale}; }, "options.proposal_scale");
  }
  refused([](Options& o) { o.proposal = tmcmc::RedrawnWalk{0}; }, "options.max_redraws = 0");
  refused([](Options& o) { o.max_stages = 0; }, "options.max_stages = 0");
  for (const double step : {-1e-9, 1.0, not_a_number}) {
    refused([=](Options& o) { o.minimum_step = step; }, "options.minimum_step");
  }
  refused([](Options& o) { o.threads = 0; }, "options.threads = 0");
  refused([](Options& o) { o.batch_rows = -1; }, "options.batch_rows = -1");
  for (const double target : {0.0, -1.0, infinity, not_a_number}) {
    refused([=](Options& o) { o.criterion = tmcmc::coefficient_of_variation_rule(target); },
            "options.cov_target = ");
    refused([=](Options& o) { o.criterion = tmcmc::effective_sample_size_rule(target); },
            "options.ess_fraction = ");
  }
  refused([](Options& o) { o.criterion = tmcmc::effective_sample_size_rule(1.1); },
          "options.ess_fraction = 1.1: expected a number in (0, 1]");
}
