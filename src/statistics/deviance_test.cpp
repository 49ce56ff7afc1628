#include "statistics/deviance_test.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "errors/invalid_value.hpp"
#include "portable_math/elementary.hpp"
#include "statistics/summary.hpp"
#include "tmcmc/random.hpp"

namespace statistics {

namespace {

using Row = std::vector<std::int64_t>;  // counts in the order of the categories

double x_log_x(std::int64_t n) {
  const auto x = static_cast<double>(n);
  return n == 0 ? 0.0 : x * portable_math::log(x);
}

/// sum x log x - n log n of the counts x with total n.
double entropy_sum(const Row& row) {
  double sum = -x_log_x(std::accumulate(row.begin(), row.end(), std::int64_t{0}));
  for (const std::int64_t n : row) {
    sum += x_log_x(n);
  }
  return sum;
}

using Probabilities = std::map<std::int64_t, double>;

/// Category probabilities as vectors, and draws from them.
struct Multinomial {
  std::vector<double> cumulative;
  std::vector<double> log_probability;

  explicit Multinomial(const Probabilities& probabilities) {
    double below = 0.0;
    for (const auto& cell : probabilities) {
      below += cell.second;
      cumulative.push_back(below);
      log_probability.push_back(portable_math::log(cell.second));
    }
  }

  /// Adds n draws to the row; uses the numbers (stage, row, 0 ...) of the stream.
  void draw(Row& row, std::int64_t n, const tmcmc::StreamKey& key, tmcmc::DrawId id) const {
    tmcmc::Words words{};
    for (std::int64_t i = 0; i < n; ++i) {
      const auto word = static_cast<std::size_t>(i % 4);
      if (word == 0) {
        id.draw = static_cast<std::uint32_t>(i / 4);
        words = tmcmc::random_words(key, id);
      }
      const double u = tmcmc::uniform_open(words[word]);
      std::size_t category = 0;
      while (category + 1 < cumulative.size() && u >= cumulative[category]) {
        ++category;
      }
      ++row[category];
    }
  }

  [[nodiscard]] double log_kernel(const Row& row) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < row.size(); ++c) {
      sum += static_cast<double>(row[c]) * log_probability[c];
    }
    return sum;
  }
};

/// Tables that were drawn or printed, reduced to the sums from which the deviance and the
/// probability are computed.
struct Drawn {
  std::vector<Row> total;  // of the tables of each source
  double fixed = 0.0;      // the part of the deviance that no probability enters
};

enum class Against { given_probabilities, each_other };

class DevianceNull {
 public:
  /// A source is the distribution from which tables are drawn; either each table has its own
  /// source, or all share one.
  DevianceNull(const std::vector<Counts>& printed, const std::vector<std::vector<Counts>>& replicated,
               Against against, const TableDraws& options)
      : options_(options), against_(against) {
    for (const auto& studies : replicated) {
      add_categories(studies);
      runs_.push_back(std::accumulate(studies.begin(), studies.end(), std::int64_t{0},
                                      [](std::int64_t sum, const Counts& c) { return sum + total_of(c); }));
    }
    add_categories(printed);
    std::vector<Row> rows;
    for (const Counts& counts : printed) {
      rows.push_back(row_of(counts));
      table_runs_.push_back(total_of(counts));
    }
    for (const auto& studies : replicated) {
      null_.emplace_back(category_probabilities(studies, categories_));
    }
    printed_ = record(rows);
    draw_tables();
  }

