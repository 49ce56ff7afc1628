#include "replication/published.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "errors/invalid_value.hpp"
#include "portable_math/elementary.hpp"

namespace replication {

namespace {

double number(const std::string& printed) {
  double value = 0.0;
  std::from_chars(printed.data(), printed.data() + printed.size(), value);
  return value;
}

constexpr std::size_t most_studies_in_pairs = 3000;

std::vector<double> areas_of(const std::vector<StudySummary>& studies, std::size_t parameter) {
  std::vector<double> areas;
  for (const auto& s : studies) {
    areas.push_back(s.areas.at(parameter));
  }
  return areas;
}

std::vector<Counts> counts_of(const std::vector<StudySummary>& studies) {
  std::vector<Counts> counts;
  for (const auto& s : studies) {
    counts.emplace_back(s.iterations.begin(), s.iterations.end());
  }
  return counts;
}

std::vector<double> iterations_of(const std::vector<StudySummary>& studies) {
  std::vector<double> means;
  for (const auto& counts : counts_of(studies)) {
    means.push_back(mean_iterations(counts));
  }
  return means;
}

Counts categories_of(const std::vector<PrintedColumn>& columns) {
  Counts categories;
  for (const auto& column : columns) {
    categories.insert(column.counts.begin(), column.counts.end());
  }
  return categories;
}

/// n log n for a number of runs n.
double x_log_x(std::int64_t n) {
  const auto x = static_cast<double>(n);
  return n == 0 ? 0.0 : x * portable_math::log(x);
}

/// Two-sample deviance of two tables, as in test_two_tables.
double deviance(const Counts& a, const Counts& b) {
  Counts both = a;
  for (const auto& [category, count] : b) {
    both[category] += count;
  }
  const auto entropy = [](const Counts& counts) {
    double sum = -x_log_x(total_of(counts));
    for (const auto& cell : counts) {
      sum += x_log_x(cell.second);
    }
    return sum;
  };
  return 2.0 * (entropy(a) + entropy(b) - entropy(both));
}

/// Share of the sorted values that are at least as large as the value, which itself counts as one.
double upper_share(const std::vector<double>& sorted, double value) {
  const auto above = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), value - 1e-9);
  return static_cast<double>(above + 1) / static_cast<double>(sorted.size() + 1);
}

}  // namespace

std::vector<StudySummary> studies_of(const std::vector<StudySummary>& studies, const std::string& sampler) {
  std::vector<StudySummary> result;
  std::copy_if(studies.begin(), studies.end(), std::back_inserter(result),
               [&](const StudySummary& s) { return s.sampler == sampler; });
  if (result.empty()) {
    throw errors::InvalidValue("sampler", sampler, "one with at least one replicated study");
  }
  return result;
}

std::vector<StudySummary> null_studies(const std::vector<StudySummary>& studies, const std::string& sampler,
                                       Null null) {
  auto own = studies_of(studies, sampler);
  return null == Null::all_studies ? studies : own;
}

double mean_iterations(const Counts& counts) {
  double sum = 0.0;
  double runs = 0.0;
  for (const auto& [iterations, count] : counts) {
    sum += static_cast<double>(iterations * count);
    runs += static_cast<double>(count);
  }
  return sum / runs;
}

std::vector<CellVerdict> judge_areas(const std::vector<StudySummary>& studies,
                                     const std::vector<PrintedArea>& areas, Null null) {
  std::vector<CellVerdict> cells;
  for (const auto& area : areas) {
    auto sample = areas_of(null_studies(studies, area.sampler, null), area.parameter);
    std::sort(sample.begin(), sample.end());
    const double half_width = rounding_half_width(area.printed);
    CellVerdict cell;
    cell.sampler = area.sampler;
    cell.parameter = area.parameter;
    cell.printed = number(area.printed);
    cell.median = sample_quantile(sample, 0.5);
    cell.interval = {sample_quantile(sample, 0.025), sample_quantile(sample, 0.975)};
    cell.percentile = percentile(sample, cell.printed, half_width);
    cell.p = two_sided_p(sample, cell.printed, half_width);
    cell.number = judge_number(cell.p);
    cells.push_back(cell);
  }
  return cells;
}

