/// \file
/// Bytes, lines and cells of CSV files, and the numbers in them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace io::csv_text {

/// All bytes of the file or pipe, up to and including the first block that holds a NUL: the parser
/// refuses that byte and names its place, and a source of zeros has no end.
/// \throws InputError, naming the file, if it cannot be read, is a directory or exceeds 4 GiB.
[[nodiscard]] std::string bytes_of(const std::filesystem::path& path);

/// The text without spaces and tabs at its beginning.
[[nodiscard]] std::string_view without_leading_blanks(std::string_view text);
/// The text without spaces and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// The text quoted for a message, as "value '...'".
[[nodiscard]] std::string quoted_value(std::string_view text);
/// The parts between separators that are not in quotes, trimmed, with their quotes.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);
/// Whether the line has as many cells as the comment above it has names, and one of the cells is a
/// number.
[[nodiscard]] bool is_row_below(std::string_view comment, std::string_view line);

/// Parses a double and sets the value; returns what was expected, or nothing if the text is valid.
/// nan and inf are valid.
[[nodiscard]] std::string_view parse_any_double(std::string_view text, double& value);
/// As parse_any_double, for finite numbers only.
[[nodiscard]] std::string_view parse_finite(std::string_view text, double& value);
/// As parse_any_double, for whole numbers without point and exponent.
[[nodiscard]] std::string_view parse_integer(std::string_view text, long& value);

}  // namespace io::csv_text
