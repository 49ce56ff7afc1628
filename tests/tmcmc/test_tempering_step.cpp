// Choice of the tempering step: closed forms, the identity of the two criteria, extreme scales and
// edges.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tmcmc/parallel.hpp"
#include "tmcmc/statistics.hpp"
#include "tmcmc/tempering_step.hpp"

namespace {

using Catch::Matchers::Contains;
using Catch::Matchers::WithinRel;
using tmcmc::choose_step;
using tmcmc::Counted;
using tmcmc::Criterion;
using tmcmc::Deviation;
using tmcmc::TemperingStatus;
using tmcmc::TemperingStep;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double criterion_tolerance = 1e-10;  // of N_eff / N and of CoV, relative
constexpr double step_tolerance = 1e-9;        // relative
constexpr double closed_form_tolerance = 1e-12;
constexpr int most_evaluations = 25;

using Values = std::vector<double>;

/// n log-likelihoods whose standard deviation is of the order of the scale, skewed to the left.
Values skewed(std::size_t n, double scale, std::uint64_t seed) {
  statistics::Uniforms uniform(seed);
  Values values(n);
  for (double& value : values) {
    const double z = uniform.normal();
    value = -scale * z * z;
  }
  return values;
}

Values symmetric(std::size_t n, double scale, std::uint64_t seed) {
  statistics::Uniforms uniform(seed);
  Values values(n);
  for (double& value : values) {
    value = scale * uniform.normal();
  }
  return values;
}

Criterion cov_rule(double target, Deviation deviation = Deviation::population,
                   Counted counted = Counted::feasible) {
  return {tmcmc::CoefficientOfVariation{target}, deviation, counted};
}

Criterion ess_rule(double fraction, Counted counted = Counted::feasible) {
  return {tmcmc::EffectiveSampleSize{fraction}, Deviation::population, counted};
}

void check_solved(const TemperingStep& t) {
  CHECK(t.status == TemperingStatus::solved);
  CHECK(t.bracket_low <= t.step);
  CHECK(t.step <= t.bracket_high);
  CHECK(t.bracket_high - t.bracket_low <= step_tolerance * t.step);
  CHECK(t.evaluations >= 3);
  if (t.step > 1e-50) {
    CHECK(t.evaluations <= most_evaluations);
  }
}

}  // namespace

TEST_CASE("the chosen step meets its criterion, at every scale of the log-likelihood",
          "[tmcmc][transition]") {
  for (const double scale : {30.0, 1e4, 1e10, 1e12, 1e100, 1e290}) {
    for (const std::size_t n : {10U, 300U, 1000U}) {
      for (const bool skew : {false, true}) {
        CAPTURE(std::log10(scale), n, skew);
        const Values l = skew ? skewed(n, scale, n) : symmetric(n, scale, n);
        const double samples = static_cast<double>(n);
        for (const double fraction : {0.3, 0.5, 0.9}) {
          CAPTURE(fraction);
          const TemperingStep t = choose_step(l, 1.0, ess_rule(fraction));
          check_solved(t);
          CHECK_THAT(tmcmc::effective_sample_size(l, t.step),
                     WithinRel(fraction * samples, criterion_tolerance));
          CHECK(t.effective_sample_size == tmcmc::effective_sample_size(l, t.step));
        }
        for (const Deviation deviation : {Deviation::population, Deviation::sample}) {
          const TemperingStep t = choose_step(l, 1.0, cov_rule(1.0, deviation));
          check_solved(t);
          CHECK_THAT(tmcmc::coefficient_of_variation(l, t.step, deviation),
                     WithinRel(1.0, criterion_tolerance));
          CHECK(t.coefficient_of_variation == tmcmc::coefficient_of_variation(l, t.step, deviation));
        }
        // The step is of the order of 1/scale: of 1e-10 to 1e-12 where log-likelihoods are 1e10 to
        // 1e12.
        CHECK(choose_step(l, 1.0, cov_rule(1.0)).step * scale > 0.1);
        CHECK(choose_step(l, 1.0, cov_rule(1.0)).step * scale < 50.0);
      }
    }
  }
}

TEST_CASE("CoV = 1 and N_eff = N/2 choose the same step", "[tmcmc][transition]") {
  for (const double scale : {30.0, 1e3, 1e10, 1e12}) {
    for (const std::size_t n : {10U, 300U, 1000U}) {
      CAPTURE(std::log10(scale), n);
      for (const Values& l : {skewed(n, scale, n + 1), symmetric(n, scale, n + 1)}) {
        const double step = choose_step(l, 1.0, cov_rule(1.0)).step;
        CHECK_THAT(choose_step(l, 1.0, ess_rule(0.5)).step, WithinRel(step, step_tolerance));
        // With N - 1 it is N_eff = N / (2 - 1/N), a larger one and a smaller step.
        const TemperingStep sample = choose_step(l, 1.0, cov_rule(1.0, Deviation::sample));
        CHECK_THAT(
            sample.effective_sample_size,
            WithinRel(static_cast<double>(n) / (2.0 - 1.0 / static_cast<double>(n)), criterion_tolerance));
        CHECK(sample.step < step);
      }
    }
  }
}

