#include "report/values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "replication/verdict.hpp"
#include "report/format.hpp"

namespace report {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) {
    const auto begin = part.find_first_not_of(' ');
    if (begin != std::string::npos) {
      parts.push_back(part.substr(begin, part.find_last_not_of(' ') - begin + 1));
    }
  }
  return parts;
}

/// The files of a list, each read once.
class Files {
 public:
  Files(const io::CsvTable& list, const Roots& roots) : list_(list), roots_(roots) {}

  const io::CsvTable& at(std::size_t row) {
    const std::string name(list_.cell(row, "file"));
    const auto slash = name.find('/');
    const auto root = roots_.find(name.substr(0, slash));
    if (slash == std::string::npos || root == roots_.end()) {
      list_.fail(row, "file", "ROOT/NAME.csv with a known root");
    }
    const auto known = tables_.find(name);
    return known != tables_.end()
               ? known->second
               : tables_.emplace(name, io::CsvTable::read(root->second / name.substr(slash + 1)))
                     .first->second;
  }

 private:
  const io::CsvTable& list_;
  const Roots& roots_;
  std::map<std::string, io::CsvTable> tables_;
};

/// COLUMN=TEXT, COLUMN=BEGINNING* or COLUMN!=TEXT; nullopt if the condition has another form.
std::optional<bool> meets(const io::CsvTable& table, std::size_t row, const std::string& condition) {
  const auto equals = condition.find('=');
  if (equals == std::string::npos || equals == 0) {
    return std::nullopt;
  }
  const bool negated = condition[equals - 1] == '!';
  const std::string_view cell = table.cell(row, condition.substr(0, negated ? equals - 1 : equals));
  const std::string text = condition.substr(equals + 1);
  return text.ends_with('*') ? negated != cell.starts_with(text.substr(0, text.size() - 1))
                             : negated != (cell == text);
}

/// Rows of the file that meet the conditions in row `row` of the list; at least one.
std::vector<std::size_t> matching_rows(const io::CsvTable& list, std::size_t row, const io::CsvTable& table) {
  std::vector<std::size_t> rows;
  const auto conditions = split(std::string(list.cell(row, "where")), ';');
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const bool all = std::all_of(conditions.begin(), conditions.end(), [&](const std::string& condition) {
      const auto met = meets(table, i, condition);
      if (!met) {
        list.fail(row, "where", "COLUMN=TEXT, COLUMN=BEGINNING* or COLUMN!=TEXT, separated by semicolons");
      }
      return *met;
    });
    if (all) {
      rows.push_back(i);
    }
  }
  if (rows.empty()) {
    list.fail(row, "where", fmt::format("conditions that a row of {} meets", table.path().string()));
  }
  return rows;
}

std::string checked_key(const io::CsvTable& list, std::size_t row) {
  std::string key(list.cell(row, "key"));
  if (key.empty() || key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") != std::string::npos) {
    list.fail(row, "key", "lower-case letters, digits and hyphens");
  }
  for (std::size_t i = 0; i < row; ++i) {
    if (list.cell(i, "key") == key) {
      list.fail(row, "key", fmt::format("a key that line {} has not taken", list.line(i)));
    }
  }
  return key;
}

/// nullopt: no such statistic. The numbers are not empty.
std::optional<double> statistic(const std::string& name, std::vector<double> numbers) {
  const double count = static_cast<double>(numbers.size());
  double sum = 0.0, max_abs = 0.0;
  for (const double x : numbers) {
    sum += x;
    max_abs = std::max(max_abs, std::fabs(x));
  }
  if (name == "count") return count;
  if (name == "sum") return sum;
  if (name == "mean") return sum / count;
  if (name == "max_abs") return max_abs;
  if (name == "sd") {
    double squares = 0.0;
    for (const double x : numbers) {
      squares += (x - sum / count) * (x - sum / count);
    }
    return std::sqrt(squares / (count - 1.0));
  }
  std::sort(numbers.begin(), numbers.end());
  if (name == "min") return numbers.front();
  if (name == "max") return numbers.back();
  if (name == "median") return replication::sample_quantile(numbers, 0.5);
  if (name == "q025") return replication::sample_quantile(numbers, 0.025);
  if (name == "q975") return replication::sample_quantile(numbers, 0.975);
  return std::nullopt;
}

std::string formatted(const io::CsvTable& list, std::size_t row, const char* column, double value,
                      std::string_view format) {
  try {
    return format_tex(value, format);
  } catch (const FormatError& error) {
    const std::string what = error.what();
    list.fail(row, column, what.starts_with("expected ") ? what.substr(9) : what);
  }
}

std::optional<std::string> formatted_text(std::string_view cell, std::string_view format) {
  if (format == "text") return escape_tex(cell);
  if (format == "name") return fmt::format("\\columnname{{{}}}", cell);
  return std::nullopt;
}

