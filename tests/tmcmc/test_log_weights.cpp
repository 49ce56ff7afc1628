// Weights of a tempering step: identities between the measures, closed forms, shifts and edges.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "tmcmc/log_weights.hpp"
#include "tmcmc/parallel.hpp"
#include "tmcmc/statistics.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using tmcmc::coefficient_of_variation;
using tmcmc::Counted;
using tmcmc::Deviation;
using tmcmc::effective_sample_size;
using tmcmc::log_mean_weight;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-13;  // relative

using Values = std::vector<double>;

enum class Shape { normal, exponential, one_far_ahead, two_levels };

Values random_log_likelihoods(Shape shape, std::size_t n, double scale, std::uint64_t seed) {
  statistics::Uniforms uniform(seed);
  Values values(n);
  for (double& value : values) {
    const double u = uniform();
    switch (shape) {
      case Shape::normal:
        value = scale * uniform.normal();
        break;
      case Shape::exponential:
        value = scale * std::log(u);
        break;
      case Shape::one_far_ahead:
        value = scale * u;
        break;
      case Shape::two_levels:
        value = u < 0.2 ? 0.0 : -scale;
        break;
    }
  }
  if (shape == Shape::one_far_ahead) {
    values[n / 3] = 10.0 * scale;
  }
  return values;
}

/// Every shape, at several spreads and sizes.
template <class Check>
void for_random_weights(Check check) {
  for (const Shape shape : {Shape::normal, Shape::exponential, Shape::one_far_ahead, Shape::two_levels}) {
    for (const double scale : {1e-3, 1.0, 30.0, 1e4}) {
      for (const std::size_t n : {5U, 8U, 64U, 1001U}) {
        CAPTURE(static_cast<int>(shape), scale, n);
        check(random_log_likelihoods(shape, n, scale, n));
      }
    }
  }
}

struct Exact {
  long double sum = 0.0L;
  long double sum_of_squares = 0.0L;
  long double squared_deviations = 0.0L;
  long double largest = -std::numeric_limits<long double>::infinity();
};

Exact exact_moments(const Values& log_likelihood, double step) {
  Exact e;
  for (const double value : log_likelihood) {
    e.largest = std::max(e.largest, static_cast<long double>(value));
  }
  for (const double value : log_likelihood) {
    const long double w = std::exp(static_cast<long double>(step) * (value - e.largest));
    e.sum += w;
    e.sum_of_squares += w * w;
  }
  for (const double value : log_likelihood) {
    const long double w = std::exp(static_cast<long double>(step) * (value - e.largest));
    const long double deviation = w - e.sum / static_cast<long double>(log_likelihood.size());
    e.squared_deviations += deviation * deviation;
  }
  return e;
}

}  // namespace

TEST_CASE("N_eff = N / (1 + CoV^2) with the population deviation", "[tmcmc][log_weights]") {
  for_random_weights([](const Values& l) {
    for (const double step : {1e-4, 0.01, 0.3, 1.0}) {
      CAPTURE(step);
      const double n = static_cast<double>(l.size());
      const double cov = coefficient_of_variation(l, step);
      CHECK_THAT(effective_sample_size(l, step), WithinRel(n / (1.0 + cov * cov), rounding));
    }
  });
}

TEST_CASE("with the N - 1 deviation CoV^2 grows by N / (N - 1)", "[tmcmc][log_weights]") {
  for_random_weights([](const Values& l) {
    const double n = static_cast<double>(l.size());
    CHECK_THAT(coefficient_of_variation(l, 0.3, Deviation::sample),
               WithinRel(coefficient_of_variation(l, 0.3) * std::sqrt(n / (n - 1.0)), rounding));
  });
}

TEST_CASE("N_eff, CoV and log-mean weight against long double", "[tmcmc][log_weights]") {
  for_random_weights([](const Values& l) {
    for (const double step : {1e-4, 0.01, 1.0}) {
      CAPTURE(step);
      const Exact e = exact_moments(l, step);
      const auto n = static_cast<long double>(l.size());
      // A weight errs by the rounding of its exponent, at most 746 where it is not 0.
      const double tolerance = 746.0 * std::numeric_limits<double>::epsilon();
      CHECK_THAT(effective_sample_size(l, step),
                 WithinRel(static_cast<double>(e.sum * e.sum / e.sum_of_squares), tolerance));
      // Weights near 1 err by half a unit, which a small CoV shows as an absolute error.
      CHECK_THAT(
          coefficient_of_variation(l, step),
          WithinRel(static_cast<double>(std::sqrt(e.squared_deviations / n) / (e.sum / n)), tolerance) ||
              WithinAbs(static_cast<double>(std::sqrt(e.squared_deviations / n) / (e.sum / n)),
                        2.0 * std::numeric_limits<double>::epsilon()));
      const double log_mean = static_cast<double>(step * e.largest + std::log(e.sum / n));
      CHECK_THAT(log_mean_weight(l, step), WithinAbs(log_mean, tolerance + 1e-15 * std::fabs(log_mean)));
    }
  });
}

