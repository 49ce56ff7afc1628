// Studies: determinism, what is reported of the runs, and a small one against the exact posterior.

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "errors/invalid_value.hpp"
#include "replication/friction_study.hpp"
#include "tmcmc/statistics.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using replication::Arm;
using replication::paper_arms;
using replication::ReadingName;
using replication::Run;
using replication::run_arm;
using replication::StudyOptions;
using test_data::paper_problem;
using test_data::small_reading;

// The exact posterior of the published physics on Table 1, by quadrature.
constexpr double exact_friction_force_n = 0.98189;
constexpr double exact_friction_force_sd_n = 0.03048;
constexpr double exact_natural_frequency_hz = 3.08145;
constexpr double exact_natural_frequency_sd_hz = 0.01139;

constexpr double rounding = 1e-12;

Run run_with(std::initializer_list<std::initializer_list<double>> rows, std::size_t stages = 1) {
  Run run;
  run.result.final.points.resize(static_cast<Eigen::Index>(rows.size()),
                                 static_cast<Eigen::Index>(rows.begin()->size()));
  Eigen::Index i = 0;
  for (const auto& row : rows) {
    Eigen::Index j = 0;
    for (const double value : row) {
      run.result.final.points(i, j++) = value;
    }
    ++i;
  }
  run.result.weights.setOnes(run.result.final.points.rows());
  run.result.stages.resize(stages);
  return run;
}

statistics::Estimate mean_over_runs(const std::vector<Run>& runs, Eigen::Index parameter) {
  std::vector<double> means;
  for (const Run& run : runs) {
    means.push_back(run.mean[parameter]);
  }
  return statistics::estimate(means);
}

}  // namespace

TEST_CASE("a study has the same bits on any number of threads, and run i is the run of stream i", "[study]") {
  for (const ReadingName name : {ReadingName::as_published, ReadingName::as_worded, ReadingName::corrected}) {
    CAPTURE(static_cast<int>(name));
    const auto reading = small_reading(name, 120);
    const auto problem = paper_problem(reading);
    const Arm arm = paper_arms(reading)[1];
    StudyOptions options{.runs = 5, .seed = 9, .study = 3};
    const auto reference = run_arm(problem, arm, 1, options);
    REQUIRE(reference.size() == 5);
    for (const int threads : {2, 3}) {
      options.threads = threads;
      const auto runs = run_arm(problem, arm, 1, options);
      REQUIRE(runs.size() == 5);
      for (std::size_t i = 0; i < runs.size(); ++i) {
        CHECK((runs[i].result.final.points == reference[i].result.final.points));
        CHECK(runs[i].result.final.log_evidence == reference[i].result.final.log_evidence);
        CHECK((runs[i].mean == reference[i].mean));
        CHECK((runs[i].standard_deviation == reference[i].standard_deviation));
        CHECK(runs[i].iterations() == reference[i].iterations());
      }
    }
    const auto alone = tmcmc::run(problem, arm.options, {.seed = 9, .study = 3, .arm = 1, .run = 4});
    CHECK((alone.final.points == reference[4].result.final.points));
    options = {.runs = 2, .seed = 9, .study = 3};
    const auto fewer = run_arm(problem, arm, 1, options);
    CHECK((fewer[1].result.final.points == reference[1].result.final.points));
  }
}

TEST_CASE("runs, arms, studies and seeds are different draws", "[study]") {
  const auto reading = small_reading(ReadingName::corrected, 60);
  const auto problem = paper_problem(reading);
  const Arm arm = paper_arms(reading)[0];
  std::vector<double> means;
  const auto add = [&](std::uint32_t index, const StudyOptions& options) {
    for (const Run& run : run_arm(problem, arm, index, options)) {
      means.push_back(run.mean[0]);
    }
  };
  add(0, {.runs = 3, .seed = 1});
  add(1, {.runs = 3, .seed = 1});
  add(0, {.runs = 3, .seed = 2});
  add(0, {.runs = 3, .seed = 1, .study = 1});
  std::sort(means.begin(), means.end());
  CHECK(std::adjacent_find(means.begin(), means.end()) == means.end());
}