TEST_CASE("any CoV has its N_eff: target c and 1 / (1 + c^2)", "[tmcmc][transition]") {
  const Values l = skewed(500, 40.0, 2);
  for (const double cov : {0.1, 0.5, 2.0, 5.0}) {
    CAPTURE(cov);
    CHECK_THAT(choose_step(l, 1.0, ess_rule(1.0 / (1.0 + cov * cov))).step,
               WithinRel(choose_step(l, 1.0, cov_rule(cov)).step, step_tolerance));
  }
}

TEST_CASE("two values of the log-likelihood have a step in closed form", "[tmcmc][transition]") {
  for (const int ahead : {1, 2, 5}) {
    for (const double gap : {3.0, 50.0, 1e6, 1e11}) {
      CAPTURE(ahead, gap);
      Values l(12, 17.0 - gap);
      std::fill_n(l.begin() + 4, ahead, 17.0);
      // sqrt(p (1-p)) (1 - a) = p + (1-p) a with a = exp(-step gap)
      const double p = ahead / 12.0;
      const double q = std::sqrt(p * (1.0 - p));
      const double expected = -std::log((q - p) / (q + 1.0 - p)) / gap;
      if (expected >= 1.0) {
        continue;
      }
      const double exactness = closed_form_tolerance + 1e-15 * gap;  // 17 - gap is rounded
      CHECK_THAT(choose_step(l, 1.0, cov_rule(1.0)).step, WithinRel(expected, std::min(exactness, 1e-9)));
      CHECK_THAT(choose_step(l, 1.0, ess_rule(0.5)).step, WithinRel(expected, std::min(exactness, 1e-9)));
    }
  }
}

TEST_CASE("the remaining step is taken whole if it keeps the criterion", "[tmcmc][transition]") {
  const Values l = skewed(300, 10.0, 4);
  const double root = choose_step(l, 1.0, cov_rule(1.0)).step;
  for (const Criterion& rule : {cov_rule(1.0), ess_rule(0.5)}) {
    const TemperingStep before = choose_step(l, 0.999 * root, rule);
    CHECK(before.status == TemperingStatus::final_step);
    CHECK(before.step == 0.999 * root);
    CHECK(before.effective_sample_size > 150.0);
    CHECK(before.coefficient_of_variation < 1.0);
    const TemperingStep beyond = choose_step(l, 1.001 * root, rule);
    CHECK(beyond.status == TemperingStatus::solved);
    CHECK_THAT(beyond.step, WithinRel(root, step_tolerance));
  }
}

TEST_CASE("a step that solves a remainder is the same for every remainder", "[tmcmc][transition]") {
  const Values l = skewed(300, 1e8, 5);
  const double root = choose_step(l, 1.0, ess_rule(0.5)).step;
  for (const double remaining : {0.7, 1e-3, 1e-6}) {
    CAPTURE(remaining);
    const TemperingStep t = choose_step(l, remaining, ess_rule(0.5));
    check_solved(t);
    CHECK_THAT(t.step, WithinRel(root, step_tolerance));
  }
}

TEST_CASE("equal log-likelihoods end at once, under every rule", "[tmcmc][transition]") {
  for (const double level : {0.0, -5.5, 1e300, -1e300}) {
    for (const Criterion& rule :
         {cov_rule(1.0), cov_rule(1.0, Deviation::sample), ess_rule(0.5), ess_rule(1.0)}) {
      const TemperingStep t = choose_step(Values(20, level), 0.6, rule);
      CHECK(t.status == TemperingStatus::final_step);
      CHECK(t.step == 0.6);
      CHECK(t.effective_sample_size == 20.0);
      CHECK(t.coefficient_of_variation == 0.0);
    }
  }
}

TEST_CASE("one feasible sample ends at once if feasible ones are counted", "[tmcmc][transition]") {
  Values l(20, -infinity);
  l[19] = -3.0;
  for (const Criterion& rule : {cov_rule(1.0), cov_rule(1.0, Deviation::sample), ess_rule(0.5)}) {
    const TemperingStep t = choose_step(l, 1.0, rule);
    CHECK(t.status == TemperingStatus::final_step);
    CHECK(t.effective_sample_size == 1.0);
  }
  for (const Criterion& rule :
       {cov_rule(1.0, Deviation::population, Counted::all), cov_rule(1.0, Deviation::sample, Counted::all),
        ess_rule(0.5, Counted::all)}) {
    const TemperingStep t = choose_step(l, 1.0, rule);
    CHECK(t.status == TemperingStatus::unreachable);
    CHECK(t.step == 0.0);
    CHECK(t.effective_sample_size == 0.0);
  }
}

