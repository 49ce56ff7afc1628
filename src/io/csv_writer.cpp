#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>

#include "io/csv.hpp"

namespace io {
namespace {

constexpr std::size_t longest_number = 32;

template <class Value>
void append_chars(std::string& out, Value value) {
  std::array<char, longest_number> digits;
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  out.append(digits.data(), result.ptr);
}

void append_number(std::string& out, double value) {
  if (std::isnan(value)) {
    out += "nan";
  } else {
    append_chars(out, value);
  }
}

// A byte order mark is no text where it starts the file.
bool starts_with_mark(std::string_view text) {
  return text.starts_with("\xEF\xBB\xBF") || text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
}

bool needs_quotes(std::string_view text) {
  constexpr std::string_view blanks = " \t";
  return text.empty() || starts_with_mark(text) || text.front() == '#' ||
         text.find_first_of(",;\t\"\r\n") != std::string_view::npos ||
         blanks.find(text.front()) != std::string_view::npos ||
         blanks.find(text.back()) != std::string_view::npos;
}

const std::vector<std::string>& checked(const std::vector<std::string>& columns) {
  if (columns.empty()) throw std::logic_error("io::CsvWriter: expected at least one column");
  std::set<std::string_view> seen;
  for (const std::string& column : columns) {
    if (column.empty() || !seen.insert(column).second) {
      throw std::logic_error(fmt::format(
          "io::CsvWriter: column '{}': expected names that are neither empty nor repeated", column));
    }
  }
  return columns;
}

}  // namespace

std::string format_number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : file_((checked(columns), path)), columns_(columns.size()) {
  for (const std::string& column : columns) append(std::string_view(column));
  end_row();
}

void CsvWriter::separate() {
  if (cells_in_row_++ > 0) row_ += ',';
}

void CsvWriter::append(double value) {
  separate();
  append_number(row_, value);
}

void CsvWriter::append_signed(long long value) {
  separate();
  append_chars(row_, value);
}

void CsvWriter::append_unsigned(unsigned long long value) {
  separate();
  append_chars(row_, value);
}

void CsvWriter::append(std::string_view value) {
  separate();
  if (!needs_quotes(value)) {
    row_ += value;
    return;
  }
  row_ += '"';
  for (const char c : value) {
    if (c == '"') row_ += '"';
    row_ += c;
  }
  row_ += '"';
}

void CsvWriter::append(std::span<const std::string> texts) {
  for (const std::string& text : texts) {
    append(std::string_view(text));
  }
}

void CsvWriter::append(std::span<const double> values) {
  for (const double value : values) append(value);
}

void CsvWriter::end_row() {
  const std::size_t found = cells_in_row_;
  cells_in_row_ = 0;
  if (found != columns_) {
    row_.clear();
    throw std::logic_error(fmt::format("io::CsvWriter: {}: row of {} cells, expected {}",
                                       file_.path().string(), found, columns_));
  }
  row_ += '\n';
  file_.write(row_);
  row_.clear();
}

}  // namespace io
