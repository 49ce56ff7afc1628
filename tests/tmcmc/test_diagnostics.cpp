// What a run says of itself: effective sample sizes against the truth, and warnings where something
// is wrong, only there.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tmcmc/detail/population_move.hpp"
#include "tmcmc/diagnostics.hpp"
#include "tmcmc/replicates.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using replicates::gamma_normal;
using replicates::problem_of;
using replicates::replicate;
using statistics::Estimate;
using statistics::standard_errors;
using tmcmc::effective_sample_sizes;
using tmcmc::Genealogy;
using tmcmc::Index;
using tmcmc::Options;
using tmcmc::Population;
using tmcmc::Problem;
using tmcmc::Result;
using tmcmc::Warning;
using tmcmc::WarningKind;

bool warns(const Result& result, WarningKind kind) {
  const auto& list = result.diagnostics.warnings;
  return std::any_of(list.begin(), list.end(), [=](const Warning& w) { return w.kind == kind; });
}

/// Harmonic mean over repetitions: 1 / (effective size) is what is estimated without bias, as a
/// variance of a mean.
double harmonic_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) {
    sum += 1.0 / value;
  }
  return static_cast<double>(values.size()) / sum;
}

Population columns(const std::vector<double>& a, const std::vector<double>& b) {
  Population points(static_cast<Index>(a.size()), 2);
  std::copy(a.begin(), a.end(), points.col(0).begin());
  std::copy(b.begin(), b.end(), points.col(1).begin());
  return points;
}

}  // namespace

TEST_CASE("effective sample size of chains: autoregressions of known correlation", "[tmcmc][diagnostics]") {
  constexpr Index chains = 40;
  constexpr Index steps = 200;
  constexpr double correlation = 0.9;  // for long chains (1 - c) / (1 + c) of the states count
  statistics::Uniforms uniform(41);
  std::vector<double> correlated;
  std::vector<double> independent;
  for (int repetition = 0; repetition < 50; ++repetition) {
    Population points(chains * steps, 2);
    for (Index c = 0; c < chains; ++c) {
      double x = uniform.normal();
      for (Index t = 0; t < steps; ++t) {
        points(t * chains + c, 0) = x;
        points(t * chains + c, 1) = std::exp(uniform.normal());
        x = correlation * x + std::sqrt(1.0 - correlation * correlation) * uniform.normal();
      }
    }
    const Eigen::VectorXd size = effective_sample_sizes(points, {.chains = chains, .parents = {}});
    correlated.push_back(size[0]);
    independent.push_back(size[1]);
  }
  double inflation = 1.0;  // of the variance of the mean of one chain: 1 + 2 sum (1 - t/P) c^t
  for (Index t = 1; t < steps; ++t) {
    inflation += 2.0 * (1.0 - static_cast<double>(t) / steps) * std::pow(correlation, t);
  }
  // A variance from 50 times 39 degrees of freedom has a standard error of sqrt(2 / 1950) = 3.2 %.
  CHECK_THAT(harmonic_mean(correlated) * inflation / (chains * steps),
             WithinAbs(1.0, standard_errors * 0.032));
  CHECK_THAT(harmonic_mean(independent) / (chains * steps), WithinAbs(1.0, standard_errors * 0.032));
}

TEST_CASE("relatives count together, back to the stage that still has enough families",
          "[tmcmc][diagnostics]") {
  // 30 families of 20 equal values in column 0; without any relation in column 1.
  statistics::Uniforms uniform(42);
  std::vector<double> families;
  std::vector<double> others;
  std::vector<Index> founder;
  for (Index f = 0; f < 30; ++f) {
    const double value = uniform.normal();
    for (int k = 0; k < 20; ++k) {
      families.push_back(value);
      others.push_back(uniform.normal());
      founder.push_back(f);
    }
  }
  const Population points = columns(families, others);
  std::vector<Index> own(600);
  for (std::size_t i = 0; i < own.size(); ++i) {
    own[i] = static_cast<Index>(i);
  }
  const std::vector<Index> one_founder(600, 7);
  std::vector<Index> two_founders(30, 7);
  std::fill(two_founders.begin(), two_founders.begin() + 15, 3);
  const auto sizes = [&](std::vector<std::vector<Index>> parents) {
    return effective_sample_sizes(points, {.chains = 600, .parents = std::move(parents)});
  };
  const auto near_thirty = WithinAbs(29.0, 1e-9);  // equal families: G - 1
  CHECK_THAT(sizes({founder, own})[0], near_thirty);
  CHECK_THAT(sizes({std::vector<Index>(8, 5), two_founders, founder, own})[0], near_thirty);
  CHECK(sizes({founder, own})[1] > 200.0);
  CHECK_THAT(sizes({one_founder, own})[0], WithinAbs(599.0, 1e-9));  // what no generation tells is not seen
  CHECK_THAT(sizes({})[0], WithinAbs(599.0, 1e-9));
  CHECK(effective_sample_sizes(Population::Constant(600, 1, 2.0), {.chains = 600, .parents = {}})[0] == 0.0);
  CHECK(effective_sample_sizes(points, {.chains = 1, .parents = {}})[0] == 0.0);
}

