// Tables of counts in their null distribution, against the enumeration of all tables.

#include <catch2/catch.hpp>
#include <cmath>

#include "errors/invalid_value.hpp"
#include "statistics/deviance_test.hpp"
#include "statistics/summary.hpp"
#include "tmcmc/random.hpp"

using namespace statistics;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

namespace {

using Probabilities = std::map<std::int64_t, double>;

/// 2 sum O log(O/E) from the definition.
double deviance(const Counts& counts, const Probabilities& probabilities) {
  double sum = 0.0;
  for (const auto& [category, count] : counts) {
    const auto observed = static_cast<double>(count);
    const double expected = static_cast<double>(total_of(counts)) * probabilities.at(category);
    sum += count == 0 ? 0.0 : 2.0 * observed * std::log(observed / expected);
  }
  return sum;
}

double two_sample_deviance(const Counts& a, const Counts& b) {
  Probabilities common;
  const auto n = static_cast<double>(total_of(a) + total_of(b));
  for (const auto* counts : {&a, &b}) {
    for (const auto& [category, count] : *counts) {
      common[category] += static_cast<double>(count) / n;
    }
  }
  return deviance(a, common) + deviance(b, common);
}

/// All tables of n runs in categories 9, 10 and 11.
std::vector<Counts> all_tables(std::int64_t n) {
  std::vector<Counts> tables;
  for (std::int64_t i = 0; i <= n; ++i) {
    for (std::int64_t j = 0; i + j <= n; ++j) {
      tables.push_back({{9, i}, {10, j}, {11, n - i - j}});
    }
  }
  return tables;
}

const Counts printed = {{9, 3}, {10, 6}, {11, 3}};
const std::vector<Counts> replicated = {{{9, 100}, {10, 1500}}, {{9, 150}, {11, 250}}};

/// Counts of n draws.
Counts draw(const Probabilities& probabilities, int n, std::uint32_t study) {
  Counts counts;
  for (int i = 0; i < n; ++i) {
    double u = tmcmc::uniform_open(
        tmcmc::random_words({.seed = 3, .study = study}, {.row = static_cast<std::uint64_t>(i)})[0]);
    auto cell = probabilities.begin();
    while (u >= cell->second && std::next(cell) != probabilities.end()) {
      u -= cell->second;
      ++cell;
    }
    ++counts[cell->first];
  }
  return counts;
}

}  // namespace

TEST_CASE("deviances in closed form", "[counts]") {
  const std::vector<Counts> fair = {{{0, 500}, {1, 500}}};
  const TableDraws few{.tables = 10, .resamples = 2};
  const auto of = [&](const std::vector<Counts>& tables) {
    return test_tables(tables, {fair}, few).statistic;
  };
  CHECK_THAT(of({{{0, 5}, {1, 5}}}), WithinAbs(0.0, 1e-12));
  CHECK_THAT(of({{{0, 10}, {1, 0}}}), WithinRel(20.0 * std::log(2.0), 1e-13));
  CHECK_THAT(of({{{0, 10}}, {{1, 3}}}), WithinRel(26.0 * std::log(2.0), 1e-13));
  CHECK(of({{}}) == 0.0);  // no run at all
  CHECK_THAT(test_two_tables({{0, 5}}, {{1, 5}}, fair, few).statistic,
             WithinRel(20.0 * std::log(2.0), 1e-13));
  CHECK(test_two_tables({{0, 3}, {1, 2}}, {{0, 6}, {1, 4}}, fair, few).statistic == 0.0);
  // a category that no study has: half a count of 1001.5
  CHECK_THAT(of({{{7, 1}}}), WithinRel(2.0 * std::log(1001.5 / 0.5), 1e-13));
}

TEST_CASE("the p-value of a table is that of all tables enumerated", "[counts]") {
  const auto probabilities = category_probabilities(replicated, printed);
  const double statistic = deviance(printed, probabilities);
  double exact = 0.0;
  for (const Counts& table : all_tables(12)) {
    if (deviance(table, probabilities) >= statistic - 1e-9) {
      exact += std::exp(log_multinomial(table, probabilities));
    }
  }
  const auto test = test_tables({printed}, {replicated});
  CHECK_THAT(test.statistic, WithinRel(statistic, 1e-12));
  const double of_tables = std::sqrt(exact * (1.0 - exact) / 200000.0);
  CHECK_THAT(test.p.value, WithinAbs(exact, 4.0 * of_tables));
  CHECK(test.p.standard_error > 2.0 * of_tables);  // 2000 replicated runs add to it
  const auto again = test_tables({printed}, {replicated}, {.seed = 2});
  CHECK(again.p.value != test.p.value);
  CHECK_THAT(again.p.value, WithinAbs(exact, 4.0 * of_tables));
  CHECK(test_tables({printed}, {replicated}).p.value == test.p.value);
}