TEST_CASE("no feasible sample is reported as such", "[tmcmc][transition]") {
  for (const Counted counted : {Counted::all, Counted::feasible}) {
    for (const Criterion& rule : {cov_rule(1.0, Deviation::population, counted), ess_rule(0.5, counted)}) {
      const TemperingStep t = choose_step(Values(20, -infinity), 1.0, rule);
      CHECK(t.status == TemperingStatus::infeasible);
      CHECK(t.step == 0.0);
    }
  }
}

TEST_CASE("N_eff = N allows a step of zero alone", "[tmcmc][transition]") {
  const TemperingStep t = choose_step(skewed(50, 1.0, 6), 1.0, ess_rule(1.0));
  CHECK(t.status == TemperingStatus::zero_step);
  CHECK(t.step == 0.0);
}

TEST_CASE("a target next to N is met where N_eff rounds to more than N on the way", "[tmcmc][transition]") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Values values = skewed(30, 1000.0, seed);
    const TemperingStep t = choose_step(values, 1.0, tmcmc::effective_sample_size_rule(1.0 - 1e-12));
    INFO("seed " << seed);
    CHECK(t.status == TemperingStatus::solved);
    CHECK(t.effective_sample_size / 30.0 <= 1.0 + 1e-15);
    CHECK_THAT(t.coefficient_of_variation, WithinRel(1e-6, 1e-3));
  }
}

TEST_CASE("a step below 1e-300 counts as zero, whatever the rule", "[tmcmc][transition]") {
  Values l(100, -1.7e308);
  std::fill(l.begin(), l.begin() + 10, 1.7e308);
  for (const Criterion& rule :
       {ess_rule(0.5, Counted::all), cov_rule(1.0, Deviation::population, Counted::all),
        cov_rule(1.0, Deviation::sample, Counted::feasible)}) {
    CHECK(choose_step(l, 1.0, rule).status == TemperingStatus::zero_step);
  }
  std::fill(l.begin() + 10, l.begin() + 60,
            -infinity);  // half of the samples are feasible: N_eff = N/2 in the limit
  CHECK(choose_step(l, 1.0, ess_rule(0.45, Counted::all)).status == TemperingStatus::zero_step);
  CHECK(choose_step(l, 1.0, ess_rule(0.55, Counted::all)).status == TemperingStatus::unreachable);
  CHECK(choose_step(l, 1.0, cov_rule(1.1, Deviation::sample, Counted::all)).status ==
        TemperingStatus::zero_step);
  CHECK(choose_step(l, 1.0, cov_rule(0.95, Deviation::sample, Counted::all)).status ==
        TemperingStatus::unreachable);
}

TEST_CASE("counting all, too few feasible samples make the criterion unreachable", "[tmcmc][transition]") {
  Values l = skewed(100, 5.0, 7);
  std::fill(l.begin(), l.begin() + 60, -infinity);  // N_eff is at most 40
  for (const Criterion& rule :
       {ess_rule(0.5, Counted::all), cov_rule(1.0, Deviation::population, Counted::all)}) {
    const TemperingStep t = choose_step(l, 1.0, rule);
    CHECK(t.status == TemperingStatus::unreachable);
    CHECK(t.step == 0.0);
    CHECK(t.evaluations < 100);
  }
  const TemperingStep reachable = choose_step(l, 1.0, ess_rule(0.3, Counted::all));
  check_solved(reachable);
  CHECK_THAT(reachable.effective_sample_size, WithinRel(30.0, criterion_tolerance));
}

TEST_CASE("counting the feasible ones, the step is that of the feasible ones alone", "[tmcmc][transition]") {
  const Values feasible = skewed(100, 5.0, 8);
  Values l = feasible;
  l.insert(l.end(), 900, -infinity);
  for (const Criterion& rule : {ess_rule(0.5), cov_rule(1.0), cov_rule(1.0, Deviation::sample)}) {
    const TemperingStep t = choose_step(l, 1.0, rule);
    check_solved(t);
    CHECK_THAT(t.step, WithinRel(choose_step(feasible, 1.0, rule).step, step_tolerance));
  }
  CHECK_THAT(choose_step(l, 1.0, ess_rule(0.5)).effective_sample_size, WithinRel(50.0, criterion_tolerance));
}

