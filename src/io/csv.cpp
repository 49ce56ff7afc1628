#include "io/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "io/csv_bytes.hpp"

namespace io {
namespace {

constexpr std::size_t whole = std::string::npos;

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

bool has_outside_quotes(std::string_view text, char wanted) {
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (c == wanted && !quoted) return true;
  }
  return false;
}

bool drop_plus(std::string_view& text) {
  if (!text.starts_with('+')) return true;
  text.remove_prefix(1);
  return !text.starts_with('-') && !text.starts_with('+');
}

// Each parser returns what was expected, or nothing if the text fits.
template <class Value>
std::string_view parse_value(std::string_view text, Value& value, std::string_view expected,
                             std::string_view expected_range) {
  text = trimmed(text);
  if (!drop_plus(text)) return expected;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) return expected;
  return error == std::errc::result_out_of_range ? expected_range : std::string_view();
}

std::string_view parse_any_double(std::string_view text, double& value) {
  if (text.find(',') != whole) return "a number with a decimal point, not a comma";
  constexpr std::string_view expected = "a number, nan or inf";
  if (text.find('(') != whole) return expected;  // nan(payload)
  return parse_value(text, value, expected, "a number within the range of a double");
}

std::string_view parse_finite(std::string_view text, double& value) {
  if (text.find(',') != whole) return "a finite number with a decimal point, not a comma";
  constexpr std::string_view expected = "a finite number";
  const std::string_view complaint =
      parse_value(text, value, expected, "a finite number within the range of a double");
  return complaint.empty() && !std::isfinite(value) ? expected : complaint;
}

std::string_view parse_integer(std::string_view text, long& value) {
  return parse_value(text, value, "an integer", "an integer of at most 64 bits");
}

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& path) {
  CsvTable table;
  table.path_ = path;
  table.buffer_ = csv_bytes(path);
  table.parse();
  return table;
}

void CsvTable::parse() {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  for (const std::string_view mark : {"\xFF\xFE", "\xFE\xFF"}) {
    if (buffer_.starts_with(mark)) {
      throw InputError(fmt::format("{}:1: column 1: value '{}': expected UTF-8 text, not UTF-16",
                                   printable_path(path_), printable(mark)));
    }
  }
  std::size_t begin = buffer_.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  for (std::size_t line = 1; begin < buffer_.size(); ++line) {
    const std::size_t newline = std::min(buffer_.find('\n', begin), buffer_.size());
    const std::size_t end = newline > begin && buffer_[newline - 1] == '\r' ? newline - 1 : newline;
    const std::string_view text = view({begin, end - begin});
    const bool blank = std::all_of(text.begin(), text.end(), is_blank);
    if (!blank && names_.empty()) {
      parse_header(begin, end, line);
    } else if (!blank) {
      parse_line(begin, end, line, cells_);
      lines_.push_back(line);
    }
    begin = newline + 1;
  }
  if (names_.empty())
    throw InputError(fmt::format("{}:1: empty file: expected a header line", printable_path(path_)));
  if (lines_.empty()) {
    throw InputError(fmt::format("{}:{}: no rows: expected at least one row after the header",
                                 printable_path(path_), header_line_));
  }
}

void CsvTable::parse_header(std::size_t begin, std::size_t end, std::size_t line) {
  const std::string_view text = view({begin, end - begin});
  for (const auto& [separator, name] : {std::pair{';', "semicolons"}, std::pair{'\t', "tabs"}}) {
    if (text.find(',') == whole && has_outside_quotes(trimmed(text), separator)) {
      throw InputError(fmt::format("{}:{}: header '{}': expected columns separated by commas, not by {}",
                                   printable_path(path_), line, printable(text), name));
    }
  }
  std::vector<Cell> header;
  parse_line(begin, end, line, header);
  header_line_ = line;
  for (const Cell cell : header) {
    const std::string_view name = view(cell);
    if (name.empty()) {
      throw InputError(fmt::format("{}:{}: column {}: value '': expected a column name",
                                   printable_path(path_), line, names_.size() + 1));
    }
    if (!places_.emplace(name, names_.size()).second) {
      throw InputError(fmt::format("{}:{}: column {}: value '{}': expected each column name once",
                                   printable_path(path_), line, names_.size() + 1, printable(name)));
    }
    names_.emplace_back(name);
  }
}

std::size_t CsvTable::closing_quote(std::size_t open, std::size_t end) const {
  std::size_t i = open + 1;
  for (; i < end; ++i) {
    if (buffer_[i] != '"') continue;
    if (i + 1 == end || buffer_[i + 1] != '"') return i;
    ++i;
  }
  return end;
}

