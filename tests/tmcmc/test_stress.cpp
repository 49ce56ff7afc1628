// What the sampler does where a model or a prior is at the edge of what doubles hold: every case
// ends in a stated way.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <mutex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tmcmc/problems.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using problems::by_rows;
using tmcmc::BoxPrior;
using tmcmc::Index;
using tmcmc::Options;
using tmcmc::Problem;
using tmcmc::Result;
using tmcmc::StopReason;
using tmcmc::WarningKind;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double huge = 1e300;

/// One of each family of moves and coordinates, 200 samples each.
std::vector<std::pair<std::string, Options>> every_kind() {
  Options paper;
  paper.samples = 200;
  Options redraw = paper;
  redraw.proposal = tmcmc::RedrawnWalk{};
  Options growing = paper;
  growing.move = tmcmc::GrowingChains{};
  Options adaptive = paper;
  adaptive.scale_rule = tmcmc::TargetAcceptance{};
  adaptive.proposal = tmcmc::MetropolisProposal{.coordinates = tmcmc::Coordinates::unbounded};
  adaptive.cross_fit = true;
  return {{"paper", paper},
          {"redraw", redraw},
          {"growing chains", growing},
          {"adaptive, unbounded", adaptive},
          {"recommended", tmcmc::recommended_moves(2600)}};
}

BoxPrior unit_box(Index dimension = 2) {
  return {Eigen::VectorXd::Zero(dimension), Eigen::VectorXd::Ones(dimension)};
}

bool has_warning(const Result& result, WarningKind kind) {
  return std::any_of(result.diagnostics.warnings.begin(), result.diagnostics.warnings.end(),
                     [kind](const tmcmc::Warning& warning) { return warning.kind == kind; });
}

void check_inside(const Result& result, const BoxPrior& prior) {
  for (Index j = 0; j < prior.dimension(); ++j) {
    CHECK(result.final.points.col(j).minCoeff() >= prior.lower()[j]);
    CHECK(result.final.points.col(j).maxCoeff() <= prior.upper()[j]);
  }
}

}  // namespace

TEST_CASE("equal log-likelihoods, however large: one stage and their evidence", "[tmcmc][stress]") {
  for (const auto& [name, options] : every_kind()) {
    for (const double value : {huge, -huge, 1.7e308, -1.7e308, 0.0}) {
      CAPTURE(name, value);
      const Problem problem = {by_rows([v = value](const auto&) { return v; }), unit_box()};
      const Result result = tmcmc::run(problem, options, {});
      CHECK(result.stop == StopReason::completed);
      CHECK(result.stages.size() == 1);
      CHECK(result.final.log_evidence == value);
      CHECK_THAT(result.evidence.log_evidence, WithinRel(value, 1e-15) || WithinAbs(value, 1e-14));
      check_inside(result, problem.prior);
    }
  }
}

TEST_CASE("log-likelihoods that spread over 1e300 need a step below the smallest: the run says so",
          "[tmcmc][stress]") {
  for (const auto& [name, options] : every_kind()) {
    for (const double range : {huge, -huge, 1.7e308, -1.7e308}) {
      CAPTURE(name, range);
      const Problem problem = {by_rows([r = range](const auto& x) { return r * (2.0 * x[0] - 1.0); }),
                               unit_box()};
      const Result result = tmcmc::run(problem, options, {});
      CHECK(result.stop == StopReason::step_too_small);
      CHECK(result.stages.empty());
      CHECK(result.final.beta == 0.0);
      CHECK(result.final.log_evidence == 0.0);
      CHECK(has_warning(result, WarningKind::not_completed));
      CHECK((result.final.points == problem.prior.sample(options.samples, {})));
    }
  }
}

