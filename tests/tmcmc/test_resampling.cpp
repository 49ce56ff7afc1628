// Multinomial resampling: counts, order and weights of zero.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <vector>

#include "tmcmc/resampling.hpp"
#include "tmcmc/statistics.hpp"

namespace {

using Catch::Matchers::WithinAbs;
using tmcmc::Index;

std::vector<Index> ancestors_of(const std::vector<double>& weights, std::size_t n, std::uint64_t seed,
                                std::uint32_t stage = 1) {
  std::vector<Index> ancestors(n, -1);
  tmcmc::resample(tmcmc::Resampling::multinomial, weights, {.seed = seed}, stage, ancestors);
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
    const auto ancestors = ancestors_of(weights, n, n);
    CHECK(std::is_sorted(ancestors.begin(), ancestors.end()));
    CHECK(ancestors.front() >= 0);
    CHECK(ancestors.back() < static_cast<Index>(n));
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
  // 19 degrees of freedom: mean 19, and a variance near 38 that systematic resampling would miss by far.
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
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    for (const Index a : ancestors_of(weights, weights.size(), seed)) {
      if (weights[static_cast<std::size_t>(a)] == 0.0) {
        CAPTURE(seed);
        FAIL("ancestor " << a << " has weight 0");
      }
    }
  }
}

TEST_CASE("the only positive weight is always chosen", "[tmcmc][resampling]") {
  for (const std::size_t place : {0U, 3U, 6U}) {
    for (const double weight : {1.0, 1e-300, 1e300}) {
      std::vector<double> weights(7, 0.0);
      weights[place] = weight;
      CHECK(ancestors_of(weights, 7, place) == std::vector<Index>(7, static_cast<Index>(place)));
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
  const std::vector<double> weights(100, 1.0);
  const auto ancestors = ancestors_of(weights, 100, 1, 1);
  CHECK(ancestors_of(weights, 100, 1, 1) == ancestors);
  CHECK(ancestors_of(weights, 100, 1, 2) != ancestors);
  CHECK(ancestors_of(weights, 100, 2, 1) != ancestors);
  tmcmc::ResamplingWorkspace work;
  work.partial_sums.assign(3, -1.0);
  std::vector<Index> again(100);
  tmcmc::resample(tmcmc::Resampling::multinomial, weights, {.seed = 1}, 1, again, work);
  CHECK(again == ancestors);
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