void CsvTable::parse_line(std::size_t begin, std::size_t end, std::size_t line, std::vector<Cell>& cells) {
  const std::size_t first_cell = cells.size();
  const auto complain = [&](std::string_view value, std::string_view expected) {
    const std::size_t column = cells.size() - first_cell;
    const std::string name = column < names_.size() ? fmt::format("'{}'", printable(names_[column]))
                                                    : fmt::format("{}", column + 1);
    throw InputError(
        fmt::format("{}:{}: column {}: {}: expected {}", printable_path(path_), line, name, value, expected));
  };
  const auto value_of = [&](std::size_t from, std::size_t to) {
    return fmt::format("value '{}'", printable(view({from, to - from})));
  };
  const auto require_text = [&](std::size_t from, std::size_t to) {
    const std::string_view text = view({from, to - from});
    if (text.find('\0') != whole) complain(value_of(from, to), "UTF-8 text without NUL bytes");
    if (text.find('\r') != whole) complain(value_of(from, to), "lines that end in LF or CRLF");
  };
  std::size_t position = begin;
  for (;; ++position) {
    std::size_t start = position;
    while (start < end && is_blank(buffer_[start])) ++start;
    Cell cell{start, 0};
    if (start < end && buffer_[start] == '"') {
      const std::size_t close = closing_quote(start, end);
      require_text(start, close);
      if (close == end) complain(value_of(start, end), "a closing quote on the same line");
      position = close + 1;
      while (position < end && is_blank(buffer_[position])) ++position;
      if (position < end && buffer_[position] != ',') {
        complain(value_of(start, end), "a comma after the closing quote");
      }
      for (std::size_t i = start + 1; i < close; ++i) {
        if (buffer_[i] == '"') ++i;
        buffer_[start + cell.size++] = buffer_[i];
      }
    } else {
      position = start + std::min(view({start, end - start}).find(','), end - start);
      std::size_t stop = position;
      while (stop > start && is_blank(buffer_[stop - 1])) --stop;
      require_text(start, stop);
      cell.size = stop - start;
      if (view(cell).find('"') != whole) complain(value_of(start, stop), "quotes around the whole cell");
    }
    const std::size_t found = cells.size() - first_cell;
    if (!names_.empty() && found == names_.size()) {
      complain(fmt::format("value '{}'", printable(view(cell))),
               fmt::format("{} cells, as in the header, not more", names_.size()));
    }
    cells.push_back(cell);
    if (position >= end) break;
  }
  const std::size_t found = cells.size() - first_cell;
  if (found < names_.size()) {
    complain("missing value", fmt::format("{} cells, as in the header, not {}", names_.size(), found));
  }
}

bool CsvTable::has(std::string_view column) const noexcept {
  return places_.find(column) != places_.end();
}

std::size_t CsvTable::index(std::string_view column) const {
  require_columns({column});
  return places_.find(column)->second;
}

void CsvTable::require_columns(std::initializer_list<std::string_view> columns) const {
  for (const std::string_view column : columns) {
    if (has(column)) continue;
    throw InputError(fmt::format("{}:{}: header '{}': expected a column '{}'", printable_path(path_),
                                 header_line_, printable(fmt::format("{}", fmt::join(names_, ",")), 200),
                                 printable(column)));
  }
}

std::string_view CsvTable::cell(std::size_t row, std::string_view column) const {
  const std::size_t i = index(column);
  line(row);
  return view(cells_[row * names_.size() + i]);
}

void CsvTable::fail(std::size_t row, std::string_view column, std::string_view expected) const {
  throw InputError(fmt::format("{}:{}: column '{}': value '{}': expected {}", printable_path(path_),
                               line(row), printable(column), printable(cell(row, column)), expected));
}

template <class Value, class Parser>
std::vector<Value> CsvTable::parsed_column(std::string_view column, Parser parser) const {
  const std::size_t i = index(column);
  std::vector<Value> values(rows());
  for (std::size_t row = 0; row < rows(); ++row) {
    const std::string_view expected = parser(view(cells_[row * names_.size() + i]), values[row]);
    if (!expected.empty()) fail(row, column, expected);
  }
  return values;
}

std::vector<double> CsvTable::numbers(std::string_view column) const {
  return parsed_column<double>(column, parse_finite);
}

std::vector<double> CsvTable::numbers_or_nan(std::string_view column) const {
  return parsed_column<double>(column, parse_any_double);
}

double CsvTable::number_or_nan(std::size_t row, std::string_view column) const {
  double value = 0.0;
  const std::string_view expected = parse_any_double(cell(row, column), value);
  if (!expected.empty()) fail(row, column, expected);
  return value;
}

std::vector<long> CsvTable::integers(std::string_view column) const {
  return parsed_column<long>(column, parse_integer);
}

std::vector<std::string> CsvTable::text(std::string_view column) const {
  return parsed_column<std::string>(column, [](std::string_view cell_text, std::string& value) {
    value = cell_text;
    return std::string_view();
  });
}

}  // namespace io