TEST_CASE("effective sample sizes of runs agree with the spread of their means", "[tmcmc][diagnostics]") {
  for (const bool waste_free : {false, true}) {
    for (const Index steps : {4, 16}) {  // poor and good mixing
      CAPTURE(waste_free, steps);
      Options options;
      options.samples = waste_free ? 100 * (steps + 1) : 400;
      options.move = tmcmc::ResampleMove{.steps = steps};
      if (waste_free) options.move = tmcmc::WasteFree{100};
      options.scale_rule = tmcmc::FixedScale{1.0};
      const auto results = replicate(gamma_normal(), options, 43, 100);
      const double sd[] = {std::sqrt(3.0) / 2.0, std::sqrt(0.75 + 0.36)};
      for (Index j = 0; j < 2; ++j) {
        CAPTURE(j);
        std::vector<double> sizes;
        for (const Result& result : results) {
          sizes.push_back(result.diagnostics.effective_sample_size[j]);
        }
        const Estimate mean = replicates::mean_of(
            results, [](double x) { return x; }, j);
        const double true_size = sd[j] * sd[j] / (mean.standard_deviation * mean.standard_deviation);
        const double ratio = harmonic_mean(sizes) / true_size;
        CHECK(ratio > 1.0 / 1.6);  // 14 % of which are chance
        CHECK(ratio < 1.6);
      }
    }
  }
}

TEST_CASE("a healthy run has no warnings, and without diagnose none of it is computed",
          "[tmcmc][diagnostics]") {
  Options options = replicates::good_options(2);
  for (const Result& result : replicate(gamma_normal(), options, 44, 20)) {
    CHECK(result.diagnostics.warnings.empty());
    CHECK(result.diagnostics.effective_sample_size.minCoeff() > 100.0);
    CHECK(result.final.genealogy.parents.size() == result.stages.size());
  }
  const Result diagnosed = tmcmc::run(gamma_normal(), options, {.seed = 44});
  options.diagnose = false;
  const Result plain = tmcmc::run(gamma_normal(), options, {.seed = 44});
  CHECK((plain.final.points == diagnosed.final.points));
  CHECK(plain.final.log_evidence == diagnosed.final.log_evidence);
  CHECK(plain.diagnostics.effective_sample_size.size() == 0);
  CHECK(plain.evidence.standard_error == 0.0);
  CHECK(plain.final.genealogy.parents.empty());
}

TEST_CASE("a population that has collapsed is told so", "[tmcmc][diagnostics]") {
  // Chains that hardly move: what is left are copies of the few draws from the prior nearest to the
  // posterior.
  Options options;
  options.samples = 500;
  options.move = tmcmc::ResampleMove{.steps = 3};
  options.scale_rule = tmcmc::FixedScale{1e-3};
  for (const Result& result :
       replicate(replicates::problem_of([](const auto& x) { return -5000.0 * x.squaredNorm(); },
                                        Eigen::Vector4d::Constant(-1.0), Eigen::Vector4d::Constant(1.0)),
                 options, 45, 20)) {
    CHECK(warns(result, WarningKind::low_effective_size));
    CHECK(result.diagnostics.effective_sample_size.minCoeff() < 50.0);
  }
}

