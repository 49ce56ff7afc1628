// Predictive densities of the printed tables, and how often a setting's own studies are as
// improbable.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "errors/invalid_value.hpp"
#include "replication/predictive.hpp"
#include "replication/published.hpp"
#include "replication/study.hpp"
#include "tmcmc/random.hpp"

using namespace replication;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

/// Studies whose log areas are Normal with correlation 0.6 and whose runs take 10 or 11 iterations
/// with probability 0.2 of 11.
std::vector<StudySummary> drawn_studies(int n, std::uint64_t seed, double factor = 1.0) {
  std::vector<StudySummary> studies;
  for (int k = 0; k < n; ++k) {
    for (const char* sampler : {"A", "B"}) {
      const auto arm = static_cast<std::uint32_t>(sampler[0] - 'A');
      const auto word = [&](std::uint64_t row) {
        return tmcmc::random_words({.seed = seed, .study = static_cast<std::uint32_t>(k), .arm = arm},
                                   {.row = row});
      };
      const auto w = word(0);
      const auto z = tmcmc::normal_pair(w[0], w[1]);
      StudySummary s;
      s.study = static_cast<std::uint32_t>(k);
      s.sampler = sampler;
      s.areas = {0.1 * factor * std::exp(0.2 * z.first),
                 0.01 * factor * std::exp(0.1 * (0.6 * z.first + 0.8 * z.second))};
      for (std::uint64_t run = 1; run <= 50; ++run) {
        ++s.iterations[tmcmc::uniform_open(word(run)[0]) < 0.2 ? 11 : 10];
      }
      studies.push_back(s);
    }
  }
  return studies;
}

}  // namespace

TEST_CASE("the predictive density is a Normal and a multinomial", "[predictive]") {
  const auto studies = drawn_studies(2000, 3);
  const Prediction prediction(studies, {{10, 0}, {11, 0}});
  const Counts counts = {{10, 40}, {11, 10}};
  // log of a bivariate Normal density at its mean, and of the binomial probability of 10 of 50 at
  // 0.2
  const std::vector<double> centre = {0.1, 0.01};
  const auto at_centre = prediction.log_density(centre, counts);
  CHECK_THAT(at_centre.areas, WithinAbs(-std::log(2.0 * std::acos(-1.0) * 0.2 * 0.1 * 0.8), 0.1));
  CHECK_THAT(at_centre.counts, WithinAbs(std::log(0.139819), 0.01));
  CHECK_THAT(at_centre.both(), WithinAbs(at_centre.areas + at_centre.counts, 1e-14));
  // one standard deviation away in the first alone: distance 1/(1 - 0.36)
  const auto away = prediction.log_density(std::vector<double>{0.1 * std::exp(0.2), 0.01}, counts);
  CHECK_THAT(at_centre.areas - away.areas, WithinAbs(0.5 / 0.64, 0.12));
  CHECK(prediction.of_studies().size() == studies.size());
  CHECK(prediction.of_studies()[5].areas == prediction.log_density(studies[5].areas, {{10, 50}}).areas);
  CHECK_THROWS_WITH(prediction.log_density(centre, {{12, 50}}), Contains("12"));
  CHECK_THROWS_AS(Prediction({studies[0], studies[1]}, {}), errors::InvalidValue);
  CHECK_THROWS_AS(Prediction({studies[0], studies[0], studies[0]}, {}), errors::InvalidValue);
}

TEST_CASE("the p-value of a pair is the share of all pairs", "[predictive]") {
  const std::vector<double> scores = {-1.0, -2.0, -4.0, -7.0, -3.0};
  const auto by_hand = [](const std::vector<double>& x, const std::vector<double>& y, double printed,
                          bool one) {
    double below = 0.0, all = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t j = 0; j < y.size(); ++j) {
        if (!one || i < j) {
          all += 1.0;
          below += x[i] + y[j] <= printed ? 1.0 : 0.0;
        }
      }
    }
    return (below + 1.0) / (all + 1.0);
  };
  const std::vector<double> others = {-2.5, -0.5, -9.0};
  for (const double printed : {-0.5, -5.0, -6.0, -9.5, -30.0}) {
    CAPTURE(printed);
    CHECK_THAT(predictive_p_of_pair(scores, printed).value,
               WithinRel(by_hand(scores, scores, printed, true), 1e-13));
    CHECK_THAT(predictive_p_of_pair(scores, others, printed).value,
               WithinRel(by_hand(scores, others, printed, false), 1e-13));
  }
  CHECK(predictive_p_of_pair(scores, -30.0).standard_error > 0.0);
  CHECK_THAT(predictive_p(scores, -4.0).value, WithinRel(3.0 / 6.0, 1e-13));
  CHECK_THROWS_AS(predictive_p_of_pair(std::vector<double>{1.0}, 0.0), errors::InvalidValue);
}

