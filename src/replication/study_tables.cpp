#include "replication/study_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/algorithm/string/split.hpp>
#include <cmath>
#include <set>

#include "errors/invalid_value.hpp"
#include "replication/columns.hpp"

namespace replication {

namespace {

constexpr long largest_study = 4294967295;  // of the random streams, 2^32 - 1
constexpr long most_printed_runs = 10000;   // each is drawn many times over
constexpr long least_studies = 3;           // of a sampler, for a null distribution
constexpr double most_ordinary = 1e100;     // sums and squares do not overflow

bool is_ordinary(double x) {
  return x >= 1.0 / most_ordinary && x <= most_ordinary;
}

std::string without_plus_and_spaces(std::string_view text) {
  const auto first = text.find_first_not_of(" \t+");
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

/// \throws io::InputError unless every study has each sampler of the file exactly once.
void require_same_samplers(const io::CsvTable& table, const std::vector<long>& studies,
                           const std::vector<std::string>& samplers) {
  std::vector<std::pair<long, std::string_view>> pairs;
  std::map<long, std::size_t> rows_of;
  for (std::size_t row = 0; row < studies.size(); ++row) {
    pairs.emplace_back(studies[row], samplers[row]);
    ++rows_of[studies[row]];
  }
  require_once(table, pairs, "sampler", "each sampler once a study");
  const std::set<std::string_view> names(samplers.begin(), samplers.end());
  for (std::size_t row = 0; row < studies.size(); ++row) {
    const std::size_t found = rows_of[studies[row]];
    if (found != names.size()) {
      table.fail(row, "study",
                 fmt::format("a row of each sampler ({}), not {} of {}",
                             io::printable(fmt::to_string(fmt::join(names, ", "))), found, names.size()));
    }
  }
}

}  // namespace

std::string study_header() {
  std::string text = "study,sampler";
  for (const char* quantity : {"area_", "mean_", "standard_error_", "smallest_", "largest_"}) {
    for (const auto& name : parameter_columns) {
      text += fmt::format(",{}{}", quantity, name);
    }
  }
  return text + ",log_evidence_mean,log_evidence_sd,iterations";
}

std::string study_line(const StudySummary& s) {
  std::string text = fmt::format("{},{}", s.study, s.sampler);
  const auto add = [&](double value) { text += ',' + io::format_number(value); };
  for (const auto* values : {&s.areas, &s.means, &s.standard_errors, &s.smallest, &s.largest}) {
    std::for_each(values->begin(), values->end(), add);
  }
  add(s.log_evidence_mean);
  add(s.log_evidence_sd);
  return text + ',' + format_iterations(s.iterations);
}

std::vector<double> study_column(const std::vector<std::string>& lines, const std::string& sampler,
                                 std::size_t column) {
  std::vector<double> values;
  for (const auto& line : lines) {
    std::vector<std::string> cells;
    boost::split(cells, line, [](char c) { return c == ','; });
    if (cells.at(1) == sampler) {
      values.push_back(std::stod(cells.at(column)));
    }
  }
  return values;
}

std::vector<StudySummary> read_studies(const std::string& path) {
  const auto table = io::CsvTable::read(path);
  const auto numbers = checked(
      table, "study", table.integers("study"), [](long n) { return n >= 0 && n <= largest_study; },
      "a whole number from 0 to 2^32 - 1");
  const auto samplers = table.text("sampler");
  require_same_samplers(table, numbers, samplers);
  const auto iterations = table.text("iterations");
  const auto evidence_mean = table.numbers("log_evidence_mean");
  const auto evidence_sd = nonnegative_numbers(table, "log_evidence_sd");
  std::vector<StudySummary> studies(table.rows());
  for (std::size_t row = 0; row < studies.size(); ++row) {
    auto& s = studies[row];
    s.study = static_cast<std::uint32_t>(numbers[row]);
    s.sampler = samplers[row];
    s.log_evidence_mean = evidence_mean[row];
    s.log_evidence_sd = evidence_sd[row];
    try {
      s.iterations = parse_iterations(iterations[row]);
    } catch (const errors::InvalidValue& error) {
      table.fail(row, "iterations", error.expected());
    }
  }
  const auto any_numbers = [](const io::CsvTable& from, std::string_view column) {
    return from.numbers(column);
  };
  const auto fill = [&](const std::string& prefix, std::vector<double> StudySummary::*member, auto read) {
    for (const auto& name : parameter_columns) {
      const auto values = read(table, prefix + name);
      for (std::size_t row = 0; row < studies.size(); ++row) {
        (studies[row].*member).push_back(values[row]);
      }
    }
  };
  fill("area_", &StudySummary::areas, positive_numbers);
  fill("mean_", &StudySummary::means, any_numbers);
  fill("standard_error_", &StudySummary::standard_errors, nonnegative_numbers);
  fill("smallest_", &StudySummary::smallest, any_numbers);
  fill("largest_", &StudySummary::largest, any_numbers);
  return studies;
}

PrintedTables read_printed_tables(const std::string& table3, const std::string& table4) {
  PrintedTables printed;
  const auto areas = io::CsvTable::read(table3);
  const auto samplers = areas.text("sampler");
  require_once(areas, samplers, "sampler", "each sampler once");
  for (const std::size_t parameter :
       {std::size_t{friction::friction_force}, std::size_t{friction::natural_frequency}}) {
    const auto& column = parameter_columns[parameter];
    static_cast<void>(
        checked(areas, column, areas.numbers(column), is_ordinary, "a number from 1e-100 to 1e100"));
    for (std::size_t row = 0; row < samplers.size(); ++row) {
      printed.areas.push_back({samplers[row], parameter, without_plus_and_spaces(areas.cell(row, column))});
    }
  }
  printed.counts_path = table4;
  const auto counts = io::CsvTable::read(table4);
  const auto iterations = positive_integers(counts, "iterations");
  require_once(counts, iterations, "iterations", "each number of iterations once");
  for (std::size_t row = 0; row < samplers.size(); ++row) {
    if (samplers[row] == "iterations" || !counts.has(samplers[row])) {
      areas.fail(row, "sampler", fmt::format("the name of a column of {}", table4));
    }
  }
  for (const auto& sampler : counts.column_names()) {
    if (sampler == "iterations") {
      continue;
    }
    if (std::find(samplers.begin(), samplers.end(), sampler) == samplers.end()) {
      throw io::InputError(
          fmt::format("{}: column 'sampler': no row '{}': expected one for each sampler of {}", table3,
                      io::printable(sampler), table4));
    }
    const auto runs = checked(
        counts, sampler, counts.integers(sampler), [](long n) { return n >= 0 && n <= most_printed_runs; },
        "a number of runs from 0 to 10000");
    if (std::all_of(runs.begin(), runs.end(), [](long n) { return n == 0; })) {
      counts.fail(0, sampler, "at least one run in the column");
    }
    PrintedCounts column{sampler, {}};
    for (std::size_t row = 0; row < runs.size(); ++row) {
      column.counts[iterations[row]] = runs[row];
    }
    printed.counts.push_back(column);
  }
  return printed;
}

std::vector<StudySummary> read_studies(const std::string& path, const PrintedTables& printed) {
  auto studies = read_studies(path);
  for (const auto& column : printed.counts) {
    const auto count = std::count_if(studies.begin(), studies.end(),
                                     [&](const auto& s) { return s.sampler == column.sampler; });
    if (count == 0) {
      throw io::InputError(fmt::format(
          "{}: column 'sampler': no row '{}': expected studies of each sampler of the printed tables", path,
          io::printable(column.sampler)));
    }
    if (count < least_studies) {
      throw io::InputError(fmt::format("{}: column 'sampler': {} rows '{}': expected at least {} studies",
                                       path, count, io::printable(column.sampler), least_studies));
    }
  }
  return studies;
}

Null null_of(const std::vector<StudySummary>& studies, const PrintedTables& printed) {
  if (printed.counts.size() != 2) {
    throw io::InputError(fmt::format("{}: {} columns of counts: expected those of two samplers",
                                     printed.counts_path, printed.counts.size()));
  }
  return null_of(studies, printed.counts[0].sampler, printed.counts[1].sampler, 1);
}

}  // namespace replication
