#include "io/csv_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <vector>

#include "io/errors.hpp"

namespace io::csv_text {
namespace {

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

std::string_view unquoted(std::string_view cell) {
  const bool is_quoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
  return is_quoted ? cell.substr(1, cell.size() - 2) : cell;
}

/// The cells of a line, with their quotes.
std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> cells;
  bool quoted = false;
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && text[i] == '"') quoted = !quoted;
    if (i == text.size() || (text[i] == ',' && !quoted)) {
      cells.push_back(trimmed(text.substr(begin, i - begin)));
      begin = i + 1;
    }
  }
  return cells;
}

}  // namespace

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view without_leading_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  return text;
}

std::string_view trimmed(std::string_view text) {
  text = without_leading_blanks(text);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string quoted_value(std::string_view text) {
  return fmt::format("value '{}'", printable(text));
}

bool has_outside_quotes(std::string_view text, char wanted) {
  bool quoted = false;
  for (const char c : text) {
    if (c == '"') quoted = !quoted;
    if (c == wanted && !quoted) return true;
  }
  return false;
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
  const std::string_view complaint =
      parse_value(text, value, expected, "a finite number within the range of a double");
  return complaint.empty() && !std::isfinite(value) ? expected : complaint;
}

std::string_view parse_integer(std::string_view text, long& value) {
  return parse_value(text, value, "an integer", "an integer of at most 64 bits");
}

bool is_row_below(std::string_view comment, std::string_view line) {
  const auto cells = split(line);
  double ignored = 0.0;
  return cells.size() == split(comment).size() &&
         std::any_of(cells.begin(), cells.end(), [&](std::string_view cell) {
           return parse_any_double(unquoted(cell), ignored).empty();
         });
}

}  // namespace io::csv_text