std::vector<DevianceTest> judge_counts(const std::vector<StudySummary>& studies,
                                       const std::vector<PrintedCounts>& columns, Null null,
                                       const TableDraws& draws) {
  std::vector<DevianceTest> tests;
  std::vector<Counts> printed;
  std::vector<std::vector<Counts>> replicated;
  for (const auto& column : columns) {
    printed.push_back(column.counts);
    replicated.push_back(counts_of(null_studies(studies, column.sampler, null)));
    tests.push_back(test_tables({printed.back()}, {replicated.back()}, draws));
  }
  if (null == Null::all_studies) {
    replicated.resize(1);
  }
  tests.push_back(test_tables(printed, replicated, draws));
  return tests;
}

std::vector<PrintedColumn> printed_columns(const std::vector<PrintedArea>& areas,
                                           const std::vector<PrintedCounts>& counts) {
  std::vector<PrintedColumn> columns;
  for (const auto& column : counts) {
    PrintedColumn printed{column.sampler, {}, column.counts};
    for (const std::size_t parameter : {std::size_t{0}, std::size_t{1}}) {
      const auto found = std::find_if(areas.begin(), areas.end(), [&](const PrintedArea& a) {
        return a.sampler == column.sampler && a.parameter == parameter;
      });
      if (found == areas.end()) {
        throw errors::InvalidValue("areas", column.sampler, "the printed areas of both parameters");
      }
      printed.areas.push_back(number(found->printed));
    }
    columns.push_back(std::move(printed));
  }
  return columns;
}

JointTests test_jointly(const std::vector<StudySummary>& studies, const std::vector<PrintedColumn>& printed,
                        Null null) {
  if (printed.size() != 2) {
    throw errors::InvalidValue("printed", printed.size(), "two columns");
  }
  std::vector<Prediction> predictions;
  std::vector<LogDensity> densities;
  for (const auto& column : printed) {
    predictions.emplace_back(null_studies(studies, column.sampler, null), categories_of(printed));
    densities.push_back(predictions.back().log_density(column.areas, column.counts));
  }
  const auto of_pair = [&](double (*part)(const LogDensity&)) {
    const auto first = scores_of(predictions[0], part);
    const double sum = part(densities[0]) + part(densities[1]);
    return null == Null::all_studies ? predictive_p_of_pair(first, sum)
                                     : predictive_p_of_pair(first, scores_of(predictions[1], part), sum);
  };
  const auto both = [](const LogDensity& d) { return d.both(); };
  return {of_pair([](const LogDensity& d) { return d.areas; }),
          of_pair([](const LogDensity& d) { return d.counts; }),
          {predictive_p(scores_of(predictions[0], both), densities[0].both()),
           predictive_p(scores_of(predictions[1], both), densities[1].both())},
          of_pair(both)};
}

Null null_of(const std::vector<StudySummary>& studies, const std::string& first, const std::string& second,
             std::uint64_t seed) {
  const auto a = studies_of(studies, first);
  const auto b = studies_of(studies, second);
  bool one = mean_ratio_equivalence(iterations_of(a), iterations_of(b), iteration_margin).equivalent;
  for (const std::size_t parameter : {std::size_t{0}, std::size_t{1}}) {
    one = one && median_ratio_equivalence(areas_of(a, parameter), areas_of(b, parameter), area_margin, seed)
                     .equivalent;
  }
  return one ? Null::all_studies : Null::own_studies;
}