TEST_CASE("the p-value of a pair and its standard error, over many samples", "[predictive]") {
  // Normal scores: a sum of two is below -2 sqrt 2 with the probability of one below -2
  std::vector<double> one, one_error, two, two_error;
  for (std::uint32_t k = 0; k < 300; ++k) {
    std::vector<double> x;
    for (std::uint64_t i = 0; i < 400; ++i) {
      const auto w = tmcmc::random_words({.seed = 17, .study = k}, {.row = i});
      x.push_back(tmcmc::normal_pair(w[0], w[1]).first);
    }
    const std::vector<double> half(x.begin(), x.begin() + 200), rest(x.begin() + 200, x.end());
    const auto p = predictive_p_of_pair(x, -std::sqrt(8.0));
    const auto q = predictive_p_of_pair(half, rest, -std::sqrt(8.0));
    one.push_back(p.value);
    one_error.push_back(p.standard_error);
    two.push_back(q.value);
    two_error.push_back(q.standard_error);
  }
  const double exact = 0.5 * std::erfc(std::sqrt(2.0));
  for (const auto& [p, error] : {std::pair{one, one_error}, std::pair{two, two_error}}) {
    const auto m = moments(p);
    CHECK_THAT(m.mean, WithinAbs(exact, 4.0 * m.standard_deviation / std::sqrt(300.0) + 1e-4));
    CHECK_THAT(moments(error).mean, WithinRel(m.standard_deviation, 0.2));
  }
}

TEST_CASE("tables that a sampler made are compatible with it, and stranger ones are not", "[predictive]") {
  const auto studies = drawn_studies(300, 5);
  const auto columns = [](const char* first, const char* second, const Counts& counts) {
    return printed_columns({{"A", 0, first}, {"A", 1, "0.0101"}, {"B", 0, second}, {"B", 1, "0.0099"}},
                           {{"A", {{10, 41}, {11, 9}}}, {"B", counts}});
  };
  const auto usual =
      test_jointly(studies, columns("0.102", "0.098", {{10, 39}, {11, 11}}), Null::all_studies);
  for (const PValue& p : {usual.areas, usual.counts, usual.columns[0], usual.columns[1], usual.all}) {
    CHECK(p.value > 0.5);
  }
  const auto strange = test_jointly(studies, columns("0.05", "0.2", {{10, 50}}), Null::all_studies);
  for (const PValue& p :
       {strange.areas, strange.counts, strange.columns[0], strange.columns[1], strange.all}) {
    CHECK(p.value < 0.01);
  }
  const auto own = test_jointly(studies, columns("0.05", "0.098", {{10, 39}, {11, 11}}), Null::own_studies);
  CHECK(own.columns[0].value < 0.01);
  CHECK(own.columns[1].value > 0.5);
  CHECK_THROWS_WITH(test_jointly(studies, {}, Null::all_studies), Contains("two columns"));
  CHECK_THROWS_WITH(printed_columns({{"A", 0, "0.1"}}, {{"A", {{10, 50}}}}), Contains("areas = A"));
}

TEST_CASE("joint p-values of tables drawn from the sampler are uniform", "[predictive]") {
  const auto studies = drawn_studies(400, 7);
  const auto fresh = drawn_studies(500, 8);
  double below = 0.0;
  for (std::size_t i = 0; i + 1 < fresh.size(); i += 2) {
    const auto column = [](const StudySummary& s) {
      return PrintedColumn{s.sampler, s.areas, {s.iterations.begin(), s.iterations.end()}};
    };
    below +=
        test_jointly(studies, {column(fresh[i]), column(fresh[i + 1])}, Null::all_studies).all.value < 0.1;
  }
  CHECK_THAT(below / 500.0, WithinAbs(0.1, 4.0 * std::sqrt(0.1 * 0.9 / 500.0)));
}

TEST_CASE("two contrasts together are rarer than either, and calibrated", "[predictive]") {
  const auto studies = drawn_studies(150, 11);
  const Counts usual = {{10, 40}, {11, 10}};
  CHECK(combined_contrast(studies, 1.0, usual, usual).value > 0.99);
  const auto both = combined_contrast(studies, 1.8, {{10, 47}, {11, 3}}, {{10, 33}, {11, 17}});
  CHECK(both.value < 0.01);
  CHECK(both.value < combined_contrast(studies, 1.8, usual, usual).value);
  CHECK(both.standard_error > 0.0);
  CHECK(combined_contrast(studies, 1.0 / 1.8, {{10, 47}, {11, 3}}, {{10, 33}, {11, 17}}).value == both.value);
  CHECK_THROWS_AS(combined_contrast({studies[0]}, 1.0, usual, usual), errors::InvalidValue);
  // pairs of fresh studies have uniform p-values
  const auto fresh = drawn_studies(300, 12);
  double below = 0.0;
  for (std::size_t i = 0; i + 1 < fresh.size(); i += 2) {
    below += combined_contrast(studies, fresh[i].areas[0] / fresh[i + 1].areas[0],
                               {fresh[i].iterations.begin(), fresh[i].iterations.end()},
                               {fresh[i + 1].iterations.begin(), fresh[i + 1].iterations.end()})
                 .value < 0.2;
  }
  CHECK_THAT(below / 300.0, WithinAbs(0.2, 4.0 * std::sqrt(0.2 * 0.8 / 300.0)));
}

TEST_CASE("the likelihood of all tables is the sum over the columns", "[predictive]") {
  const auto studies = drawn_studies(100, 13);
  const auto columns = printed_columns({{"A", 0, "0.1"}, {"A", 1, "0.01"}, {"B", 0, "0.2"}, {"B", 1, "0.02"}},
                                       {{"A", {{10, 40}, {11, 10}}}, {"B", {{10, 50}}}});
  const Prediction prediction(studies, {{10, 0}, {11, 0}});
  CHECK_THAT(log_likelihood_of_tables(studies, columns, Null::all_studies),
             WithinRel(prediction.log_density(columns[0].areas, columns[0].counts).both() +
                           prediction.log_density(columns[1].areas, columns[1].counts).both(),
                       1e-13));
}
