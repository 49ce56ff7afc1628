#include "replication/paper_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "replication/columns.hpp"

namespace replication {

namespace {

/// Rows of one source in the panel of the areas.
void add_areas(std::vector<BarPair>& bars, const char* source, const io::CsvTable& table,
               const std::array<std::string, 2>& samplers) {
  const auto names = table.text("sampler");
  require_once(table, names, "sampler", "each sampler once");
  const auto row_of = [&](const std::string& sampler) {
    const auto row = std::find(names.begin(), names.end(), sampler);
    if (row == names.end()) {
      throw io::InputError(
          fmt::format("{}: column 'sampler': no row '{}': expected one", table.path().string(), sampler));
    }
    return static_cast<std::size_t>(row - names.begin());
  };
  for (const char* column : {"friction_force_n", "natural_frequency_hz"}) {
    const auto values = nonnegative_numbers(table, column);
    bars.push_back({"area", source, column, {values[row_of(samplers[0])], values[row_of(samplers[1])]}});
  }
}

/// Rows of one source in the panel of the iterations.
void add_counts(std::vector<BarPair>& bars, const char* source, const io::CsvTable& table,
                const std::array<std::string, 2>& samplers, const std::set<long>& categories) {
  const auto iterations = table.integers("iterations");
  const auto first = nonnegative_numbers(table, samplers[0]);
  const auto second = nonnegative_numbers(table, samplers[1]);
  for (const long category : categories) {
    const auto found = std::find(iterations.begin(), iterations.end(), category);
    const auto row = static_cast<std::size_t>(found - iterations.begin());
    const bool is_there = found != iterations.end();
    bars.push_back({"iterations",
                    source,
                    std::to_string(category),
                    {is_there ? first[row] : 0.0, is_there ? second[row] : 0.0}});
  }
}

}  // namespace

IterationTable count_iterations(const io::CsvTable& runs) {
  const auto samplers = runs.text("sampler");
  const auto iterations = positive_integers(runs, "iterations");
  if (runs.has("run")) {
    require_runs_once(runs);
  }
  IterationTable table;
  std::map<std::string_view, std::size_t> columns;
  for (const auto& sampler : samplers) {
    if (columns.try_emplace(sampler, columns.size()).second) {
      table.samplers.push_back(sampler);
    }
  }
  for (std::size_t row = 0; row < samplers.size(); ++row) {
    auto& counts = table.runs[iterations[row]];
    counts.resize(columns.size());
    ++counts[columns[samplers[row]]];
  }
  return table;
}

std::vector<StandardError> standard_errors(const GroupedColumns& samples) {
  std::vector<StandardError> rows;
  for (std::size_t s = 0; s < samples.samplers.size(); ++s) {
    for (std::size_t c = 0; c < samples.columns.size(); ++c) {
      std::vector<double> means, variances;
      double count = 0.0;
      for (std::size_t run = 0; run < samples.values[s][c].size(); ++run) {
        const auto m = samples.moments_of(s, c, run);
        means.push_back(m.mean);
        variances.push_back(m.standard_deviation * m.standard_deviation);
        count += static_cast<double>(samples.values[s][c][run].size());
      }
      count /= static_cast<double>(means.size());
      const auto m = moments(means);
      const double between = means.size() > 1 ? m.standard_deviation * m.standard_deviation : 0.0;
      const double variance = moments(variances).mean + between;
      rows.push_back({samples.samplers[s], samples.columns[c], m.mean, m.standard_deviation,
                      std::sqrt(variance), std::sqrt(variance / count),
                      variance / (m.standard_deviation * m.standard_deviation)});
    }
  }
  return rows;
}

std::vector<BarPair> bar_pairs(const AreasAndCounts& printed, const AreasAndCounts& reproduced,
                               const std::array<std::string, 2>& samplers) {
  std::vector<BarPair> bars;
  add_areas(bars, "printed", printed.areas, samplers);
  add_areas(bars, "reproduced", reproduced.areas, samplers);
  std::set<long> categories;
  for (const io::CsvTable* table : {&printed.counts, &reproduced.counts}) {
    const auto numbers = positive_integers(*table, "iterations");
    require_once(*table, numbers, "iterations", "each number of iterations once");
    categories.insert(numbers.begin(), numbers.end());
  }
  add_counts(bars, "printed", printed.counts, samplers, categories);
  add_counts(bars, "reproduced", reproduced.counts, samplers, categories);
  return bars;
}

std::vector<StageOfRun> read_stages(const io::CsvTable& table) {
  const auto samplers = table.text("sampler");
  const auto runs = table.integers("run");
  const auto stages = positive_integers(table, "stage");
  const auto betas = checked(
      table, "beta", table.numbers("beta"), [](double beta) { return beta >= 0.0 && beta <= 1.0; },
      "a number from 0 to 1");
  std::vector<StageOfRun> all;
  std::vector<std::tuple<std::string_view, long, long>> keys;
  for (std::size_t row = 0; row < betas.size(); ++row) {
    all.push_back({samplers[row], runs[row], stages[row], betas[row]});
    keys.emplace_back(samplers[row], runs[row], stages[row]);
  }
  require_once(table, keys, "stage", "each stage once a run");
  return all;
}

}  // namespace replication