TEST_CASE("two tables: together, from sources of their own, and against each other", "[counts]") {
  const Counts second = {{9, 0}, {10, 8}, {11, 4}};
  const std::vector<Counts> other = {{{9, 50}, {10, 350}, {11, 600}}};
  const auto a = category_probabilities(replicated, printed);
  const auto b = category_probabilities(other, printed);
  const auto tables = all_tables(12);
  double same = 0.0, own = 0.0, each_other = 0.0;
  const double statistic_same = deviance(printed, a) + deviance(second, a);
  const double statistic_own = deviance(printed, a) + deviance(second, b);
  const double statistic_each_other = two_sample_deviance(printed, second);
  for (const Counts& x : tables) {
    for (const Counts& y : tables) {
      const double p = std::exp(log_multinomial(x, a) + log_multinomial(y, a));
      same += deviance(x, a) + deviance(y, a) >= statistic_same - 1e-9 ? p : 0.0;
      each_other += two_sample_deviance(x, y) >= statistic_each_other - 1e-9 ? p : 0.0;
      own += deviance(x, a) + deviance(y, b) >= statistic_own - 1e-9
                 ? std::exp(log_multinomial(x, a) + log_multinomial(y, b))
                 : 0.0;
    }
  }
  const auto check = [](const DevianceTest& test, double statistic, double exact) {
    CHECK_THAT(test.statistic, WithinRel(statistic, 1e-12));
    CHECK_THAT(test.p.value, WithinAbs(exact, 4.0 * std::sqrt(exact * (1.0 - exact) / 200000.0)));
  };
  check(test_tables({printed, second}, {replicated}), statistic_same, same);
  check(test_tables({printed, second}, {replicated, other}), statistic_own, own);
  check(test_two_tables(printed, second, replicated), statistic_each_other, each_other);
}

TEST_CASE("the standard error is what other replicated runs would change", "[counts]") {
  const Probabilities truth = {{9, 0.05}, {10, 0.88}, {11, 0.07}};
  const Counts first = {{9, 6}, {10, 44}, {11, 0}};
  const Counts second = {{9, 5}, {10, 36}, {11, 9}};
  constexpr int repetitions = 60;
  const auto spread = [&](int runs, auto test) {
    std::vector<double> p, error;
    for (std::uint32_t k = 0; k < repetitions; ++k) {
      const DevianceTest result = test(draw(truth, runs, k), k);
      p.push_back(result.p.value);
      error.push_back(result.p.standard_error);
    }
    // the sd of an sd of 60 is 9 %
    CHECK_THAT(moments(error).mean, WithinRel(moments(p).standard_deviation, 0.36));
  };
  spread(4000, [&](const Counts& runs, std::uint64_t k) {
    return test_tables({first}, {{runs}}, {.tables = 20000, .resamples = 50, .seed = k});
  });
  spread(4000, [&](const Counts& runs, std::uint64_t k) {
    return test_tables({first, second}, {{runs}}, {.tables = 20000, .resamples = 50, .seed = k});
  });
  // Here the tail itself does not depend on the probabilities, only how likely it is.
  const Counts less = {{9, 5}, {10, 42}, {11, 3}};
  spread(1000, [&](const Counts& runs, std::uint64_t k) {
    return test_two_tables(first, less, {runs}, {.tables = 20000, .resamples = 50, .seed = k});
  });
}

TEST_CASE("few tables are an error too", "[counts]") {
  const std::vector<Counts> many = {{{9, 100000}, {10, 200000}, {11, 100000}}};
  const auto test = test_tables({{{9, 5}, {10, 4}, {11, 3}}}, {many}, {.tables = 500, .resamples = 2});
  const double p = test.p.value;
  REQUIRE((p > 0.1 && p < 0.9));
  CHECK_THAT(test.p.standard_error, WithinRel(std::sqrt(p * (1.0 - p) / 501.0), 0.1));
}

TEST_CASE("quantiles of the null", "[counts]") {
  // For many runs the deviance is chi^2 with 2 degrees of freedom: 95 % at -2 log 0.05, central 95
  // % likewise.
  const auto test = test_tables({{{9, 300}, {10, 300}, {11, 400}}}, {{{{9, 3000}, {10, 3000}, {11, 4000}}}});
  CHECK_THAT(test.critical, WithinRel(-2.0 * std::log(0.05), 0.02));
  CHECK_THAT(test.interval.low, WithinRel(-2.0 * std::log(0.975), 0.1));
  CHECK_THAT(test.interval.high, WithinRel(-2.0 * std::log(0.025), 0.02));
}

TEST_CASE("options and studies out of range are refused", "[counts]") {
  CHECK_THROWS_AS(test_tables({printed}, {replicated}, {.tables = 0}), errors::InvalidValue);
  CHECK_THROWS_AS(test_tables({printed}, {replicated}, {.resamples = 1}), errors::InvalidValue);
  CHECK_THROWS_AS(test_tables({printed}, {std::vector<Counts>{}}), errors::InvalidValue);
  CHECK_THROWS_AS(test_tables({}, {replicated}), errors::InvalidValue);
  CHECK_THROWS_AS(test_tables({printed, printed, printed}, {replicated, replicated}), errors::InvalidValue);
}
