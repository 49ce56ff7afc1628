#include "report/format.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace report {
namespace {

constexpr int lowest_plain_exponent = -4;  // smaller numbers, and those from 10^6 on, are powers of ten
constexpr int highest_plain_exponent = 5;

using Replacement = std::pair<std::string_view, std::string_view>;

// The longer first where one begins another.
constexpr std::array<Replacement, 18> replacements = {
    Replacement{"F_mu", R"($F_\mu$)"},
    {"omega_n", R"($\omega_n$)"},
    {"N_eff", R"($N_\mathrm{eff}$)"},
    {"chi^2", R"($\chi^2$)"},
    {"CoV^2", R"($\mathrm{CoV}^2$)"},
    {"\\", R"(\textbackslash{})"},
    {"{", R"(\{)"},
    {"}", R"(\})"},
    {"$", R"(\$)"},
    {"&", R"(\&)"},
    {"#", R"(\#)"},
    {"%", R"(\%)"},
    {"_", R"(\_)"},
    {"^", R"(\textasciicircum{})"},
    {"~", R"(\textasciitilde{})"},
    {"<", R"(\textless{})"},
    {">", R"(\textgreater{})"},
    {"\"", R"(\textquotedbl{})"},
};

/// K of "sK"; `otherwise` if the text is empty.
int digits_of(std::string_view text, std::string_view format, int otherwise) {
  if (text.empty()) {
    return otherwise;
  }
  int digits = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), digits);
  if (error != std::errc{} || end != text.data() + text.size() || digits < 0 || digits > 15) {
    throw FormatError(fmt::format("expected 0 to 15 digits in the format '{}'", format));
  }
  return digits;
}

/// "-31000.5" -> "-31\,000.5"
std::string group_thousands(std::string text) {
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  const std::size_t point = std::min(text.find('.'), text.size());
  if (point - first < 5) {
    return text;
  }
  for (std::size_t at = point; at > first + 3;) {
    at -= 3;
    text.insert(at, "\\,");
  }
  return text;
}

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) {
    text.erase(0, 1);  // a negative number that rounds to 0
  }
  const std::string grouped = group_thousands(text);
  return text.starts_with('-') ? fmt::format("\\ensuremath{{{}}}", grouped) : grouped;
}

std::string significant(double value, int digits) {
  if (digits == 0) {
    throw FormatError("expected at least one significant digit");
  }
  if (value == 0.0) {
    return fixed(0.0, 0);
  }
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(e + 1));
  if (exponent < lowest_plain_exponent || exponent > highest_plain_exponent) {
    return fmt::format("\\ensuremath{{{}\\times10^{{{}}}}}", scientific.substr(0, e), exponent);
  }
  return fixed(value, std::max(0, digits - 1 - exponent));
}

}  // namespace

std::string escape_tex(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    std::string_view found = text.substr(0, 1);
    std::string_view with = found;
    for (const auto& [plain, tex] : replacements) {
      if (text.starts_with(plain)) {
        found = plain;
        with = tex;
        break;
      }
    }
    result += with;
    text.remove_prefix(found.size());
  }
  return result;
}

std::string format_tex(double value, std::string_view format) {
  if (!std::isfinite(value)) {
    throw FormatError("expected a finite number");
  }
  constexpr std::string_view percent = "percent";
  if (format == "integer") {
    if (value != std::floor(value) || std::fabs(value) > 1e15) {
      throw FormatError("expected an integer for the format 'integer'");
    }
    return fixed(value, 0);
  }
  if (format.starts_with(percent)) {
    return significant(100.0 * value, digits_of(format.substr(percent.size()), format, significant_digits));
  }
  if (format.empty()) {
    return significant(value, significant_digits);
  }
  if (format.size() > 1 && format.front() == 's') {
    return significant(value, digits_of(format.substr(1), format, significant_digits));
  }
  if (format.size() > 1 && format.front() == 'f') {
    return fixed(value, digits_of(format.substr(1), format, significant_digits));
  }
  throw FormatError("expected the format text, name, integer, percent, percentK, sK, fK or none");
}

}  // namespace report