TEST_CASE("a penalty of 1e300 stands for exclusion no better than it can: the run says so",
          "[tmcmc][stress]") {
  for (const auto& [name, options] : every_kind()) {
    CAPTURE(name);
    const auto with_penalty = [](double penalty) {
      return Problem{by_rows([penalty](const auto& x) { return x[0] > 0.5 ? penalty : -x[1]; }), unit_box()};
    };
    CHECK(tmcmc::run(with_penalty(-huge), options, {}).stop == StopReason::step_too_small);
    const Result excluded = tmcmc::run(with_penalty(-infinity), options, {});
    CHECK(excluded.stop == StopReason::completed);
    CHECK(excluded.final.points.col(0).maxCoeff() <= 0.5);
  }
}

TEST_CASE("all but one sample excluded: completed, with warnings of a population of one point",
          "[tmcmc][stress]") {
  for (const auto& [name, options] : every_kind()) {
    CAPTURE(name);
    const double only = unit_box().sample(options.samples, {})(17, 0);
    const Problem problem = {by_rows([only](const auto& x) { return x[0] == only ? -3.0 : -infinity; }),
                             unit_box()};
    const Result result = tmcmc::run(problem, options, {});
    CHECK(result.stop == StopReason::completed);
    CHECK((result.final.points.col(0).array() == only).all());
    CHECK_THAT(result.final.log_evidence, WithinAbs(-3.0 - std::log(200.0), 1e-12));
    CHECK(has_warning(result, WarningKind::few_feasible));
    CHECK(has_warning(result, WarningKind::few_ancestors));
    CHECK(result.evidence.standard_error > 0.9);  // of one draw: 1

    Options all = options;
    all.criterion.counted = tmcmc::Counted::all;
    CHECK_THROWS_WITH(tmcmc::run(problem, all, {}), Contains("1 of 200 samples are feasible"));
  }
}

TEST_CASE("NaN and plus infinity are named with their parameter point, at the prior and in the moves",
          "[tmcmc][stress]") {
  for (const auto& [name, options] : every_kind()) {
    for (const double bad : {not_a_number, infinity}) {
      for (const bool at_prior : {true, false}) {
        CAPTURE(name, bad, at_prior);
        std::mutex mutex;
        std::vector<std::string> bad_points;
        Index rows_seen = 0;
        const Problem problem = {
            [&, b = bad, first = at_prior, prior_rows = options.samples](
                const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
              const std::lock_guard lock(mutex);
              values = -points.rowwise().sum();
              if (first || rows_seen >= prior_rows) {
                values[points.rows() - 1] = b;
                std::ostringstream text;
                text.precision(17);
                text << '(' << points(points.rows() - 1, 0) << ", " << points(points.rows() - 1, 1) << ')';
                bad_points.push_back(text.str());
              }
              rows_seen += points.rows();
            },
            unit_box()};
        std::string message;
        try {
          static_cast<void>(tmcmc::run(problem, options, {}));
        } catch (const tmcmc::SamplingError& error) {
          message = error.what();
        }
        REQUIRE(bad_points.size() >= 1);
        CHECK_THAT(message,
                   Contains(std::isnan(bad) ? "log-likelihood is nan at " : "log-likelihood is inf at "));
        CHECK_THAT(message, Contains(bad_points.front()));
      }
    }
  }
}

TEST_CASE("a parameter without room stays where it is, and the others are sampled", "[tmcmc][stress]") {
  const double middle = std::nextafter(1.0, 2.0);
  for (const double top : {std::nextafter(middle, 2.0), 1.0 + 1e-15}) {
    const BoxPrior prior(Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(top, 1.0));
    for (const auto& [name, options] : every_kind()) {
      CAPTURE(name, top - middle);
      const Problem problem = {by_rows([](const auto& x) { return -0.5 * std::pow((x[1] - 0.5) / 0.02, 2); }),
                               prior};
      const Result result = tmcmc::run(problem, options, {});
      CHECK(result.stop == StopReason::completed);
      check_inside(result, prior);
      const auto x = result.final.points.col(1);
      CHECK_THAT(x.mean(), WithinAbs(0.5, 0.01));
      const double sd = std::sqrt((x.array() - x.mean()).square().mean());
      CHECK(sd > 0.01);
      CHECK(sd < 0.04);
    }
  }
}