  [[nodiscard]] DevianceTest test() const {
    DevianceTest result;
    result.statistic = deviance_of(printed_, null_);
    std::vector<double> null;
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      null.insert(null.end(), static_cast<std::size_t>(count_[i]), deviance_of(drawn_[i], null_));
    }
    std::sort(null.begin(), null.end());
    result.critical = sample_quantile(null, 0.95);
    result.interval = {sample_quantile(null, 0.025), sample_quantile(null, 0.975)};
    result.p = upper_p(null, result.statistic, tolerance(result.statistic));
    const double of_tables = result.p.standard_error;
    const double of_runs = moments(resampled()).standard_deviation;
    result.p.standard_error = std::sqrt(of_tables * of_tables + of_runs * of_runs);
    return result;
  }

 private:
  /// Equal tables must tie even if their sums round differently.
  static double tolerance(double statistic) { return 1e-9 * (1.0 + std::fabs(statistic)); }

  /// The bootstrap of median_ratio_equivalence uses arms 0 and 1.
  [[nodiscard]] tmcmc::StreamKey stream() const { return {.seed = options_.seed, .arm = 2}; }

  [[nodiscard]] std::size_t source(std::size_t table) const { return runs_.size() == 1 ? 0 : table; }

  void add_categories(const std::vector<Counts>& tables) {
    for (const Counts& counts : tables) {
      for (const auto& cell : counts) {
        categories_[cell.first] = 0;
      }
    }
  }

  [[nodiscard]] Row row_of(const Counts& counts) const {
    Row row;
    for (const auto& cell : categories_) {
      const auto found = counts.find(cell.first);
      row.push_back(found == counts.end() ? 0 : found->second);
    }
    return row;
  }

  void look_for_interrupt() const {
    if (options_.interrupt) {
      options_.interrupt();
    }
  }

  /// Tables that have been drawn before are counted again: there are few distinct ones.
  void draw_tables() {
    std::map<std::vector<Row>, std::int64_t> frequency;
    std::vector<Row> tables(table_runs_.size());
    for (int i = 0; i < options_.tables; ++i) {
      look_for_interrupt();
      for (std::size_t t = 0; t < tables.size(); ++t) {
        tables[t].assign(categories_.size(), 0);
        null_[source(t)].draw(tables[t], table_runs_[t], stream(),
                              {.purpose = tmcmc::Purpose::statistics,
                               .row = static_cast<std::uint64_t>(i),
                               .block = static_cast<std::uint32_t>(t)});
      }
      ++frequency[tables];
    }
    for (const auto& [table, count] : frequency) {
      drawn_.push_back(record(table));
      count_.push_back(static_cast<double>(count));
    }
  }

  [[nodiscard]] Drawn record(const std::vector<Row>& tables) const {
    Drawn drawn{std::vector<Row>(runs_.size(), Row(categories_.size(), 0))};
    for (std::size_t t = 0; t < tables.size(); ++t) {
      Row& sum = drawn.total[source(t)];
      drawn.fixed += entropy_sum(tables[t]);
      std::transform(tables[t].begin(), tables[t].end(), sum.begin(), sum.begin(), std::plus<>());
    }
    if (against_ == Against::each_other) {  // the expected counts are those of both tables together
      drawn.fixed -= entropy_sum(drawn.total.front());
      drawn.fixed = drawn.fixed < tolerance(0.0) ? 0.0 : drawn.fixed;  // equal shares, but for rounding
    }
    return drawn;
  }

  [[nodiscard]] static double log_kernel(const Drawn& drawn, const std::vector<Multinomial>& probabilities) {
    double sum = 0.0;
    for (std::size_t s = 0; s < probabilities.size(); ++s) {
      sum += probabilities[s].log_kernel(drawn.total[s]);
    }
    return sum;
  }

  [[nodiscard]] double deviance_of(const Drawn& drawn, const std::vector<Multinomial>& probabilities) const {
    return 2.0 *
           (against_ == Against::each_other ? drawn.fixed : drawn.fixed - log_kernel(drawn, probabilities));
  }

  /// The p-value under other probabilities: each table is weighted by the ratio of its
  /// probabilities.
  [[nodiscard]] double p_under(const std::vector<Multinomial>& probabilities) const {
    const double statistic = deviance_of(printed_, probabilities);
    double tail = 0.0;
    double all = 0.0;
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      const double weight =
          count_[i] * portable_math::exp(log_kernel(drawn_[i], probabilities) - log_kernel(drawn_[i], null_));
      all += weight;
      tail += deviance_of(drawn_[i], probabilities) >= statistic - tolerance(statistic) ? weight : 0.0;
    }
    return tail / all;
  }

  /// p-values with the replicated runs resampled.
  [[nodiscard]] std::vector<double> resampled() const {
    std::vector<double> p;
    for (int round = 1; round <= options_.resamples; ++round) {
      look_for_interrupt();
      std::vector<Multinomial> again;
      for (std::size_t s = 0; s < runs_.size(); ++s) {
        Row row(categories_.size(), 0);
        null_[s].draw(row, runs_[s], stream(),
                      {.purpose = tmcmc::Purpose::statistics,
                       .stage = static_cast<std::uint32_t>(round),
                       .block = static_cast<std::uint32_t>(s)});
        Counts counts;
        for (const auto& cell : categories_) {
          counts.emplace_hint(counts.end(), cell.first, row[counts.size()]);
        }
        again.emplace_back(category_probabilities({counts}, categories_));
      }
      p.push_back(p_under(again));
    }
    return p;
  }

  TableDraws options_;
  Against against_;
  Counts categories_;                     // all that occur, with 0
  std::vector<std::int64_t> runs_;        // replicated, of each source
  std::vector<std::int64_t> table_runs_;  // of each printed table
  std::vector<Multinomial> null_;         // of each source
  Drawn printed_;
  std::vector<Drawn> drawn_;
  std::vector<double> count_;  // how often each was drawn
};

DevianceTest test(const std::vector<Counts>& printed, const std::vector<std::vector<Counts>>& replicated,
                  Against against, const TableDraws& draws) {
  if (printed.empty() || (replicated.size() != 1 && replicated.size() != printed.size()) ||
      std::any_of(replicated.begin(), replicated.end(), [](const auto& s) { return s.empty(); })) {
    throw errors::InvalidValue("replicated", "", "studies behind each of one or more printed tables");
  }
  if (draws.tables < 1) {
    throw errors::InvalidValue("tables", draws.tables, "at least 1");
  }
  if (draws.resamples < 2) {
    throw errors::InvalidValue("resamples", draws.resamples, "at least 2");
  }
  return DevianceNull(printed, replicated, against, draws).test();
}

}  // namespace

DevianceTest test_tables(const std::vector<Counts>& printed,
                         const std::vector<std::vector<Counts>>& replicated, const TableDraws& draws) {
  return test(printed, replicated, Against::given_probabilities, draws);
}

DevianceTest test_two_tables(const Counts& first, const Counts& second, const std::vector<Counts>& replicated,
                             const TableDraws& draws) {
  return test({first, second}, {replicated}, Against::each_other, draws);
}

}  // namespace statistics
