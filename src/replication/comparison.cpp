#include "replication/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "friction/angle.hpp"
#include "replication/columns.hpp"

namespace replication {

namespace {

/// Numbers of one kind in each of the null studies of a sampler, ascending.
template <class Number>
std::vector<double> sorted_numbers(const std::vector<StudySummary>& studies, const std::string& sampler,
                                   Null null, Number number) {
  std::vector<double> values;
  for (const auto& s : null_studies(studies, sampler, null)) {
    values.push_back(number(s));
  }
  std::sort(values.begin(), values.end());
  return values;
}

void place_count(ComparedCell& cell, const std::vector<StudySummary>& studies, Null null) {
  const tmcmc::Index iterations = std::stol(cell.row);
  const auto values = sorted_numbers(studies, cell.column, null, [&](const StudySummary& s) {
    const auto found = s.iterations.find(iterations);
    return found == s.iterations.end() ? 0.0 : static_cast<double>(found->second);
  });
  cell.median = sample_quantile(values, 0.5);
  cell.interval = {sample_quantile(values, 0.025), sample_quantile(values, 0.975)};
}

std::string blank_if_nan(double value, const char* format) {
  return std::isnan(value) ? "" : fmt::format(fmt::runtime(format), value);
}

/// The position of the cell among replicated studies, as far as it is known.
std::string place_of(const ComparedCell& cell) {
  std::string text;
  if (!std::isnan(cell.median)) {
    text +=
        fmt::format("studies {:.4g} ({:.4g} to {:.4g})", cell.median, cell.interval.low, cell.interval.high);
  }
  if (!std::isnan(cell.printed_percentile)) {
    text += fmt::format(", percentiles {:.1f} and {:.1f}", cell.printed_percentile, cell.our_percentile);
  }
  if (!std::isnan(cell.p.value)) {
    text +=
        fmt::format("{}p = {:.2g} +- {:.1g}", text.empty() ? "" : ", ", cell.p.value, cell.p.standard_error);
  }
  return text + (cell.verdict.empty() ? "" : ": " + cell.verdict);
}

std::string row_of(const std::string& table, const std::string& what, const std::string& printed,
                   const std::string& ours, const ComparedCell& c) {
  const std::string spread = std::isnan(c.median) ? ""
                                                  : fmt::format("{:.4g} ({:.4g} to {:.4g})", c.median,
                                                                c.interval.low, c.interval.high);
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.2g} ± {:.1g} | {} |\n", table, what, printed,
                     blank_if_nan(c.printed_percentile, "{:.1f}"), ours,
                     blank_if_nan(c.our_percentile, "{:.1f}"), spread, c.p.value, c.p.standard_error,
                     c.verdict);
}

/// Text such as "TMCMC 6, 44, 0; TMCMC-II 5, 36, 9" for the cells of Table 4.
std::string counts_in_words(const std::vector<ComparedCell>& cells, double ComparedCell::*number) {
  std::vector<std::string> samplers;
  std::string text;
  for (const auto& c : cells) {
    if (c.table == "Table 4" && std::find(samplers.begin(), samplers.end(), c.column) == samplers.end()) {
      samplers.push_back(c.column);
    }
  }
  for (const auto& sampler : samplers) {
    std::vector<double> values;
    for (const auto& c : cells) {
      if (c.table == "Table 4" && c.column == sampler) {
        values.push_back(c.*number);
      }
    }
    text += fmt::format("{}{} {:g}", text.empty() ? "" : "; ", sampler, fmt::join(values, ", "));
  }
  return text;
}

std::string rows_of_table4(const std::vector<ComparedCell>& cells) {
  std::vector<std::string> rows;
  for (const auto& c : cells) {
    if (c.table == "Table 4" && std::find(rows.begin(), rows.end(), c.row) == rows.end()) {
      rows.push_back(c.row);
    }
  }
  return fmt::format("{} iterations", fmt::join(rows, ", "));
}

}  // namespace

void compare(std::vector<ComparedCell>& cells, const std::string& name, const std::string& key,
             const std::vector<std::string>& columns, const io::CsvTable& printed, const io::CsvTable& ours,
             double missing) {
  struct Source {
    std::map<std::string, std::size_t> rows;
    std::map<std::string, std::vector<double>> numbers;
  };
  const auto source = [&](const io::CsvTable& table) {
    const auto own_keys = table.text(key);
    require_once(table, own_keys, key, "each value once");
    Source result;
    for (std::size_t row = 0; row < own_keys.size(); ++row) {
      result.rows.emplace(own_keys[row], row);
    }
    for (const auto& column : columns) {
      result.numbers[column] = table.numbers(column);
    }
    return result;
  };
  const Source of_printed = source(printed);
  const Source of_ours = source(ours);
  auto keys = printed.text(key);
  for (const auto& k : ours.text(key)) {
    if (of_printed.rows.count(k) == 0) {
      keys.push_back(k);
    }
  }
  const auto value = [&](const Source& in, const std::string& column, const std::string& k) {
    const auto found = in.rows.find(k);
    return found == in.rows.end() ? missing : in.numbers.at(column)[found->second];
  };
  for (const auto& k : keys) {
    for (const auto& column : columns) {
      cells.push_back({.table = name,
                       .row = k,
                       .column = column,
                       .printed = value(of_printed, column, k),
                       .ours = value(of_ours, column, k)});
    }
  }
}

