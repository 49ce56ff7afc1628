// Resampling: counts of each scheme and their spread, order and weights of zero.

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "tmcmc/detail/resample.hpp"
#include "tmcmc/statistics.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using tmcmc::Index;
using tmcmc::Resampling;

constexpr std::array schemes = {Resampling::multinomial, Resampling::residual, Resampling::stratified,
                                Resampling::systematic};

std::vector<Index> ancestors_of(const std::vector<double>& weights, std::size_t n, std::uint64_t seed,
                                std::uint32_t stage = 1, Resampling scheme = Resampling::multinomial) {
  std::vector<Index> ancestors(n, -1);
  tmcmc::resample(scheme, weights, {.seed = seed}, stage, ancestors);
  return ancestors;
}

std::vector<double> counts_of(const std::vector<Index>& ancestors, std::size_t n) {
  std::vector<double> counts(n, 0.0);
  for (const Index a : ancestors) {
    counts.at(static_cast<std::size_t>(a)) += 1.0;
  }
  return counts;
}

}  // namespace

TEST_CASE("ancestors come sorted and in range", "[tmcmc][resampling]") {
  statistics::Uniforms uniform(1);
  for (const std::size_t n : {1U, 2U, 3U, 4U, 5U, 64U, 1001U}) {
    CAPTURE(n);
    std::vector<double> weights(n);
    for (double& w : weights) {
      w = -std::log(uniform());
    }
    for (const Resampling scheme : schemes) {
      CAPTURE(static_cast<int>(scheme));
      for (const std::size_t wanted : {n, std::size_t{1}, n + 7}) {
        const auto ancestors = ancestors_of(weights, wanted, n, 1, scheme);
        CHECK(std::is_sorted(ancestors.begin(), ancestors.end()));
        CHECK(ancestors.front() >= 0);
        CHECK(ancestors.back() < static_cast<Index>(n));
      }
    }
  }
}

TEST_CASE("counts are multinomial: chi-squared with the right mean and variance", "[tmcmc][resampling]") {
  std::vector<double> weights(20);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] = 1.0 + static_cast<double>((7 * i) % 20);  // not normalised, not monotone
  }
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  constexpr std::size_t draws = 1000;
  std::vector<double> chi_squared;
  std::vector<double> sums(weights.size(), 0.0);
  std::vector<double> first;
  constexpr std::uint64_t repetitions = 400;
  for (std::uint64_t seed = 0; seed < repetitions; ++seed) {
    const auto counts = counts_of(ancestors_of(weights, draws, seed), weights.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const double expected = static_cast<double>(draws) * weights[i] / total;
      sum += (counts[i] - expected) * (counts[i] - expected) / expected;
      sums[i] += counts[i];
    }
    chi_squared.push_back(sum);
  }
  // 19 degrees of freedom: mean 19, and a variance near 38 that systematic resampling would miss by
  // far.
  const auto e = statistics::estimate(chi_squared);
  CHECK(e.errors_from(19.0) < statistics::standard_errors);
  CHECK_THAT(e.standard_deviation * e.standard_deviation, WithinAbs(38.0, 38.0 * 0.4));
  for (std::size_t i = 0; i < weights.size(); ++i) {
    CAPTURE(i);
    const double p = weights[i] / total;
    const double n = static_cast<double>(draws * repetitions);
    CHECK_THAT(sums[i], WithinAbs(n * p, statistics::standard_errors * std::sqrt(n * p * (1.0 - p))));
  }
}

TEST_CASE("a weight of zero is never chosen, at the ends neither", "[tmcmc][resampling]") {
  const std::vector<double> weights{0.0, 0.0, 1.0, 0.0, 2.0, 0.0, 0.0, 0.0, 1e-3, 0.0};
  for (const Resampling scheme : schemes) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
      for (const Index a : ancestors_of(weights, weights.size(), seed, 1, scheme)) {
        if (weights[static_cast<std::size_t>(a)] == 0.0) {
          CAPTURE(static_cast<int>(scheme), seed);
          FAIL("ancestor " << a << " has weight 0");
        }
      }
    }
  }
}

TEST_CASE("the only positive weight is always chosen", "[tmcmc][resampling]") {
  for (const std::size_t place : {0U, 3U, 6U}) {
    for (const double weight : {1.0, 1e-300, 1e300}) {
      std::vector<double> weights(7, 0.0);
      weights[place] = weight;
      for (const Resampling scheme : schemes) {
        CHECK(ancestors_of(weights, 5, place, 1, scheme) == std::vector<Index>(5, static_cast<Index>(place)));
      }
    }
  }
}

TEST_CASE("the number of ancestors need not be that of the weights", "[tmcmc][resampling]") {
  const auto counts = counts_of(ancestors_of({1.0, 3.0}, 40000, 1), 2);
  CHECK_THAT(counts[0], WithinAbs(10000.0, statistics::standard_errors * std::sqrt(7500.0)));
  CHECK(counts[0] + counts[1] == 40000.0);
  CHECK(ancestors_of(std::vector<double>(1000, 1.0), 1, 1).size() == 1);
}