TEST_CASE("two values of the log-likelihood have closed forms", "[tmcmc][log_weights]") {
  for (const int ahead : {1, 3, 7}) {
    for (const double gap : {0.5, 4.0, 200.0}) {
      CAPTURE(ahead, gap);
      Values l(12, -gap);
      std::fill_n(l.begin() + 2, ahead, 0.0);
      const double p = ahead / 12.0;
      const double a = std::exp(-0.25 * gap);
      const double mean = p + (1.0 - p) * a;
      CHECK_THAT(coefficient_of_variation(l, 0.25),
                 WithinRel(std::sqrt(p * (1.0 - p)) * (1.0 - a) / mean, rounding));
      CHECK_THAT(effective_sample_size(l, 0.25),
                 WithinRel(12.0 * mean * mean / (p + (1.0 - p) * a * a), rounding));
      CHECK_THAT(log_mean_weight(l, 0.25), WithinRel(std::log(mean), rounding));

      Values weights(l.size());
      const double sum = tmcmc::relative_weights(l, 0.25, weights).sum;
      CHECK_THAT(sum, WithinRel(12.0 * mean, rounding));
      CHECK(weights[2] == 1.0);
      CHECK_THAT(weights[0], WithinRel(a, rounding));
    }
  }
}

TEST_CASE("a constant added to the log-likelihood changes no bit but the log-mean weight",
          "[tmcmc][log_weights]") {
  Values l = random_log_likelihoods(Shape::exponential, 1000, 3.0, 7);
  for (double& value : l) {
    value = std::round(value * 0x1p20) * 0x1p-20;  // so that the sums below are exact
  }
  for (const double constant : {1000.0, -12345.0, 0x1p25}) {
    CAPTURE(constant);
    Values shifted = l;
    for (double& value : shifted) {
      value += constant;
    }
    for (const double step : {1e-3, 0.2, 1.0}) {
      CAPTURE(step);
      CHECK(effective_sample_size(shifted, step) == effective_sample_size(l, step));
      CHECK(coefficient_of_variation(shifted, step) == coefficient_of_variation(l, step));
      CHECK_THAT(log_mean_weight(shifted, step) - log_mean_weight(l, step),
                 WithinAbs(step * constant, 4e-16 * std::fabs(step * constant)));
      Values weights(l.size());
      Values shifted_weights(l.size());
      CHECK(tmcmc::relative_weights(shifted, step, shifted_weights).sum ==
            tmcmc::relative_weights(l, step, weights).sum);
      CHECK(shifted_weights == weights);
    }
  }
}

TEST_CASE("equal log-likelihoods have equal weights", "[tmcmc][log_weights]") {
  for (const double level : {0.0, -3.7, 1e300, -1e300}) {
    CAPTURE(level);
    const Values l(77, level);
    CHECK(effective_sample_size(l, 0.5) == 77.0);
    CHECK(coefficient_of_variation(l, 0.5) == 0.0);
    CHECK(coefficient_of_variation(l, 0.5, Deviation::sample) == 0.0);
    CHECK_THAT(log_mean_weight(l, 0.5), WithinRel(0.5 * level, rounding));
  }
}

TEST_CASE("all but one infeasible: one weight", "[tmcmc][log_weights]") {
  for (const std::size_t place : {0U, 4U, 10U}) {
    Values l(11, -infinity);
    l[place] = -8.0;
    CHECK(tmcmc::count_feasible(l) == 1);
    CHECK(effective_sample_size(l, 0.5) == 1.0);
    CHECK_THAT(coefficient_of_variation(l, 0.5), WithinRel(std::sqrt(10.0), rounding));
    CHECK_THAT(coefficient_of_variation(l, 0.5, Deviation::sample), WithinRel(std::sqrt(11.0), rounding));
    CHECK(coefficient_of_variation(l, 0.5, Deviation::population, Counted::feasible) == 0.0);
    CHECK(std::isnan(coefficient_of_variation(l, 0.5, Deviation::sample, Counted::feasible)));
    CHECK_THAT(log_mean_weight(l, 0.5), WithinRel(-4.0 - std::log(11.0), rounding));
    Values weights(11);
    CHECK(tmcmc::relative_weights(l, 0.5, weights).sum == 1.0);
    CHECK(weights[place] == 1.0);
    CHECK(std::count(weights.begin(), weights.end(), 0.0) == 10);
  }
}

