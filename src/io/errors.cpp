#include "io/errors.hpp"

#include <fmt/format.h>

namespace io {
namespace {

bool is_continuation(char c) {
  return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
}

// Length of the printable character at the start of the text, 0 if it has to be escaped.
std::size_t printable_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80U) return lead >= 0x20U && lead != 0x7FU ? 1 : 0;
  const std::size_t length = lead >= 0xF5U   ? 0
                             : lead >= 0xF0U ? 4
                             : lead >= 0xE0U ? 3
                             : lead >= 0xC2U ? 2
                                             : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if (!is_continuation(text[i])) return 0;
  }
  const bool is_c1_control = lead == 0xC2U && static_cast<unsigned char>(text[1]) < 0xA0U;
  const bool is_line_separator = text.starts_with("\u2028") || text.starts_with("\u2029");
  return is_c1_control || is_line_separator ? 0 : length;
}

}  // namespace

std::string describe(const InputFault& fault) {
  return fmt::format("{}{}{}: {}: expected {}", printable_path(fault.path),
                     fault.line > 0 ? fmt::format(":{}", fault.line) : "",
                     fault.column.empty() ? "" : ": column " + fault.column, fault.found, fault.expected);
}

std::string printable(std::string_view text, std::size_t max_bytes) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = printable_length(text);
    std::string piece;
    if (length > 0) {
      piece = text.substr(0, length);
    } else if (text[0] == '\n') {
      piece = "\\n";
    } else if (text[0] == '\t') {
      piece = "\\t";
    } else if (text[0] == '\r') {
      piece = "\\r";
    } else {
      piece = fmt::format("\\x{:02X}", static_cast<unsigned char>(text[0]));
    }
    if (out.size() + piece.size() > max_bytes) return out + "...";
    out += piece;
    text.remove_prefix(length > 0 ? length : 1);
  }
  return out;
}

std::string printable_path(const std::filesystem::path& path) {
  return printable(path.string(), std::string::npos);
}

}  // namespace io