TEST_CASE("the ancestors depend on seed and stage, not on the work space", "[tmcmc][resampling]") {
  std::vector<double> weights(100, 1.0);
  weights[3] = 2.5;
  tmcmc::detail::ResamplingWorkspace work;
  for (const Resampling scheme : schemes) {
    CAPTURE(static_cast<int>(scheme));
    const auto ancestors = ancestors_of(weights, 90, 1, 1, scheme);
    CHECK(ancestors_of(weights, 90, 1, 1, scheme) == ancestors);
    CHECK(ancestors_of(weights, 90, 1, 2, scheme) != ancestors);
    CHECK(ancestors_of(weights, 90, 2, 1, scheme) != ancestors);
    work.partial_sums.assign(3, -1.0);
    work.residuals.assign(200, -1.0);
    work.drawn.assign(500, 1);
    std::vector<Index> again(90);
    tmcmc::detail::resample(scheme, weights, {.seed = 1}, 1, again, work);
    CHECK(again == ancestors);
  }
}

TEST_CASE("every scheme gives each sample its expected number of copies, with its own spread",
          "[tmcmc][resampling]") {
  const std::vector<double> weights{0.3, 5.0, 1.2, 0.05, 2.2, 0.9, 3.1};
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  constexpr std::size_t draws = 23;  // not the number of weights
  constexpr std::uint64_t repetitions = 20000;
  std::vector<std::vector<double>> variances;
  for (const Resampling scheme : schemes) {
    CAPTURE(static_cast<int>(scheme));
    std::vector<std::vector<double>> counts(weights.size());
    double furthest = 0.0;
    double least = 0.0;
    for (std::uint64_t seed = 0; seed < repetitions; ++seed) {
      const auto of_seed = counts_of(ancestors_of(weights, draws, seed, 1, scheme), weights.size());
      for (std::size_t i = 0; i < weights.size(); ++i) {
        const double expected = static_cast<double>(draws) * weights[i] / total;
        counts[i].push_back(of_seed[i]);
        furthest = std::max(furthest, std::fabs(of_seed[i] - expected));
        least = std::min(least, of_seed[i] - std::floor(expected));
      }
    }
    variances.emplace_back();
    for (std::size_t i = 0; i < weights.size(); ++i) {
      CAPTURE(i);
      const double expected = static_cast<double>(draws) * weights[i] / total;
      const auto e = statistics::estimate(counts[i]);
      CHECK(e.errors_from(expected) < statistics::standard_errors);
      variances.back().push_back(e.standard_deviation * e.standard_deviation);
    }
    // Whole copies are certain but for multinomial; the cumulative weights of stratified cut two
    // strata.
    CHECK((scheme == Resampling::systematic) == (furthest < 1.0));
    CHECK((scheme == Resampling::stratified || scheme == Resampling::systematic) == (furthest < 2.0));
    CHECK((scheme == Resampling::residual || scheme == Resampling::systematic) == (least == 0.0));
  }
  // Variance of the counts: n p (1 - p); the same of the rest alone; f (1 - f) with the fraction f
  // of the expected number.
  const double rest = [&] {
    double copies = 0.0;
    for (const double w : weights) {
      copies += std::floor(static_cast<double>(draws) * w / total);
    }
    return static_cast<double>(draws) - copies;
  }();
  const double error = 6.0 / std::sqrt(static_cast<double>(repetitions));  // relative; kurtosis up to 10
  for (std::size_t i = 0; i < weights.size(); ++i) {
    CAPTURE(i);
    const double p = weights[i] / total;
    const double expected = static_cast<double>(draws) * p;
    const double fraction = expected - std::floor(expected);
    const double of_rest = fraction * (1.0 - fraction / rest);
    CHECK_THAT(variances[0][i], WithinAbs(expected * (1.0 - p), error * expected * (1.0 - p)));
    CHECK_THAT(variances[1][i], WithinAbs(of_rest, 2.0 * error * of_rest));
    CHECK(variances[2][i] <= variances[0][i]);
    CHECK_THAT(variances[3][i],
               WithinAbs(fraction * (1.0 - fraction), 2.0 * error * fraction * (1.0 - fraction) + 1e-12));
  }
}

TEST_CASE("the largest and the smallest of the sorted uniforms have their beta distributions",
          "[tmcmc][resampling]") {
  // With very many equal weights an ancestor is a uniform number; of n the first is at most x with
  // probability 1 - (1 - x)^n.
  const std::size_t n = 5;
  const std::vector<double> weights(100000, 1.0);
  std::vector<double> first;
  std::vector<double> last;
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    const auto ancestors = ancestors_of(weights, n, seed);
    first.push_back((static_cast<double>(ancestors.front()) + 0.5) / 1e5);
    last.push_back((static_cast<double>(ancestors.back()) + 0.5) / 1e5);
  }
  CHECK(statistics::kolmogorov(first, [](double x) { return 1.0 - std::pow(1.0 - x, 5); }) <
        statistics::kolmogorov_bound);
  CHECK(statistics::kolmogorov(last, [](double x) { return std::pow(x, 5); }) < statistics::kolmogorov_bound);
}
