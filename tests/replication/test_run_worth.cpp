// What a run is worth, and whether its iterations say so.

#include <catch2/catch.hpp>
#include <cmath>

#include "errors/invalid_value.hpp"
#include "replication/run_worth.hpp"

using namespace replication;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

StudySummary study(double mean, double spread,
                   const std::map<tmcmc::Index, tmcmc::Index>& iterations = {{10, 50}}) {
  StudySummary s;
  s.means = {mean};
  s.standard_errors = {spread};
  s.iterations = iterations;
  return s;
}

}  // namespace

TEST_CASE("a run is worth as many draws as have the error of its mean", "[run_worth]") {
  // two runs a study: mean-square errors 0.5 * 0.2^2 + 0.1^2 and 0.5 * 0.4^2
  const std::vector<StudySummary> studies = {study(1.1, 0.2), study(1.0, 0.4)};
  const auto worth = independent_draws_worth(studies, 2, 0, 1.0, 0.5);
  CHECK_THAT(worth.value, WithinRel(0.25 / (0.5 * (0.03 + 0.08)), 1e-13));
  // standard error of the mean of 0.03 and 0.08 is 0.025
  CHECK_THAT(worth.standard_error, WithinRel(worth.value * 0.025 / 0.055, 1e-12));
  CHECK_THROWS_AS(independent_draws_worth(studies, 1, 0, 1.0, 0.5), errors::InvalidValue);
  CHECK_THROWS_AS(independent_draws_worth({studies[0]}, 2, 0, 1.0, 0.5), errors::InvalidValue);
}

TEST_CASE("rank correlation with ties, in closed form", "[run_worth]") {
  CHECK_THAT(rank_correlation(std::vector<double>{1, 2, 3, 4}, std::vector<double>{10, 20, 30, 40}).rho,
             WithinAbs(1.0, 1e-14));
  CHECK_THAT(rank_correlation(std::vector<double>{1, 2, 3}, std::vector<double>{9, 5, 1}).rho,
             WithinAbs(-1.0, 1e-14));
  // without ties: 1 - 6 sum d^2/(n(n^2 - 1)); d = 1, 1, 0, 1, 1
  const auto plain = rank_correlation(std::vector<double>{1, 2, 3, 4, 5}, std::vector<double>{2, 1, 3, 5, 4});
  CHECK_THAT(plain.rho, WithinRel(1.0 - 6.0 * 4.0 / 120.0, 1e-13));
  // ranks 1.5, 1.5, 3 against 1, 2, 3: covariance 0.75, variances 0.75 and 1
  const auto tied = rank_correlation(std::vector<double>{7, 7, 8}, std::vector<double>{1, 2, 3});
  CHECK_THAT(tied.rho, WithinRel(0.75 / std::sqrt(0.75), 1e-13));
  // Student's t with one degree of freedom: p = 1 - 2 atan(t)/pi
  const double t = tied.rho * std::sqrt(1.0 / (1.0 - tied.rho * tied.rho));
  CHECK_THAT(tied.p, WithinRel(1.0 - 2.0 * std::atan(t) / std::acos(-1.0), 1e-10));
  CHECK_THROWS_AS(rank_correlation(std::vector<double>{1, 2}, std::vector<double>{1, 2}),
                  errors::InvalidValue);
  CHECK(std::isnan(rank_correlation(std::vector<double>{1, 1, 1}, std::vector<double>{1, 2, 3}).p));
}

TEST_CASE("iterations: their difference, and a study without long runs", "[run_worth]") {
  const std::vector<StudySummary> first = {study(0, 0, {{10, 50}}), study(0, 0, {{9, 25}, {11, 25}})};
  const std::vector<StudySummary> second = {study(0, 0, {{11, 50}}), study(0, 0, {{10, 50}})};
  const auto d = difference_of_iterations(first, second);
  CHECK_THAT(d.value, WithinAbs(0.5, 1e-14));
  CHECK_THAT(d.standard_error, WithinRel(0.5, 1e-13));
  // a quarter of the 100 runs of the first take 11: none of 2 with probability 9/16
  const auto p = probability_of_none(first, 11, 2);
  CHECK_THAT(p.value, WithinRel(9.0 / 16.0, 1e-13));
  CHECK_THAT(p.standard_error, WithinRel(2.0 * 0.75 * std::sqrt(0.25 * 0.75 / 100.0), 1e-12));
  CHECK(probability_of_none(first, 12, 5).value == 1.0);
  CHECK(probability_of_none(first, 9, 5).value == 0.0);
  CHECK_THROWS_AS(probability_of_none({}, 9, 5), errors::InvalidValue);
}