TEST_CASE("all infeasible: no weight", "[tmcmc][log_weights]") {
  const Values l(9, -infinity);
  CHECK(tmcmc::count_feasible(l) == 0);
  CHECK(effective_sample_size(l, 0.5) == 0.0);
  CHECK(std::isnan(coefficient_of_variation(l, 0.5)));
  CHECK(std::isnan(coefficient_of_variation(l, 0.5, Deviation::population, Counted::feasible)));
  CHECK(log_mean_weight(l, 0.5) == -infinity);
  Values weights(l.size(), 1.0);
  const auto sums = tmcmc::relative_weights(l, 0.5, weights);
  CHECK(sums.sum == 0.0);
  CHECK(sums.log_mean == -infinity);
  CHECK(weights == Values(l.size(), 0.0));
}

TEST_CASE("one object gives every step the same bits as a call of its own", "[tmcmc][log_weights]") {
  Values l = random_log_likelihoods(Shape::exponential, 101, 5.0, 9);
  l[7] = -infinity;
  const tmcmc::WeightStatistics statistics(l);
  CHECK(statistics.feasible() == 100);
  for (const double step : {0.1, 1.0, 0.01}) {
    CAPTURE(step);
    CHECK(statistics.effective_sample_size(step) == effective_sample_size(l, step));
    for (const Counted counted : {Counted::all, Counted::feasible}) {
      CHECK(statistics.coefficient_of_variation(step, Deviation::sample, counted) ==
            coefficient_of_variation(l, step, Deviation::sample, counted));
    }
  }
}

TEST_CASE("over many blocks the measures agree with long double, bit for bit on any number of threads",
          "[tmcmc][log_weights]") {
  constexpr auto block = static_cast<std::size_t>(tmcmc::reduction_rows);
  for (const std::size_t n : {block, block + 1, 5 * block - 1}) {
    for (const double step : {1e-9, 0.3}) {  // weights that differ in the ninth digit, and by decades
      CAPTURE(n, step);
      const Values feasible = random_log_likelihoods(Shape::exponential, n, 5.0, n);
      Values l = feasible;
      l.insert(l.begin() + 1000, 2 * block, -infinity);  // a block without a feasible sample
      const Exact e = exact_moments(feasible, step);
      const auto count = static_cast<long double>(n);
      const double cov = static_cast<double>(std::sqrt(e.squared_deviations / count) / (e.sum / count));
      const tmcmc::WeightStatistics statistics(l);
      CHECK(statistics.feasible() == static_cast<tmcmc::Index>(n));
      // Rounding of a weight near 1, which a CoV of 1e-9 shows.
      CHECK_THAT(statistics.coefficient_of_variation(step, Deviation::population, Counted::feasible),
                 WithinRel(cov, 1e-12) || WithinAbs(cov, 2.0 * std::numeric_limits<double>::epsilon()));
      CHECK_THAT(statistics.effective_sample_size(step),
                 WithinRel(static_cast<double>(e.sum * e.sum / e.sum_of_squares), 1e-12));
      Values weights(l.size());
      const auto sums = tmcmc::relative_weights(l, step, weights);
      CHECK_THAT(sums.sum, WithinRel(static_cast<double>(e.sum), 1e-12));
      for (const int threads : {2, 3}) {
        const tmcmc::WeightStatistics again(l, threads);
        CHECK(again.effective_sample_size(step) == statistics.effective_sample_size(step));
        CHECK(again.log_likelihood_spread() == statistics.log_likelihood_spread());
        for (const Counted counted : {Counted::all, Counted::feasible}) {
          CHECK(again.coefficient_of_variation(step, Deviation::sample, counted) ==
                statistics.coefficient_of_variation(step, Deviation::sample, counted));
        }
        Values same(l.size());
        CHECK(tmcmc::relative_weights(l, step, same, threads).sum == sums.sum);
        CHECK(same == weights);
      }
    }
  }
}

TEST_CASE("the spread of the log-likelihoods is their standard deviation over the feasible samples",
          "[tmcmc][log_weights]") {
  for (const std::size_t n : {101U, 10001U}) {
    Values l = random_log_likelihoods(Shape::normal, n, 3.0, n);
    l[0] = -infinity;
    long double mean = 0.0L;
    for (std::size_t i = 1; i < n; ++i) {
      mean += l[i] / static_cast<long double>(n - 1);
    }
    long double variance = 0.0L;
    for (std::size_t i = 1; i < n; ++i) {
      variance += (l[i] - mean) * (l[i] - mean) / static_cast<long double>(n - 1);
    }
    CHECK_THAT(tmcmc::WeightStatistics(l).log_likelihood_spread(),
               WithinRel(static_cast<double>(std::sqrt(variance)), 1e-12));
  }
  CHECK(tmcmc::WeightStatistics(Values(9, -3.0)).log_likelihood_spread() == 0.0);
}
