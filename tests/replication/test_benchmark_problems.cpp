// Problems with known evidence, and what is measured on them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "errors/invalid_value.hpp"
#include "replication/accuracy.hpp"
#include "replication/benchmark_scores.hpp"

using namespace replication;

namespace {

const BenchmarkProblem& named(const std::vector<BenchmarkProblem>& problems, const std::string& name) {
  for (const auto& p : problems) {
    if (p.name == name) {
      return p;
    }
  }
  throw std::out_of_range(name);
}

/// Mean likelihood over a grid of midpoints of the box, which has two or three dimensions.
double log_mean_likelihood(const tmcmc::Problem& problem, tmcmc::Index points_each) {
  const tmcmc::Index d = problem.prior.dimension();
  const auto n = static_cast<tmcmc::Index>(std::pow(points_each, d) + 0.5);
  tmcmc::Population x(n, d);
  for (tmcmc::Index i = 0; i < n; ++i) {
    tmcmc::Index rest = i;
    for (tmcmc::Index j = 0; j < d; ++j) {
      const double part = (static_cast<double>(rest % points_each) + 0.5) / static_cast<double>(points_each);
      x(i, j) = problem.prior.lower()[j] + part * (problem.prior.upper()[j] - problem.prior.lower()[j]);
      rest /= points_each;
    }
  }
  Eigen::VectorXd values(n);
  problem.log_likelihood(x, values);
  const double largest = values.maxCoeff();
  return largest + std::log((values.array() - largest).exp().mean());
}

}  // namespace

TEST_CASE("The stated log-evidence of problems in two dimensions is that of a fine grid") {
  const auto problems = closed_form_problems();
  for (const char* name :
       {"Gaussian, 2-D", "banana, 2-D", "five narrow modes, 2-D", "spike and slab, 2-D", "corner, 2-D"}) {
    const auto& p = named(problems, name);
    INFO(name);
    CHECK(log_mean_likelihood(p.problem, 2000) == Approx(p.log_evidence).margin(2e-3));
  }
}

TEST_CASE("The evidence of a frame by change of variables is that of a grid over its stiffnesses") {
  const auto problems = structural_problems();
  auto p = named(problems, "frame, wide priors");
  // The same likelihood on the part of the box that holds its modes.
  const double part = 4.0;
  p.problem.prior = tmcmc::Prior(Eigen::Vector2d::Zero(), Eigen::Vector2d::Constant(part));
  const double shift = 2.0 * std::log(1000.0 / part);
  CHECK(log_mean_likelihood(p.problem, 2000) - shift == Approx(p.log_evidence).margin(2e-3));
}

TEST_CASE("A point belongs to the mode that it is nearest to") {
  const auto problems = closed_form_problems();
  const auto& two = named(problems, "two modes, 4-D");
  CHECK(two.mode_of(Eigen::RowVectorXd::Constant(4, 3.0)) == 0);
  CHECK(two.mode_of(Eigen::RowVectorXd::Constant(4, -3.0)) == 1);
  CHECK(two.mode_masses == std::vector<double>{0.75, 0.25});
}

TEST_CASE("A mode that both searches have taken for a part of another comes with a warning") {
  // In this run of few draws each search fits one component to two modes in ten coordinates, and
  // loses the smaller one on the way.
  const auto problems = closed_form_problems();
  const auto& two = named(problems, "two modes, 10-D");
  const auto run = tmcmc::run(two.problem, tmcmc::recommended_options(10000), {.seed = 5, .run = 177});
  CHECK(run.evidence.log_evidence < two.log_evidence - 5.0 * run.evidence.standard_error);
  CHECK(std::max(run.measurement->search_beta[0], run.measurement->search_beta[1]) < 1.0);
  REQUIRE(run.diagnostics.warnings.size() == 1);
  CHECK(run.diagnostics.warnings[0].kind == tmcmc::WarningKind::few_draws_a_mode);
}

TEST_CASE("A score counts errors, warnings, modes and runs that did not finish") {
  const auto s = score({{.error = 0.3, .standard_error = 0.1, .effective_draws = 10, .warned = true},
                        {.error = -0.1, .standard_error = 0.1, .effective_draws = 30, .worst_mode_mass = 0.2},
                        {.warned = true, .finished = false}});
  CHECK(s.rms_error == Approx(std::sqrt(0.05)));
  CHECK(s.bias == Approx(0.1));
  CHECK(s.rms_z == Approx(std::sqrt(5.0)));
  CHECK(s.worst_z == Approx(3.0));
  CHECK(s.worst_z_without_warning == Approx(1.0));
  CHECK(s.warned == Approx(2.0 / 3.0));
  CHECK(s.unfinished == Approx(1.0 / 3.0));
  CHECK(s.effective_draws == Approx(20.0));
  CHECK(s.mode_masses_found == Approx(0.5));
  CHECK_THROWS_AS(score({}), errors::InvalidValue);
}

TEST_CASE("Each sampler runs on a problem at its evaluations, the same for any number of threads") {
  const auto problems = closed_form_problems();
  const auto& p = named(problems, "Gaussian, 2-D");
  for (const auto sampler :
       {BenchmarkSampler::published, BenchmarkSampler::better_moves, BenchmarkSampler::recommended}) {
    const auto one = benchmark_runs(p, sampler, 3000, 0, {.runs = 3, .threads = 1});
    const auto two = benchmark_runs(p, sampler, 3000, 0, {.runs = 3, .threads = 2});
    for (std::size_t i = 0; i < one.size(); ++i) {
      CHECK(one[i].error == two[i].error);
      CHECK(std::fabs(one[i].error) < 6.0 * one[i].standard_error);
    }
  }
}

TEST_CASE("Runs of weighted draws have the moments of all of them, and p-boxes of 1000 drawn from them") {
  const auto problems = closed_form_problems();
  const auto& p = named(problems, "Gaussian, 2-D");
  const StudyOptions options{.runs = 8, .threads = 2};
  const auto runs = run_arm(p.problem, {"draws", tmcmc::recommended_options(5000)}, 0, options);
  REQUIRE(runs.size() == 8);
  double squares = 0.0;
  for (const auto& run : runs) {
    CHECK(run.result.final.evaluations == 5000);
    CHECK(run.standard_deviation[0] == Approx(1.0).margin(0.1));
    squares += run.mean[0] * run.mean[0] / 8.0;
  }
  CHECK(std::sqrt(squares) < 0.031);  // 1000 draws would give 0.032
  const auto a = accuracy(runs, {Eigen::VectorXd::Zero(2), Eigen::VectorXd::Ones(2), p.log_evidence});
  CHECK(a.evidence_rms < 0.02);
  const auto areas = paper_sized_areas(runs, 0, options);
  REQUIRE(areas.size() == 10);
  const double of_all = pbox_areas(runs)[0];
  double mean_area = 0.0;
  for (const auto& area : areas) {
    CHECK(area[0] > 1.2 * of_all);  // of 1000 draws in place of more than 2000
    mean_area += area[0] / 10.0;
  }
  // By simulation: eight times 2160 independent normals, of which 1000 are drawn ten times over.
  constexpr double of_independent_draws = 0.175;
  constexpr double sd = 0.0091;
  CHECK(mean_area == Approx(of_independent_draws).margin(5.0 * sd));
}