TEST_CASE("mean and standard deviation of a run are those of its samples", "[study]") {
  const auto reading = small_reading(ReadingName::corrected, 150);
  const auto runs = run_arm(paper_problem(reading), paper_arms(reading)[0], 0, {.runs = 2});
  for (const Run& run : runs) {
    REQUIRE(run.mean.size() == 4);
    for (Eigen::Index j = 0; j < 4; ++j) {
      const auto column = run.result.final.points.col(j).array();
      const double mean = column.mean();
      CHECK_THAT(run.mean[j], WithinRel(mean, rounding));
      CHECK_THAT(run.standard_deviation[j],
                 WithinRel(std::sqrt((column - mean).square().sum() / 149.0), rounding));
    }
    CHECK(run.iterations() == static_cast<tmcmc::Index>(run.result.stages.size()));
  }
}

TEST_CASE("p-box areas of given runs, by hand", "[study]") {
  // First parameter, sorted: 1 2 3 | 2 4 6 | 0 4 5; the ranges of the ranks are 2, 2 and 3.
  // Second parameter: 10 20 30 | 10 20 30 | 10 20 36.
  const std::vector<Run> runs{run_with({{3.0, 10.0}, {1.0, 30.0}, {2.0, 20.0}}),
                              run_with({{2.0, 20.0}, {4.0, 10.0}, {6.0, 30.0}}),
                              run_with({{5.0, 36.0}, {0.0, 20.0}, {4.0, 10.0}})};
  const Eigen::VectorXd areas = replication::pbox_areas(runs);
  REQUIRE(areas.size() == 2);
  CHECK(replication::pbox_areas(runs, 2) == areas);
  CHECK_THAT(areas[0], WithinRel(7.0 / 3.0, rounding));
  CHECK_THAT(areas[1], WithinRel(2.0, rounding));
  CHECK(replication::pbox_areas({runs[0]}).isZero(0.0));
  const auto error = replication::error_over_runs(
      runs, [](const auto& run) { return run.result.final.points(0, 0); }, 3.0);  // 3, 2 and 5
  CHECK_THAT(error.bias, WithinRel(1.0 / 3.0, rounding));
  CHECK_THAT(error.root_mean_square, WithinRel(std::sqrt(5.0 / 3.0), rounding));
}

TEST_CASE("iteration counts are the column of Table 4", "[study]") {
  const std::vector<Run> runs{run_with({{0.0}}, 10), run_with({{0.0}}, 9), run_with({{0.0}}, 10),
                              run_with({{0.0}}, 12)};
  CHECK(replication::iteration_counts(runs) ==
        std::map<tmcmc::Index, tmcmc::Index>{{9, 1}, {10, 2}, {12, 1}});
  CHECK(replication::iteration_counts({}).empty());
}

TEST_CASE("the observer is called once a run", "[study]") {
  const auto reading = small_reading(ReadingName::corrected, 50);
  for (const int threads : {1, 2}) {
    std::atomic<int> calls{0};
    static_cast<void>(run_arm(paper_problem(reading), paper_arms(reading)[0], 0,
                              {.runs = 4, .threads = threads}, [&] { ++calls; }));
    CHECK(calls == 4);
  }
}

TEST_CASE("a small study of the published reading agrees with the exact posterior", "[study]") {
  const auto reading = small_reading(ReadingName::as_published, 300);
  const auto problem = paper_problem(reading);
  const auto arms = paper_arms(reading);
  for (std::uint32_t a = 0; a < 2; ++a) {
    CAPTURE(arms[a].name);
    const auto runs = run_arm(problem, arms[a], a, {.runs = 20, .seed = 1});
    // Single runs of this sampler are poor (their means scatter by a posterior standard deviation),
    // so that the mean over the runs is what is right, to within standard errors taken from their
    // scatter.
    const auto friction = mean_over_runs(runs, friction::friction_force);
    CHECK(friction.errors_from(exact_friction_force_n) < statistics::standard_errors);
    CHECK(friction.standard_error < exact_friction_force_sd_n);
    const auto frequency = mean_over_runs(runs, friction::natural_frequency);
    CHECK(frequency.errors_from(exact_natural_frequency_hz) < statistics::standard_errors);
    CHECK(frequency.standard_error < exact_natural_frequency_sd_hz);
    for (const auto& [iterations, count] : replication::iteration_counts(runs)) {
      CAPTURE(count);
      CHECK(iterations >= 8);
      CHECK(iterations <= 12);
    }
    const Eigen::VectorXd areas = replication::pbox_areas(runs);
    CHECK(areas[friction::friction_force] > 0.01);
    CHECK(areas[friction::friction_force] < 0.5);
    CHECK(areas[friction::natural_frequency] > 0.001);
    CHECK(areas[friction::natural_frequency] < 0.1);
    for (const Run& run : runs) {  // penalised draws are gone at the end
      CHECK(run.result.final.log_likelihood.minCoeff() > -1000.0);
      CHECK(run.result.stages.front().step < 1e-8);
      CHECK(run.result.stages.front().feasible < 100);
    }
  }
}