void compare_bounds(std::vector<ComparedCell>& cells, const tmcmc::Prior& printed, const tmcmc::Prior& ours) {
  for (std::size_t j = 0; j < parameter_columns.size(); ++j) {
    const auto row = static_cast<Eigen::Index>(j);
    const auto add = [&](const char* bound, double printed_bound, double our_bound) {
      cells.push_back({.table = "Table 2",
                       .row = parameter_columns[j],
                       .column = bound,
                       .printed = printed_bound,
                       .ours = our_bound});
    };
    add("lower", printed.lower()[row], ours.lower()[row]);
    add("upper", printed.upper()[row], ours.upper()[row]);
  }
}

double difference(const ComparedCell& cell) {
  return cell.column == "phase_deg" ? friction::angle_residual_deg(cell.ours, cell.printed)
                                    : cell.ours - cell.printed;
}

void place_among_studies(std::vector<ComparedCell>& cells, const std::vector<StudySummary>& studies,
                         const std::vector<PrintedArea>& areas, const std::vector<PrintedCounts>& counts,
                         Null null, const std::vector<std::string>& parameters) {
  const auto verdicts = judge_areas(studies, areas, null);
  for (ComparedCell& cell : cells) {
    for (const auto& v : verdicts) {
      if (cell.table == "Table 3" && cell.row == v.sampler && cell.column == parameters.at(v.parameter)) {
        cell.median = v.median;
        cell.interval = v.interval;
        cell.printed_percentile = v.percentile;
        const auto values = sorted_numbers(studies, v.sampler, null,
                                           [&](const StudySummary& s) { return s.areas.at(v.parameter); });
        cell.our_percentile = percentile(values, cell.ours);
        cell.p = v.p;
        cell.verdict = name_of(v.number);
      }
    }
    if (cell.table == "Table 4") {
      place_count(cell, studies, null);
    }
  }
  const auto joint = test_jointly(studies, printed_columns(areas, counts), null);
  const auto add = [&](const std::string& row, const PValue& p, bool judged) {
    ComparedCell cell{"joint", row, "both"};
    cell.p = p;
    cell.verdict = judged ? name_of(judge_number(p)) : "";
    cells.push_back(cell);
  };
  add("areas", joint.areas, true);
  add("counts", joint.counts, true);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    add(counts[i].sampler, joint.columns[i], false);
  }
  add("all", joint.all, true);
}

std::string comparison_text(const std::vector<ComparedCell>& cells) {
  std::string text;
  std::string table;
  for (const ComparedCell& cell : cells) {
    if (cell.table != table) {
      table = cell.table;
      text += fmt::format("\n{}\n  {:<24} {:<22} {:>12} {:>12} {:>12}  {}\n", table, "row", "column",
                          "printed", "ours", "difference", "among replicated studies");
    }
    const std::string place = place_of(cell);
    text += fmt::format("  {:<24} {:<22} {:>12} {:>12} {:>12}{}{}\n", cell.row, cell.column,
                        blank_if_nan(cell.printed, "{:.5g}"), blank_if_nan(cell.ours, "{:.5g}"),
                        blank_if_nan(difference(cell), "{:+.3g}"), place.empty() ? "" : "  ", place);
  }
  return text;
}

std::string comparison_markdown(const std::vector<ComparedCell>& cells) {
  std::string text =
      "| table | what | printed | percentile | ours | percentile | median (95 %) of the studies | p | "
      "compatible "
      "with one sampler? |\n|---|---|---:|---:|---:|---:|---:|---:|---|\n";
  for (const auto& c : cells) {
    if (c.table == "Table 3") {
      text += row_of(c.table, c.row + ", " + c.column, fmt::format("{:.4g}", c.printed),
                     fmt::format("{:.4g}", c.ours), c);
    }
    if (c.table == "joint" && c.row == "counts") {
      text += row_of("Table 4", rows_of_table4(cells), counts_in_words(cells, &ComparedCell::printed),
                     counts_in_words(cells, &ComparedCell::ours), c);
    }
  }
  for (const auto& c : cells) {
    if (c.table == "joint" && c.row != "counts") {
      const std::string what = c.row == "areas" ? "all areas of Table 3"
                               : c.row == "all" ? "**all printed numbers**"
                                                : c.row + ": areas and iterations";
      text += row_of("jointly", what, "", "", c);
    }
  }
  return text;
}

}  // namespace replication
