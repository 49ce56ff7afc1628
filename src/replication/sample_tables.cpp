#include "replication/sample_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "replication/columns.hpp"
#include "tmcmc/diagnostics.hpp"

namespace replication {

namespace {

constexpr double most_ordinary_number = 1e100;  // sums and squares do not overflow
const std::string weight_column = "weight";

/// Weights by run of a sampler; each run must have a weight above 0.
std::vector<std::vector<std::vector<double>>> weights_of(
    const io::CsvTable& table, const std::vector<std::map<long, std::size_t>>& runs,
    const std::vector<std::pair<std::size_t, std::size_t>>& place) {
  const auto numbers = checked(
      table, weight_column, table.numbers(weight_column),
      [](double x) { return x >= 0.0 && x <= most_ordinary_number; }, "a number from 0 to 1e100");
  std::vector<std::vector<std::vector<double>>> weights;
  for (const auto& of_sampler : runs) {
    weights.emplace_back(of_sampler.size());
  }
  for (std::size_t row = 0; row < numbers.size(); ++row) {
    weights[place[row].first][place[row].second].push_back(numbers[row]);
  }
  for (const auto& of_sampler : weights) {
    for (const auto& of_run : of_sampler) {
      if (*std::max_element(of_run.begin(), of_run.end()) <= 0.0) {
        throw io::InputError(table.path().string() +
                             ": column 'weight': expected a positive weight in each run");
      }
    }
  }
  return weights;
}

}  // namespace

GroupedColumns read_samples(const std::string& path) {
  return read_samples(io::CsvTable::read(path));
}

GroupedColumns read_samples(const io::CsvTable& table) {
  table.require_columns({"sampler", "run"});
  const auto samplers = table.text("sampler");
  const auto runs = table.integers("run");
  GroupedColumns result;
  std::map<std::string_view, std::size_t> sampler_index;
  std::vector<std::map<long, std::size_t>> run_index;
  std::vector<std::pair<std::size_t, std::size_t>> place;  // of each row: sampler, run
  for (std::size_t row = 0; row < samplers.size(); ++row) {
    const auto [found, is_new] = sampler_index.try_emplace(samplers[row], sampler_index.size());
    if (is_new) {
      result.samplers.push_back(samplers[row]);
      run_index.emplace_back();
    }
    const std::size_t s = found->second;
    const auto run = run_index[s].try_emplace(runs[row], run_index[s].size()).first->second;
    place.emplace_back(s, run);
  }
  for (const auto& name : table.column_names()) {
    if (name != "sampler" && name != "run" && name != weight_column) {
      result.columns.push_back(name);
    }
  }
  if (result.columns.empty()) {
    throw io::InputError(table.path().string() +
                         ": no column of samples: expected at least one besides sampler and run");
  }
  result.values.resize(result.samplers.size());
  for (std::size_t s = 0; s < result.samplers.size(); ++s) {
    result.values[s].assign(result.columns.size(), std::vector<std::vector<double>>(run_index[s].size()));
  }
  for (std::size_t c = 0; c < result.columns.size(); ++c) {
    const auto numbers = checked(
        table, result.columns[c], table.numbers(result.columns[c]),
        [](double x) { return std::fabs(x) <= most_ordinary_number; }, "a number from -1e100 to 1e100");
    for (std::size_t row = 0; row < numbers.size(); ++row) {
      result.values[place[row].first][c][place[row].second].push_back(numbers[row]);
    }
  }
  const auto& names = table.column_names();
  if (std::find(names.begin(), names.end(), weight_column) != names.end()) {
    result.weights = weights_of(table, run_index, place);
  }
  return result;
}

statistics::Moments GroupedColumns::moments_of(std::size_t sampler, std::size_t column,
                                               std::size_t run) const {
  const auto& of_run = values[sampler][column][run];
  return weights.empty() ? moments(of_run) : moments(of_run, weights[sampler][run]);
}

std::vector<pbox::Ecdf> GroupedColumns::ecdfs(std::size_t sampler, std::size_t column) const {
  std::vector<pbox::Ecdf> all;
  for (std::size_t run = 0; run < values[sampler][column].size(); ++run) {
    const auto& of_run = values[sampler][column][run];
    all.push_back(weights.empty() ? pbox::Ecdf(of_run) : pbox::Ecdf(of_run, weights[sampler][run]));
  }
  return all;
}

GroupedColumns read_samples(const io::CsvTable& table, const std::vector<std::string>& names,
                            const std::string& expected) {
  GroupedColumns all = read_samples(table);
  GroupedColumns chosen{all.samplers, names, {}, all.weights};
  chosen.values.resize(all.samplers.size());
  for (const auto& name : names) {
    const auto found = std::find(all.columns.begin(), all.columns.end(), name);
    if (found == all.columns.end()) {
      throw io::InputError(
          fmt::format("{}: no column '{}': expected {}", table.path().string(), name, expected));
    }
    for (std::size_t s = 0; s < all.samplers.size(); ++s) {
      chosen.values[s].push_back(all.values[s][static_cast<std::size_t>(found - all.columns.begin())]);
    }
  }
  return chosen;
}

const std::vector<std::string>& estimated_quantities() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& parameter : parameter_columns) {
      all.push_back("mean_" + parameter);
      all.push_back("sd_" + parameter);
    }
    all.emplace_back("log_evidence");
    return all;
  }();
  return names;
}

