#include "io/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/csv_bytes.hpp"
#include "io/csv_text.hpp"

namespace io {

using namespace csv_text;

namespace {

constexpr std::size_t whole = std::string::npos;

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& path) {
  CsvTable table;
  table.path_ = path;
  table.buffer_ = csv_bytes(path);
  table.parse();
  return table;
}

void CsvTable::complain(std::size_t line, std::string_view column, std::string_view found,
                        std::string_view expected) const {
  throw InputError({path_, line, std::string(column), std::string(found), std::string(expected)});
}

void CsvTable::parse() {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  for (const std::string_view mark : {"\xFF\xFE", "\xFE\xFF"}) {
    if (buffer_.starts_with(mark)) {
      complain(1, "1", quoted_value(mark), "UTF-8 text, not UTF-16");
    }
  }
  std::size_t begin = buffer_.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  std::optional<Line> commented;  // above the header, without the signs of a comment
  const auto refuse_comment = [&](const Line& line) {
    complain(line.number, "1", quoted_value(fmt::format("# {}", view({line.begin, line.end - line.begin}))),
             "the header, without lines that begin with # above it");
  };
  for (std::size_t number = 1; begin < buffer_.size(); ++number) {
    const std::size_t newline = std::min(buffer_.find('\n', begin), buffer_.size());
    const std::size_t end = newline > begin && buffer_[newline - 1] == '\r' ? newline - 1 : newline;
    const std::string_view text = view({begin, end - begin});
    const Line line{begin + (text.size() - without_leading_blanks(text).size()), end, number};
    begin = newline + 1;
    if (line.begin == end) continue;
    if (width_ > 0) {
      parse_row(line);
    } else if (commented) {
      if (!is_row_below(view({commented->begin, commented->end - commented->begin}), text)) {
        refuse_comment(*commented);
      }
      parse_header(*commented);
      parse_row(line);
    } else if (buffer_[line.begin] == '#') {
      require_text(line, 0);
      commented = line;
      while (commented->begin < end &&
             (buffer_[commented->begin] == '#' || is_blank(buffer_[commented->begin]))) {
        ++commented->begin;
      }
    } else {
      parse_header(line);
    }
  }
  if (width_ == 0 && commented) refuse_comment(*commented);
  if (width_ == 0) complain(1, "", "empty file", "a header line");
  if (lines_.empty()) complain(header_line_, "", "no rows", "at least one row after the header");
}

void CsvTable::parse_header(const Line& line) {
  const std::string_view text = view({line.begin, line.end - line.begin});
  for (const auto& [separator, name] : {std::pair{';', "semicolons"}, std::pair{'\t', "tabs"}}) {
    if (text.find(',') == whole && has_outside_quotes(trimmed(text), separator)) {
      complain(line.number, "", fmt::format("header '{}'", printable(text)),
               fmt::format("columns separated by commas, not by {}", name));
    }
  }
  std::vector<Cell> header;
  parse_line(line, header);
  header_line_ = line.number;
  for (std::size_t place = 0; place < header.size(); ++place) {
    const std::string_view name = view(header[place]);
    if (name.empty() && place == 0 && header.size() > 1) {
      has_row_names_ = true;
      continue;
    }
    if (name.empty()) {
      complain(
          line.number, fmt::format("{}", place + 1), "value ''",
          place == 0 ? "a column name" : "a column name, which only row names in a first column may lack");
    }
    if (!places_.emplace(name, place).second) {
      complain(line.number, fmt::format("{}", place + 1), quoted_value(name), "each column name once");
    }
    names_.emplace_back(name);
  }
  width_ = header.size();
}

void CsvTable::parse_row(const Line& line) {
  parse_line(line, cells_);
  lines_.push_back(line.number);
  if (!has_row_names_) return;
  const std::string_view name = view(cells_[cells_.size() - width_]);
  double number = 0.0;
  if (parse_any_double(name, number).empty() && number != std::floor(number)) {
    complain(line.number, "1", quoted_value(name),
             "a row number or a row name, since the column has no name in the header");
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

std::string CsvTable::column_label(std::size_t place) const {
  const std::size_t unnamed = has_row_names_ ? 1 : 0;
  return place < unnamed || place >= width_ ? fmt::format("{}", place + 1)
                                            : fmt::format("'{}'", printable(names_[place - unnamed]));
}

void CsvTable::require_text(const Line& part, std::size_t place) const {
  const std::string_view text = view({part.begin, part.end - part.begin});
  if (text.find('\0') != whole) {
    complain(part.number, column_label(place), quoted_value(text), "UTF-8 text without NUL bytes");
  }
  if (text.find('\r') != whole) {
    complain(part.number, column_label(place), quoted_value(text), "lines that end in LF or CRLF");
  }
}

void CsvTable::parse_line(const Line& line, std::vector<Cell>& cells) {
  const std::size_t begin = line.begin;
  const std::size_t end = line.end;
  const std::size_t number = line.number;
  const std::size_t first_cell = cells.size();
  const auto column = [&] { return column_label(cells.size() - first_cell); };
  const auto value_of = [&](std::size_t from, std::size_t to) {
    return quoted_value(view({from, to - from}));
  };
  const auto refuse_width = [&](const std::string& found, std::string_view how_many) {
    complain(number, column(), found, fmt::format("{} cells, as in the header, not {}", width_, how_many));
  };
  if (width_ > 0 && trimmed(view({begin, end - begin})).starts_with('#')) {
    complain(number, column_label(0), value_of(begin, end),
             fmt::format("{} cells, as in the header, and no comments", width_));
  }
  std::size_t position = begin;
  for (;; ++position) {
    std::size_t from = position;
    while (from < end && is_blank(buffer_[from])) ++from;
    Cell cell{from, 0};
    if (from < end && buffer_[from] == '"') {
      const std::size_t close = closing_quote(from, end);
      require_text({from, close, number}, cells.size() - first_cell);
      if (close == end) complain(number, column(), value_of(from, end), "a closing quote on the same line");
      position = close + 1;
      while (position < end && is_blank(buffer_[position])) ++position;
      if (position < end && buffer_[position] != ',') {
        complain(number, column(), value_of(from, end), "a comma after the closing quote");
      }
      for (std::size_t i = from + 1; i < close; ++i) {
        if (buffer_[i] == '"') ++i;
        buffer_[from + cell.size++] = buffer_[i];
      }
    } else {
      position = from + std::min(view({from, end - from}).find(','), end - from);
      std::size_t stop = position;
      while (stop > from && is_blank(buffer_[stop - 1])) --stop;
      require_text({from, stop, number}, cells.size() - first_cell);
      cell.size = stop - from;
      if (view(cell).find('"') != whole) {
        complain(number, column(), value_of(from, stop), "quotes around the whole cell");
      }
    }
    const std::size_t found = cells.size() - first_cell;
    if (width_ > 0 && found == width_) {
      const bool is_one_more = lines_.empty() && position >= end && cell.size > 0;
      refuse_width(
          quoted_value(view(cell)),
          is_one_more ? "more (row names need a column in the header too, and decimals a point)" : "more");
    }
    cells.push_back(cell);
    if (position >= end) break;
  }
  const std::size_t found = cells.size() - first_cell;
  if (found < width_) refuse_width("missing value", fmt::format("{}", found));
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
    complain(header_line_, "",
             fmt::format("header '{}{}'", has_row_names_ ? "," : "",
                         printable(fmt::format("{}", fmt::join(names_, ",")), 200)),
             fmt::format("a column '{}'{}", printable(column),
                         has_row_names_ ? " (the first one, without a name, is taken for row names)" : ""));
  }
}

std::string_view CsvTable::cell(std::size_t row, std::string_view column) const {
  const std::size_t i = index(column);
  line(row);
  return view(cells_[row * width_ + i]);
}

void CsvTable::fail(std::size_t row, std::string_view column, std::string_view expected) const {
  complain(line(row), fmt::format("'{}'", printable(column)), quoted_value(cell(row, column)), expected);
}

template <class Value, class Parser>
std::vector<Value> CsvTable::parsed_column(std::string_view column, Parser parser) const {
  const std::size_t i = index(column);
  std::vector<Value> values(rows());
  for (std::size_t row = 0; row < rows(); ++row) {
    const std::string_view expected = parser(view(cells_[row * width_ + i]), values[row]);
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

std::optional<double> CsvTable::find_number(std::size_t row, std::string_view column) const {
  double value = 0.0;
  return parse_any_double(cell(row, column), value).empty() ? std::optional(value) : std::nullopt;
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