TEST_CASE("better moves bring every run to the exact posterior", "[study]") {
  auto reading = small_reading(ReadingName::as_published, 400);
  reading.sampler.proposal = tmcmc::MetropolisProposal{};
  reading.sampler.scale_rule = tmcmc::FixedScale{1.19};
  reading.sampler.move = tmcmc::ResampleMove{.steps = 15};
  const auto runs = run_arm(paper_problem(reading), paper_arms(reading)[0], 0, {.runs = 12, .seed = 2});
  const auto friction = mean_over_runs(runs, friction::friction_force);
  CHECK(friction.errors_from(exact_friction_force_n) < statistics::standard_errors);
  CHECK(friction.standard_error < 0.1 * exact_friction_force_sd_n);
  const auto frequency = mean_over_runs(runs, friction::natural_frequency);
  CHECK(frequency.errors_from(exact_natural_frequency_hz) < statistics::standard_errors);
  CHECK(frequency.standard_error < 0.1 * exact_natural_frequency_sd_hz);
  std::vector<double> sds;
  for (const Run& run : runs) {
    sds.push_back(run.standard_deviation[friction::friction_force]);
  }
  CHECK(statistics::estimate(sds).errors_from(exact_friction_force_sd_n) < statistics::standard_errors);
}

TEST_CASE("moments and evidence on a small box agree with a quadrature by midpoints", "[study]") {
  // The posterior is a product of two densities of a location and a noise level, here on 300 x 300
  // points.
  const Eigen::Vector4d lower(0.7, 2.9, 1.0, 0.003);
  const Eigen::Vector4d upper(1.3, 3.25, 10.0, 0.06);
  auto reading = small_reading(ReadingName::corrected, 400);
  reading.sampler.scale_rule = tmcmc::FixedScale{1.19};
  reading.sampler.move = tmcmc::ResampleMove{.steps = 40};
  const friction::Likelihood likelihood(test_data::table1(), reading.physics);
  constexpr int cells = 300;
  struct Quadrature {
    double mass = 0.0;
    double first = 0.0;
    double second = 0.0;
  };
  const auto integrate = [&](auto misfit, Eigen::Index location, Eigen::Index noise) {
    Quadrature sums;
    for (int i = 0; i < cells; ++i) {
      const double x = lower[location] + (upper[location] - lower[location]) * (i + 0.5) / cells;
      const double squares = misfit(x);
      for (int j = 0; j < cells; ++j) {
        const double sigma = lower[noise] + (upper[noise] - lower[noise]) * (j + 0.5) / cells;
        const double p = std::exp(-10.0 * std::log(sigma) - 0.5 * squares / (sigma * sigma));
        sums.mass += p / (cells * cells);
        sums.first += p * x / (cells * cells);
        sums.second += p * x * x / (cells * cells);
      }
    }
    return sums;
  };
  const auto phase = integrate([&](double force) { return likelihood.phase_misfit(force); },
                               friction::friction_force, friction::phase_noise);
  const auto ratio = integrate([&](double frequency) { return likelihood.frequency_misfit(frequency); },
                               friction::natural_frequency, friction::frequency_ratio_noise);
  const double log_evidence =
      std::log(phase.mass) + std::log(ratio.mass) - 10.0 * std::log(6.283185307179586);

  const tmcmc::Problem problem = replication::problem(reading, test_data::table1(), {lower, upper});
  for (std::uint32_t a = 0; a < 2; ++a) {
    const Arm arm = paper_arms(reading)[a];
    CAPTURE(arm.name);
    const auto runs = run_arm(problem, arm, a, {.runs = 30, .seed = 3});
    std::vector<double> evidence;
    for (const Run& run : runs) {
      evidence.push_back(run.result.final.log_evidence);
    }
    for (const auto& [parameter, exact] :
         {std::pair{friction::friction_force, phase}, std::pair{friction::natural_frequency, ratio}}) {
      CAPTURE(static_cast<int>(parameter));
      const double mean = exact.first / exact.mass;
      const double sd = std::sqrt(exact.second / exact.mass - mean * mean);
      CHECK(mean_over_runs(runs, parameter).errors_from(mean) < statistics::standard_errors);
      std::vector<double> sds;
      for (const Run& run : runs) {
        sds.push_back(run.standard_deviation[parameter]);
      }
      CHECK(statistics::estimate(sds).errors_from(sd) < statistics::standard_errors);
    }
    const auto e = statistics::estimate(evidence);
    CHECK(e.standard_deviation < 0.3);
    // log Z is low by half its variance
    CHECK_THAT(e.mean + 0.5 * e.standard_deviation * e.standard_deviation,
               WithinAbs(log_evidence, statistics::standard_errors * e.standard_error));
  }
}

