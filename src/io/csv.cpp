#include "io/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/csv_text.hpp"

namespace io {

using namespace csv_text;

CsvTable CsvTable::read(const std::filesystem::path& path) {
  CsvTable table;
  table.path_ = path;
  const std::string bytes = bytes_of(path);
  table.parse(bytes);
  return table;
}

void CsvTable::complain(std::size_t line, std::string_view column, std::string_view found,
                        std::string_view expected) const {
  throw InputError({path_, line, std::string(column), std::string(found), std::string(expected)});
}

void CsvTable::parse(std::string_view bytes) {
  for (const std::string_view mark : {"\xFF\xFE", "\xFE\xFF"}) {
    if (bytes.starts_with(mark)) complain(1, "1", quoted_value(mark), "UTF-8 text, not UTF-16");
  }
  bytes.remove_prefix(bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0);  // byte order mark
  Line comment;                                                    // above the header
  const auto refuse_comment = [&] {
    complain(comment.number, "1", quoted_value(fmt::format("# {}", comment.text)),
             "the header, without lines that begin with # above it");
  };
  for (std::size_t number = 1; !bytes.empty(); ++number) {
    const std::size_t newline = std::min(bytes.find('\n'), bytes.size());
    std::string_view text = bytes.substr(0, newline);
    bytes.remove_prefix(std::min(newline + 1, bytes.size()));
    text.remove_suffix(text.ends_with('\r') ? 1 : 0);
    const Line line{without_leading_blanks(text), number};
    if (line.text.empty()) continue;
    if (width_ > 0) {
      parse_row(line);
    } else if (comment.number > 0) {
      if (!is_row_below(comment.text, text)) refuse_comment();
      parse_header(comment);
      parse_row(line);
    } else if (line.text.starts_with('#')) {
      require_text(line, 0);
      comment = {line.text.substr(std::min(line.text.find_first_not_of("# \t"), line.text.size())), number};
    } else {
      parse_header(line);
    }
  }
  if (width_ == 0 && comment.number > 0) refuse_comment();
  if (width_ == 0) complain(1, "", "empty file", "a header line");
  if (lines_.empty()) complain(header_line_, "", "no rows", "at least one row after the header");
}

void CsvTable::parse_header(const Line& line) {
  for (const auto& [separator, name] : {std::pair{';', "semicolons"}, std::pair{'\t', "tabs"}}) {
    if (line.text.find(',') == line.text.npos && split(trimmed(line.text), separator).size() > 1) {
      complain(line.number, "", fmt::format("header '{}'", printable(line.text)),
               fmt::format("columns separated by commas, not by {}", name));
    }
  }
  parse_line(line, names_);
  header_line_ = line.number;
  width_ = names_.size();
  has_row_names_ = names_.front().empty() && width_ > 1;
  for (std::size_t place = has_row_names_ ? 1 : 0; place < width_; ++place) {
    const auto refuse = [&](const char* expected) {
      complain(line.number, fmt::format("{}", place + 1), quoted_value(names_[place]), expected);
    };
    if (names_[place].empty()) {
      refuse(place == 0 ? "a column name" : "a column name, which only row names in a first column may lack");
    }
    if (!places_.emplace(names_[place], place).second) refuse("each column name once");
  }
  if (has_row_names_) names_.erase(names_.begin());
}

void CsvTable::parse_row(const Line& line) {
  parse_line(line, cells_);
  lines_.push_back(line.number);
  if (!has_row_names_) return;
  const std::string& name = cells_[cells_.size() - width_];
  double number = 0.0;
  if (parse_any_double(name, number).empty() && number != std::floor(number)) {
    complain(line.number, "1", quoted_value(name),
             "a row number or a row name, since the column has no name in the header");
  }
}

std::string CsvTable::column_label(std::size_t place) const {
  const std::size_t unnamed = has_row_names_ ? 1 : 0;
  return place < unnamed || place >= width_ ? fmt::format("{}", place + 1)
                                            : fmt::format("'{}'", printable(names_[place - unnamed]));
}

void CsvTable::require_text(const Line& part, std::size_t place) const {
  const auto refuse = [&](const char* expected) {
    complain(part.number, column_label(place), quoted_value(part.text), expected);
  };
  if (part.text.find('\0') != part.text.npos) refuse("UTF-8 text without NUL bytes");
  if (part.text.find('\r') != part.text.npos) refuse("lines that end in LF or CRLF");
}

void CsvTable::parse_line(const Line& line, std::vector<std::string>& cells) const {
  const std::size_t first = cells.size();
  const auto place = [&] { return cells.size() - first; };
  const auto refuse = [&](std::string_view found, std::string_view expected) {
    complain(line.number, column_label(place()), quoted_value(found), expected);
  };
  const auto width_not = [&](std::string_view how_many) {
    return fmt::format("{} cells, as in the header, not {}", width_, how_many);
  };
  std::string_view rest = line.text;
  if (width_ > 0 && rest.starts_with('#')) {
    refuse(rest, fmt::format("{} cells, as in the header, and no comments", width_));
  }
  for (bool has_more = true; has_more;) {
    rest = without_leading_blanks(rest);
    std::string cell;
    std::string_view tail;  // from the comma on
    if (rest.starts_with('"')) {
      std::size_t close = rest.find('"', 1);
      while (close != rest.npos && rest.substr(close + 1).starts_with('"')) close = rest.find('"', close + 2);
      require_text({rest.substr(0, close), line.number}, place());
      if (close == rest.npos) refuse(rest, "a closing quote on the same line");
      tail = without_leading_blanks(rest.substr(close + 1));
      if (!tail.empty() && tail.front() != ',') refuse(rest, "a comma after the closing quote");
      for (std::size_t i = 1; i < close; i += rest[i] == '"' ? 2 : 1) cell += rest[i];
    } else {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      cell = trimmed(rest.substr(0, comma));
      require_text({cell, line.number}, place());
      if (cell.find('"') != cell.npos) refuse(cell, "quotes around the whole cell");
      tail = rest.substr(comma);
    }
    if (width_ > 0 && place() == width_) {
      const bool is_one_more = lines_.empty() && tail.empty() && !cell.empty();
      refuse(cell, width_not(is_one_more ? "more (row names need a column in the header too, and decimals a "
                                           "point)"
                                         : "more"));
    }
    cells.push_back(std::move(cell));
    has_more = !tail.empty();
    rest = has_more ? tail.substr(1) : tail;
  }
  if (place() < width_) {
    complain(line.number, column_label(place()), "missing value", width_not(std::to_string(place())));
  }
}

std::size_t CsvTable::place_of(std::string_view column) const {
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
  const std::size_t place = place_of(column);
  line(row);
  return cells_[row * width_ + place];
}

void CsvTable::fail(std::size_t row, std::string_view column, std::string_view expected) const {
  complain(line(row), fmt::format("'{}'", printable(column)), quoted_value(cell(row, column)), expected);
}

template <class Value, class Parser>
std::vector<Value> CsvTable::parsed_column(std::string_view column, Parser parser) const {
  const std::size_t place = place_of(column);
  std::vector<Value> values(rows());
  for (std::size_t row = 0; row < rows(); ++row) {
    const std::string_view expected = parser(cells_[row * width_ + place], values[row]);
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
  return parsed_column<std::string>(column, [](const std::string& cell_text, std::string& value) {
    value = cell_text;
    return std::string_view();
  });
}

}  // namespace io
