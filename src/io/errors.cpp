#include "io/errors.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace io {
namespace {

// Length of the printable UTF-8 character at the start of the text, 0 if it has to be escaped.
std::size_t printable_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  if (lead < 0x80U) return lead >= 0x20U && lead != 0x7FU ? 1 : 0;
  const std::size_t length = lead < 0xC2U || lead >= 0xF5U ? 0 : lead < 0xE0U ? 2 : lead < 0xF0U ? 3 : 4;
  if (length == 0 || text.size() < length) return 0;
  for (const char c : text.substr(1, length - 1)) {
    if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) return 0;
  }
  const bool is_c1_control = lead == 0xC2U && static_cast<unsigned char>(text[1]) < 0xA0U;
  const bool is_line_separator = text.starts_with("\u2028") || text.starts_with("\u2029");
  return is_c1_control || is_line_separator ? 0 : length;
}

std::string escape(char c) {
  return c == '\n'   ? "\\n"
         : c == '\t' ? "\\t"
         : c == '\r' ? "\\r"
                     : fmt::format("\\x{:02X}", static_cast<unsigned char>(c));
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
    const std::string piece = length > 0 ? std::string(text.substr(0, length)) : escape(text[0]);
    if (out.size() + piece.size() > max_bytes) return out + "...";
    out += piece;
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string printable_path(const std::filesystem::path& path) {
  return printable(path.string(), std::string::npos);
}

}  // namespace io