TEST_CASE("a failing run is named by sampler and number", "[study]") {
  const auto reading = small_reading(ReadingName::corrected, 50);
  const auto problem = paper_problem(reading);
  Arm arm = paper_arms(reading)[1];
  arm.options.max_stages = 2;
  for (const int threads : {1, 3}) {
    const StudyOptions options{.runs = 4, .threads = threads};
    CHECK_THROWS_AS(run_arm(problem, arm, 1, options), tmcmc::SamplingError);
    CHECK_THROWS_WITH(run_arm(problem, arm, 1, options),
                      Contains("TMCMC-II, run 0") && Contains("max_stages") && Contains("2 stages"));
  }
  arm = paper_arms(reading)[0];
  arm.options.criterion = tmcmc::effective_sample_size_rule(1.0);
  CHECK_THROWS_WITH(run_arm(problem, arm, 0, {.runs = 1}),
                    Contains("TMCMC, run 0") && Contains("minimum_step"));

  // Only the third run fails.
  arm = paper_arms(reading)[0];
  const auto third = tmcmc::init(problem, arm.options, {.seed = 1, .run = 2});
  const double marked = third.points(0, 0);
  const tmcmc::Problem breaks = {
      [&](const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
        problem.log_likelihood(points, values);
        if (points(0, 0) == marked) {
          values[0] = std::numeric_limits<double>::quiet_NaN();
        }
      },
      problem.prior};
  CHECK_THROWS_WITH(run_arm(breaks, arm, 0, {.runs = 4, .seed = 1, .threads = 2}),
                    Contains("TMCMC, run 2") && Contains("nan"));
}

TEST_CASE("a prior without a feasible point fails, penalty or not", "[study]") {
  for (const ReadingName name : {ReadingName::as_published, ReadingName::as_worded, ReadingName::corrected}) {
    const auto reading = small_reading(name, 100);
    const tmcmc::BoxPrior prior(Eigen::Vector4d(5.0, 0.01, 0.001, 0.001),
                                Eigen::Vector4d(10.0, 10.0, 10.0, 1.0));
    const auto problem = replication::problem(reading, test_data::table1(), prior);
    for (const Arm& arm : paper_arms(reading)) {
      CHECK_THROWS_AS(run_arm(problem, arm, 0, {.runs = 2}), tmcmc::SamplingError);
      CHECK_THROWS_WITH(run_arm(problem, arm, 0, {.runs = 2}), Contains(arm.name) && Contains("feasible"));
    }
  }
}

TEST_CASE("study options out of range are refused by name", "[study]") {
  const auto reading = small_reading(ReadingName::corrected, 50);
  const auto problem = paper_problem(reading);
  const Arm arm = paper_arms(reading)[0];
  CHECK_THROWS_AS(run_arm(problem, arm, 0, {.runs = 0}), errors::InvalidValue);
  CHECK_THROWS_WITH(run_arm(problem, arm, 0, {.runs = 0}), Contains("runs = 0"));
  CHECK_THROWS_WITH(run_arm(problem, arm, 0, {.threads = 0}), Contains("threads = 0"));
  CHECK(StudyOptions{}.runs == 50);
  Arm broken = arm;
  broken.options.samples = 0;
  CHECK_THROWS_AS(run_arm(problem, broken, 0, {.runs = 2}), std::invalid_argument);
}