TEST_CASE("a box of no width is refused, naming the parameter", "[tmcmc][stress]") {
  CHECK_THROWS_WITH(BoxPrior(Eigen::Vector2d(0.0, 3.0), Eigen::Vector2d(1.0, 3.0)),
                    Contains("parameter 1") && Contains("lower < upper"));
}

TEST_CASE("two samples, with every kind of move", "[tmcmc][stress]") {
  const Problem problem = {by_rows([](const auto& x) { return -100.0 * (x[0] + x[1]); }), unit_box()};
  for (auto [name, options] : every_kind()) {
    CAPTURE(name);
    options.samples = 2;
    if (auto* waste_free = std::get_if<tmcmc::WasteFree>(&options.move)) waste_free->chains = 1;
    options.evaluation_budget = 0;
    options.criterion = tmcmc::effective_sample_size_rule(0.9);
    const Result result = tmcmc::run(problem, options, {});
    CHECK(result.stop == StopReason::completed);
    CHECK(result.final.points.rows() == 2);
    CHECK(std::isfinite(result.final.log_evidence));
    CHECK(std::isfinite(result.evidence.log_evidence));
    CHECK(!std::isnan(result.evidence.standard_error));
    CHECK(!result.diagnostics.warnings.empty());
    check_inside(result, problem.prior);
  }
}

TEST_CASE("a posterior in a corner a millionth of the box wide: mean and evidence", "[tmcmc][stress]") {
  constexpr double rate = 1e6;
  const Problem problem = {by_rows([](const auto& x) { return -rate * (x[0] + x[1]); }), unit_box()};
  const double exact = -2.0 * std::log(rate);
  for (auto [name, options] : every_kind()) {
    if (std::holds_alternative<tmcmc::GrowingChains>(options.move) ||
        std::holds_alternative<tmcmc::RedrawnWalk>(options.proposal)) {
      continue;  // biased: the paper's wording, and the published scripts
    }
    CAPTURE(name);
    options.samples = 2000;
    options.evaluation_budget = 0;
    if (auto* waste_free = std::get_if<tmcmc::WasteFree>(&options.move)) waste_free->chains = 50;
    if (auto* resample_move = std::get_if<tmcmc::ResampleMove>(&options.move)) resample_move->steps = 10;
    if (auto* fixed = std::get_if<tmcmc::FixedScale>(&options.scale_rule)) fixed->scale = 0.8;
    const Result result = tmcmc::run(problem, options, {.seed = 3});
    CHECK(result.stop == StopReason::completed);
    CHECK(result.evidence.standard_error < 0.3);
    CHECK(std::fabs(result.evidence.log_evidence - exact) < 4.0 * result.evidence.standard_error);
    for (Index j = 0; j < 2; ++j) {
      const double standard_error = 1.0 / (rate * std::sqrt(result.diagnostics.effective_sample_size[j]));
      CHECK(std::fabs(result.final.points.col(j).mean() - 1.0 / rate) < 4.0 * standard_error);
    }
  }
}

TEST_CASE("fifty dimensions: means and variances, and a warning where the evidence is biased",
          "[tmcmc][stress]") {
  constexpr Index dimension = 50;
  constexpr double sd = 0.1;
  const Problem problem = {
      by_rows([](const auto& x) { return -0.5 * (x.array() - 0.5).square().sum() / (sd * sd); }),
      unit_box(dimension)};
  Options options = tmcmc::recommended_moves(200000);
  options.samples = 8000;
  options.move = tmcmc::WasteFree{100};
  const Result result = tmcmc::run(problem, options, {.seed = 4});
  CHECK(result.stop == StopReason::completed);
  CHECK(has_warning(result, WarningKind::few_for_covariance));
  const auto n = result.diagnostics.effective_sample_size.mean();
  const Eigen::RowVectorXd mean = result.final.points.colwise().mean();
  CHECK((mean.array() - 0.5).square().mean() < 3.0 * sd * sd / n);
  const double variance = (result.final.points.rowwise() - mean).array().square().mean();
  CHECK_THAT(variance, WithinRel(sd * sd, 0.05));
}