GroupedColumns read_estimates(const std::string& path) {
  const auto table = io::CsvTable::read(path);
  auto estimates = read_samples(table, estimated_quantities(), "the runs of sampling_study");
  require_runs_once(table);
  for (const auto& name : parameter_columns) {
    static_cast<void>(nonnegative_numbers(table, "sd_" + name));
  }
  return estimates;
}

std::vector<std::string> run_columns(bool diagnosed) {
  std::vector<std::string> columns = {"sampler", "run", "iterations", "log_evidence", "evaluations"};
  const auto add = [&](const std::string& prefix) {
    for (const auto& name : parameter_columns) {
      columns.push_back(prefix + name);
    }
  };
  add("mean_");
  add("sd_");
  if (diagnosed) {
    columns.insert(columns.end(), {"bridge_log_evidence", "log_evidence_standard_error"});
    add("effective_sample_size_");
    columns.emplace_back("warnings");
  }
  return columns;
}

std::vector<double> diagnosed_cells(const Run& run) {
  const auto& d = run.result.diagnostics;
  std::vector<double> cells = {run.result.evidence.log_evidence, run.result.evidence.standard_error};
  cells.insert(cells.end(), d.effective_sample_size.begin(), d.effective_sample_size.end());
  cells.push_back(static_cast<double>(d.warnings.size()));
  return cells;
}

std::vector<std::string> sample_columns(bool is_weighted) {
  std::vector<std::string> columns = {"sampler", "run"};
  columns.insert(columns.end(), parameter_columns.begin(), parameter_columns.end());
  if (is_weighted) {
    columns.push_back(weight_column);
  }
  return columns;
}

std::vector<std::string> stage_columns() {
  return {"sampler",
          "run",
          "stage",
          "beta",
          "step",
          "effective_sample_size",
          "coefficient_of_variation",
          "acceptance_rate",
          "log_evidence_increment",
          "feasible",
          "distinct_ancestors",
          "evaluations",
          "redraws"};
}

void write_samples(io::CsvWriter& table, const std::string& sampler, std::size_t index, const Run& run,
                   bool is_weighted) {
  const auto& points = run.result.final.points;
  for (Eigen::Index row = 0; row < points.rows(); ++row) {
    const auto weight = is_weighted ? std::vector<double>{run.result.weights[row]} : std::vector<double>();
    table.row(sampler, index, points(row, 0), points(row, 1), points(row, 2), points(row, 3), weight);
  }
}

void write_run(io::CsvWriter& table, const std::string& sampler, std::size_t index, const Run& run,
               bool diagnosed) {
  table.row(sampler, index, run.iterations(), run.result.final.log_evidence, run.result.final.evaluations,
            tmcmc::as_span(run.mean), tmcmc::as_span(run.standard_deviation),
            diagnosed ? diagnosed_cells(run) : std::vector<double>());
}

void write_stages(io::CsvWriter& table, const std::string& sampler, std::size_t index, const Run& run) {
  for (const auto& s : run.result.stages) {
    table.row(sampler, index, s.stage, s.beta, s.step, s.effective_sample_size, s.coefficient_of_variation,
              s.acceptance_rate, s.log_evidence_increment, s.feasible, s.distinct_ancestors, s.evaluations,
              s.redraws);
  }
}

Diagnoses diagnoses_of(const std::vector<Run>& runs) {
  Diagnoses all{{}, 0.0, std::numeric_limits<double>::infinity(), {}};
  std::vector<double> evidence;
  double squared_errors = 0.0;
  for (const Run& run : runs) {
    evidence.push_back(run.result.evidence.log_evidence);
    squared_errors += run.result.evidence.standard_error * run.result.evidence.standard_error;
    all.smallest_effective_size =
        std::min(all.smallest_effective_size, run.result.diagnostics.effective_sample_size.minCoeff());
    std::set<std::string> kinds;
    for (const auto& warning : run.result.diagnostics.warnings) {
      kinds.insert(tmcmc::describe(warning.kind));
    }
    for (const auto& kind : kinds) {
      ++all.warned[kind];
    }
  }
  all.log_evidence = moments(evidence);
  all.standard_error = std::sqrt(squared_errors / static_cast<double>(runs.size()));
  return all;
}

}  // namespace replication
