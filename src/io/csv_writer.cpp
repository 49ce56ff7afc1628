#include <fmt/format.h>

#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <charconv>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "io/csv.hpp"

namespace io {
namespace {

// A byte order mark at the start of the file is not read as text.
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
  if (std::isnan(value)) return "nan";
  std::array<char, 32> digits;
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end};
}

CsvWriter::CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns)
    : file_((checked(columns), path)), columns_(columns.size()) {
  row(columns);
}

std::string CsvWriter::quoted(std::string_view text) {
  return needs_quotes(text) ? fmt::format("\"{}\"", boost::replace_all_copy(std::string(text), "\"", "\"\""))
                            : std::string(text);
}

void CsvWriter::append_field(std::string_view field) {
  if (cells_in_row_++ > 0) row_ += ',';
  row_ += field;
}

void CsvWriter::end_row() {
  const std::size_t found = std::exchange(cells_in_row_, 0);
  const std::string line = std::exchange(row_, {}) + '\n';
  if (found != columns_) {
    throw std::logic_error(fmt::format("io::CsvWriter: {}: row of {} cells, expected {}",
                                       file_.path().string(), found, columns_));
  }
  file_.write(line);
}

}  // namespace io