ContrastVerdict contrast_areas(const std::vector<StudySummary>& studies, const std::string& first,
                               const std::string& second, std::size_t parameter, double printed_ratio,
                               std::uint64_t seed) {
  const auto a = areas_of(studies_of(studies, first), parameter);
  const auto b = areas_of(studies_of(studies, second), parameter);
  auto both = a;
  both.insert(both.end(), b.begin(), b.end());
  const RatioTest test = test_ratio_of_equals(std::move(both), printed_ratio);
  return {printed_ratio, test.interval, test.p, median_ratio_equivalence(a, b, area_margin, seed)};
}

ContrastVerdict contrast_iterations(const std::vector<StudySummary>& studies, const Counts& first_printed,
                                    const Counts& second_printed, const std::string& first,
                                    const std::string& second, const TableDraws& draws) {
  const auto a = studies_of(studies, first);
  const auto b = studies_of(studies, second);
  auto both = counts_of(a);
  const auto of_second = counts_of(b);
  both.insert(both.end(), of_second.begin(), of_second.end());
  const DevianceTest test = test_two_tables(first_printed, second_printed, both, draws);
  return {test.statistic, test.interval, test.p,
          mean_ratio_equivalence(iterations_of(a), iterations_of(b), iteration_margin)};
}

PValue combined_contrast(const std::vector<StudySummary>& studies, double ratio, const Counts& first,
                         const Counts& second) {
  const std::size_t n = std::min(studies.size(), most_studies_in_pairs);
  if (n < 2 || !(ratio > 0.0)) {
    throw errors::InvalidValue("studies and ratio", n, "at least two studies, and a positive ratio");
  }
  std::vector<double> logs;
  for (std::size_t i = 0; i < n; ++i) {
    logs.push_back(portable_math::log(studies[i].areas.at(0)));
  }
  std::map<Counts, std::size_t> index;  // few tables differ
  std::vector<std::size_t> table;
  for (const auto& counts : counts_of({studies.begin(), studies.begin() + static_cast<std::ptrdiff_t>(n)})) {
    table.push_back(index.try_emplace(counts, index.size()).first->second);
  }
  std::vector<std::vector<double>> deviances(index.size(), std::vector<double>(index.size()));
  for (const auto& [a, i] : index) {
    for (const auto& [b, j] : index) {
      deviances[i][j] = deviance(a, b);
    }
  }
  std::vector<double> ratios, differences;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      ratios.push_back(std::fabs(logs[i] - logs[j]));
      differences.push_back(deviances[table[i]][table[j]]);
    }
  }
  std::sort(ratios.begin(), ratios.end());
  std::sort(differences.begin(), differences.end());
  for (auto& row : deviances) {  // from here on their upper shares
    for (double& d : row) {
      d = upper_share(differences, d);
    }
  }
  const double printed = upper_share(ratios, std::fabs(portable_math::log(ratio))) *
                         upper_share(differences, deviance(first, second));
  std::vector<double> shares(n, 0.0);
  double pairs = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const double of_counts = deviances[table[i]][table[j]];
      if (of_counts <= printed ||
          of_counts * upper_share(ratios, std::fabs(logs[i] - logs[j])) <= printed * (1.0 + 1e-12)) {
        shares[i] += 1.0;
        shares[j] += 1.0;
        pairs += 1.0;
      }
    }
  }
  const auto all = static_cast<double>(ratios.size());
  for (double& share : shares) {
    share /= static_cast<double>(n - 1);
  }
  const double error = 2.0 * moments(shares).standard_deviation / std::sqrt(static_cast<double>(n));
  return {(pairs + 1.0) / (all + 1.0), pairs > 0.0 ? error : 2.0 / static_cast<double>(n)};
}

double log_likelihood_of_tables(const std::vector<StudySummary>& studies,
                                const std::vector<PrintedColumn>& printed, Null null) {
  double sum = 0.0;
  for (const auto& column : printed) {
    const Prediction prediction(null_studies(studies, column.sampler, null), categories_of(printed));
    sum += prediction.log_density(column.areas, column.counts).both();
  }
  return sum;
}

}  // namespace replication