TEST_CASE("every kind of warning has its cause, and says what it found", "[tmcmc][diagnostics]") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Options good = replicates::good_options(2);
  const auto message = [](const Result& result, WarningKind kind) {
    for (const Warning& warning : result.diagnostics.warnings) {
      if (warning.kind == kind) {
        return warning.message;
      }
    }
    return std::string();
  };
  SECTION("not completed") {
    Options options = good;
    options.max_stages = 1;
    const Result result = tmcmc::run(gamma_normal(), options, {.seed = 46});
    CHECK_THAT(message(result, WarningKind::not_completed),
               Contains("max_stages") && Contains("below 1;") && Contains("tempered"));
  }
  SECTION("few feasible draws") {
    const Problem corner =
        problem_of([](const auto& x) { return x[0] < 0.1 && x[1] < 0.1 ? -x[0] : -infinity; },
                   Eigen::Vector2d::Zero(), Eigen::Vector2d::Ones());
    const Result result = tmcmc::run(corner, good, {.seed = 46});
    CHECK_THAT(message(result, WarningKind::few_feasible),
               Contains("feasible draws") && Contains("below 20"));
  }
  SECTION("few ancestors") {
    Options options = good;
    options.criterion = tmcmc::coefficient_of_variation_rule(15.0);  // CoV: N_eff = N / 226
    const Result result = tmcmc::run(gamma_normal(), options, {.seed = 46});
    CHECK_THAT(message(result, WarningKind::few_ancestors), Contains("of stage 1") && Contains("below 25"));
  }
  SECTION("low acceptance") {
    Options options = good;
    options.scale_rule = tmcmc::FixedScale{30.0};
    const Result result = tmcmc::run(gamma_normal(), options, {.seed = 46});
    CHECK_THAT(message(result, WarningKind::low_acceptance), Contains("acceptance rate") && Contains("0.05"));
  }
  SECTION("low effective sample size") {
    Options options = good;
    options.samples = 40;
    const Result result = tmcmc::run(gamma_normal(), options, {.seed = 46});
    CHECK_THAT(message(result, WarningKind::low_effective_size),
               Contains("parameter 0") && Contains("below 50"));
  }
  SECTION("few samples for the covariance") {
    Options options = good;
    options.samples = 50;
    const Result result = tmcmc::run(gamma_normal(), options, {.seed = 46});  // 3 entries
    CHECK_THAT(message(result, WarningKind::few_for_covariance),
               Contains("covariance of stage") && Contains("below 10"));
    options.samples = 100;
    CHECK(
        message(tmcmc::run(gamma_normal(), options, {.seed = 46}), WarningKind::few_for_covariance).empty());
  }
  SECTION("uncertain evidence") {
    Options options = good;
    options.move = tmcmc::WasteFree{1};  // no second chain that it could be measured by
    const Result result = tmcmc::run(gamma_normal(), options, {.seed = 46});
    CHECK_THAT(message(result, WarningKind::uncertain_evidence),
               Contains("log-evidence") && Contains("above 1"));
  }
}

TEST_CASE("the drift along the chains is the t value of last third minus first third",
          "[tmcmc][diagnostics]") {
  // Three chains of six states, entry k * 3 + c: rises by 4, 5 and 9 between thirds of two states.
  Eigen::VectorXd values(18);
  values << 0, 1, 2,  //
      2, 1, 0,        //
      7, 7, 7,        //
      -7, -7, -7,     //
      5, 6, 10,       //
      5, 6, 10;
  // Mean 6, standard deviation sqrt(7), standard error sqrt(7 / 3).
  CHECK(tmcmc::detail::equilibrium_t(values, 3) == Approx(6.0 / std::sqrt(7.0 / 3.0)).epsilon(1e-14));
  CHECK(tmcmc::detail::equilibrium_t(-values, 3) == Approx(-6.0 / std::sqrt(7.0 / 3.0)).epsilon(1e-14));
  CHECK(tmcmc::detail::equilibrium_t(Eigen::VectorXd::Constant(18, 3.0), 3) == 0.0);
  CHECK(tmcmc::detail::equilibrium_t(values.head(3), 3) == 0.0);                        // one state a chain
  CHECK(tmcmc::detail::equilibrium_t(values, 2) == 0.0);                                // two chains
  CHECK(tmcmc::detail::equilibrium_t(values.head(6), 3) == Approx(0.0).margin(1e-14));  // +2, 0, -2
}

TEST_CASE("few healthy runs, and nearly all that outran their chains, are said not to be in equilibrium",
          "[tmcmc][diagnostics]") {
  const auto alarms = [](const Problem& problem, Index evaluations, Index chains, std::uint32_t runs) {
    Index count = 0;
    for (std::uint32_t run = 0; run < runs; ++run) {
      const Result result =
          tmcmc::run(problem, tmcmc::recommended_moves(evaluations, chains), {.seed = 71, .run = run});
      count += warns(result, WarningKind::not_in_equilibrium) ? 1 : 0;
    }
    return count;
  };
  // At 1 % of false alarms, 7 or more of 250 would have a probability of 1 in 70; at 2 %, 3 or
  // fewer 1 in 4.
  CHECK(alarms(gamma_normal(), 5000, 10, 250) < 7);
  CHECK(alarms(gamma_normal(), 5000, 100, 250) < 7);
  // A mean and a noise level of nine readings that agree to 1 in 10^4 of the prior: the noise is
  // found last.
  const Problem precise = {
      problems::by_rows([](const auto& x) {
        double sum = 0.0;
        for (int k = -4; k <= 4; ++k) {
          const double a = (x[0] - 0.3 - 2e-4 * k) / x[2];
          const double b = (x[1] + 0.2 - 2e-4 * k) / x[2];
          sum -= 0.5 * (a * a + b * b) + 2.0 * std::log(x[2]);
        }
        return sum;
      }),
      tmcmc::BoxPrior(Eigen::Vector3d(-1.0, -1.0, 1e-4), Eigen::Vector3d(1.0, 1.0, 0.1))};
  CHECK(alarms(precise, 5200, 100, 40) >= 36);
  CHECK(alarms(precise, 31000, 100, 40) >= 36);
}