/// Values so far: key and number, nan for a text.
using Numbers = std::map<std::string, double>;

std::string derived(const io::CsvTable& list, std::size_t row, const std::string& key, Numbers& numbers) {
  const auto operands = split(std::string(list.cell(row, "column")), ' ');
  if (operands.size() != 2 || !numbers.contains(operands[0]) || !numbers.contains(operands[1])) {
    list.fail(row, "column", "two keys of lines above, separated by a blank");
  }
  const double a = numbers[operands[0]], b = numbers[operands[1]];
  const std::string operation(list.cell(row, "statistic"));
  if (operation == "less" && std::isfinite(a) && std::isfinite(b)) {
    numbers[key] = std::nan("");
    return a < b ? "yes" : "no";
  }
  const std::map<std::string, double> results = {
      {"sum", a + b}, {"difference", a - b}, {"product", a * b}, {"ratio", a / b}};
  const auto result = results.find(operation);
  if (result == results.end()) {
    list.fail(row, "statistic", "sum, difference, product, ratio or less, of numbers");
  }
  numbers[key] = result->second;
  return formatted(list, row, "format", result->second, list.cell(row, "format"));
}

std::vector<double> finite_numbers(const io::CsvTable& table, const std::vector<std::size_t>& rows,
                                   const std::string& column) {
  const auto all = table.numbers_or_nan(column);
  std::vector<double> numbers;
  for (const std::size_t i : rows) {
    if (!std::isfinite(all[i])) {
      table.fail(i, column, "a finite number");
    }
    numbers.push_back(all[i]);
  }
  return numbers;
}

std::string from_file(const io::CsvTable& list, std::size_t row, const io::CsvTable& table,
                      const std::string& key, Numbers& numbers) {
  const auto rows = matching_rows(list, row, table);
  const std::string name(list.cell(row, "statistic")), column(list.cell(row, "column"));
  const std::string_view format = list.cell(row, "format");
  if (name == "value") {
    if (rows.size() != 1) {
      list.fail(row, "where", fmt::format("conditions that one row meets, not {}", rows.size()));
    }
    if (const auto text = formatted_text(table.cell(rows[0], column), format)) {
      numbers[key] = std::nan("");
      return *text;
    }
  }
  std::vector<double> chosen(name == "count" ? rows.size() : 0);
  if (name != "count") {
    const auto minus = column.find(" - ");
    chosen = finite_numbers(table, rows, column.substr(0, minus));
    if (minus != std::string::npos) {
      const auto subtracted = finite_numbers(table, rows, column.substr(minus + 3));
      for (std::size_t i = 0; i < chosen.size(); ++i) {
        chosen[i] -= subtracted[i];
      }
    }
  }
  const auto value = name == "value" ? chosen[0] : statistic(name, chosen);
  if (!value) {
    list.fail(row, "statistic", "value, count, sum, mean, sd, min, max, max_abs, median, q025 or q975");
  }
  numbers[key] = *value;
  return formatted(list, row, "format", *value, format);
}

}  // namespace

std::string tex_values(const io::CsvTable& list, const Roots& roots) {
  list.require_columns({"key", "file", "where", "column", "statistic", "format"});
  Files files(list, roots);
  Numbers numbers;
  std::string tex;
  for (std::size_t row = 0; row < list.rows(); ++row) {
    const std::string key = checked_key(list, row);
    const std::string value = list.cell(row, "file").empty()
                                  ? derived(list, row, key, numbers)
                                  : from_file(list, row, files.at(row), key, numbers);
    tex += fmt::format("\\reportvalue{{{}}}{{{}}}\n", key, value);
  }
  return tex;
}

std::string tex_tables(const io::CsvTable& list, const Roots& roots) {
  list.require_columns({"key", "file", "where", "columns"});
  Files files(list, roots);
  std::string tex;
  for (std::size_t row = 0; row < list.rows(); ++row) {
    const std::string key = checked_key(list, row);
    const io::CsvTable& table = files.at(row);
    const auto columns = split(std::string(list.cell(row, "columns")), ' ');
    if (columns.empty()) {
      list.fail(row, "columns", "names of columns");
    }
    std::string body;
    for (const std::size_t i : matching_rows(list, row, table)) {
      std::string line;
      for (const auto& column : columns) {
        const auto colon = column.find(':');
        const std::string name = column.substr(0, colon);
        const std::string format = colon == std::string::npos ? "" : column.substr(colon + 1);
        auto cell = formatted_text(table.cell(i, name), format);
        if (!cell) {
          const double value = table.numbers_or_nan(name)[i];
          cell = std::isfinite(value) ? formatted(list, row, "columns", value, format) : "--";
        }
        line += line.empty() ? *cell : " & " + *cell;
      }
      body += fmt::format("{} \\\\\n", line);
    }
    tex += fmt::format("\\reporttable{{{}}}{{%\n{}}}\n", key, body);
  }
  return tex;
}

}  // namespace report
