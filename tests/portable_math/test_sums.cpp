// Sums: the value against long double, the order against its definition.

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "portable_math/sums.hpp"

namespace {

using Catch::Matchers::WithinAbs;

const std::vector<std::size_t> lengths{0, 1, 2, 7, 8, 9, 15, 16, 17, 63, 64, 65, 1000};

/// Terms of both signs and of sizes from 1e-12 to 1e12, so that the order of the additions shows.
std::vector<double> random_terms(std::size_t n) {
  std::mt19937_64 generator(n + 1);
  std::vector<double> terms(n);
  for (double& term : terms) {
    const double u = static_cast<double>(generator() >> 11U) * 0x1p-53 - 0.5;
    term = std::ldexp(u, static_cast<int>(generator() % 80U) - 40);
  }
  return terms;
}

double sum(const std::vector<double>& terms) {
  return portable_math::sum_of(terms.size(), [&](std::size_t i) { return terms[i]; });
}

}  // namespace

TEST_CASE("a sum is the long double sum to within n roundings", "[portable_math]") {
  for (const std::size_t n : lengths) {
    CAPTURE(n);
    const auto terms = random_terms(n);
    long double exact = 0.0L;
    long double size = 0.0L;
    for (const double term : terms) {
      exact += term;
      size += std::fabs(term);
    }
    const double tolerance = static_cast<double>(n) * std::numeric_limits<double>::epsilon();
    CHECK_THAT(sum(terms), WithinAbs(static_cast<double>(exact), tolerance * static_cast<double>(size)));
  }
}

TEST_CASE("the order of a sum is eight interleaved lanes, then pairs four, two and one apart",
          "[portable_math]") {
  for (const std::size_t n : lengths) {
    CAPTURE(n);
    const auto terms = random_terms(n);
    std::vector<double> lanes(8, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      lanes[i % 8] += terms[i];
    }
    for (const std::size_t distance : {4U, 2U, 1U}) {
      for (std::size_t lane = 0; lane < distance; ++lane) {
        lanes[lane] += lanes[lane + distance];
      }
    }
    CHECK(sum(terms) == lanes[0]);
  }
}

TEST_CASE("every term is taken once", "[portable_math]") {
  for (const std::size_t n : lengths) {
    CAPTURE(n);
    std::vector<int> taken(n, 0);
    const double total = portable_math::sum_of(n, [&](std::size_t i) {
      ++taken.at(i);
      return 1.0;
    });
    CHECK(taken == std::vector<int>(n, 1));
    CHECK(total == static_cast<double>(n));
  }
}

TEST_CASE("NaN and infinity reach the sum", "[portable_math]") {
  std::vector<double> terms(19, 1.0);
  terms[18] = std::numeric_limits<double>::infinity();
  CHECK(sum(terms) == std::numeric_limits<double>::infinity());
  terms[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(sum(terms)));
}
