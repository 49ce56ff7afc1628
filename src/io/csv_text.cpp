#include "io/csv_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "io/errors.hpp"

namespace io::csv_text {
namespace {

constexpr std::string_view blanks = " \t";

template <class Value>
std::string_view parse_value(std::string_view text, Value& value, std::string_view expected,
                             std::string_view expected_range) {
  text = trimmed(text);
  if (text.starts_with('+')) {
    text.remove_prefix(1);
    if (text.starts_with('-')) return expected;
  }
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (stop != end || error == std::errc::invalid_argument) return expected;
  return error == std::errc::result_out_of_range ? expected_range : std::string_view();
}

}  // namespace

std::string_view without_leading_blanks(std::string_view text) {
  return text.substr(std::min(text.find_first_not_of(blanks), text.size()));
}

std::string_view trimmed(std::string_view text) {
  text = without_leading_blanks(text);
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::string quoted_value(std::string_view text) {
  return fmt::format("value '{}'", printable(text));
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> cells;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i == text.size() || (text[i] == separator && !quoted)) {
      cells.push_back(trimmed(text.substr(begin, i - begin)));
      begin = i + 1;
    } else if (text[i] == '"') {
      quoted = !quoted;
    }
  }
  return cells;
}

bool is_row_below(std::string_view comment, std::string_view line) {
  const auto cells = split(line, ',');
  return cells.size() == split(comment, ',').size() &&
         std::any_of(cells.begin(), cells.end(), [](std::string_view cell) {
           const bool is_quoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
           double ignored = 0.0;
           return parse_any_double(is_quoted ? cell.substr(1, cell.size() - 2) : cell, ignored).empty();
         });
}

std::string_view parse_any_double(std::string_view text, double& value) {
  if (text.find(',') != text.npos) return "a number with a decimal point, not a comma";
  constexpr std::string_view expected = "a number, nan or inf";
  if (text.find('(') != text.npos) return expected;  // nan(payload)
  return parse_value(text, value, expected, "a number within the range of a double");
}

std::string_view parse_finite(std::string_view text, double& value) {
  if (text.find(',') != text.npos) return "a finite number with a decimal point, not a comma";
  constexpr std::string_view expected = "a finite number";
  const auto complaint = parse_value(text, value, expected, "a finite number within the range of a double");
  return complaint.empty() && !std::isfinite(value) ? expected : complaint;
}

std::string_view parse_integer(std::string_view text, long& value) {
  return parse_value(text, value, "an integer", "an integer of at most 64 bits");
}

}  // namespace io::csv_text