TEST_CASE("log-likelihoods with a penalty of -1e10: the first steps remove the penalty",
          "[tmcmc][transition]") {
  Values l = symmetric(1000, 1.0, 9);
  std::fill(l.begin(), l.begin() + 846, -1e10);
  const TemperingStep t = choose_step(l, 1.0, cov_rule(1.0, Deviation::sample, Counted::all));
  check_solved(t);
  CHECK_THAT(t.coefficient_of_variation, WithinRel(1.0, criterion_tolerance));
  CHECK(t.step > 1e-10);
  CHECK(t.step < 2e-10);
}

TEST_CASE("steps are resolved down to 1e-300", "[tmcmc][transition]") {
  const double q = std::sqrt(3.0) / 4.0;  // the closed form above with p = 1/4
  const double scaled_step = -std::log((q - 0.25) / (q + 0.75));
  for (const Criterion& rule : {cov_rule(1.0), ess_rule(0.5)}) {
    for (const double level : {1e299, 1e300}) {
      Values l(12, -level);
      std::fill_n(l.begin(), 3, level);
      const TemperingStep t = choose_step(l, 1.0, rule);
      if (scaled_step / (2.0 * level) > 1e-300) {
        CHECK(t.status == TemperingStatus::solved);
        CHECK_THAT(t.step, WithinRel(scaled_step / (2.0 * level), step_tolerance));
      } else {
        CHECK(t.status == TemperingStatus::zero_step);
        CHECK(t.step == 0.0);
      }
    }
  }
}

TEST_CASE("two samples never exceed CoV = 1", "[tmcmc][transition]") {
  const Values l{0.0, -1e6};
  for (const Criterion& rule : {cov_rule(1.0), ess_rule(0.5)}) {
    const TemperingStep t = choose_step(l, 1.0, rule);
    CHECK(t.status == TemperingStatus::final_step);
    CHECK(t.effective_sample_size == 1.0);
  }
  // With N - 1: sqrt(2) tanh(step gap / 2) = 1.
  const TemperingStep sample = choose_step(l, 1.0, cov_rule(1.0, Deviation::sample));
  check_solved(sample);
  CHECK_THAT(sample.step, WithinRel(2.0 * std::atanh(std::sqrt(0.5)) / 1e6, closed_form_tolerance));
  const TemperingStep ess = choose_step(l, 1.0, ess_rule(0.75));  // tanh^2 = 1/3
  check_solved(ess);
  CHECK_THAT(ess.step, WithinRel(2.0 * std::atanh(std::sqrt(1.0 / 3.0)) / 1e6, closed_form_tolerance));
}

TEST_CASE("a constant added to the log-likelihood leaves the step as it is", "[tmcmc][transition]") {
  Values l = skewed(1000, 20.0, 10);
  for (double& value : l) {
    value = std::round(value * 0x1p20) * 0x1p-20;  // so that the sums below are exact
  }
  for (const double constant : {1000.0, -12345.0}) {
    Values shifted = l;
    for (double& value : shifted) {
      value += constant;
    }
    for (const Criterion& rule : {cov_rule(1.0), ess_rule(0.5)}) {
      CHECK(choose_step(shifted, 1.0, rule).step == choose_step(l, 1.0, rule).step);
    }
  }
}

TEST_CASE("the order of the samples leaves the step as it is but for rounding", "[tmcmc][transition]") {
  Values l = skewed(301, 20.0, 11);
  const double step = choose_step(l, 1.0, ess_rule(0.5)).step;
  std::reverse(l.begin(), l.end());
  CHECK_THAT(choose_step(l, 1.0, ess_rule(0.5)).step, WithinRel(step, step_tolerance));
}

TEST_CASE("the threads leave a step over many blocks as it is, and the whole is what its halves give",
          "[tmcmc][transition]") {
  Values l = skewed(3 * tmcmc::reduction_rows + 17, 20.0, 12);
  l[5] = -infinity;
  for (const auto& rule : {cov_rule(1.0), ess_rule(0.5)}) {
    const TemperingStep one = choose_step(l, 1.0, rule);
    CHECK(one.status == TemperingStatus::solved);
    for (const int threads : {2, 3}) {
      const TemperingStep many = choose_step(l, 1.0, rule, threads);
      CHECK(many.step == one.step);
      CHECK(many.effective_sample_size == one.effective_sample_size);
      CHECK(many.coefficient_of_variation == one.coefficient_of_variation);
      CHECK(many.evaluations == one.evaluations);
    }
    Values twice = l;
    twice.insert(twice.end(), l.begin(), l.end());
    CHECK_THAT(choose_step(twice, 1.0, rule).step, WithinRel(one.step, step_tolerance));
  }
}

TEST_CASE("the rules of the paper", "[tmcmc][transition]") {
  CHECK(std::get<tmcmc::CoefficientOfVariation>(tmcmc::coefficient_of_variation_rule().rule).target == 1.0);
  CHECK(std::get<tmcmc::EffectiveSampleSize>(tmcmc::effective_sample_size_rule().rule).fraction == 0.5);
}
