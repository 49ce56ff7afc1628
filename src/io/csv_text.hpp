/// \file
/// Bytes, lines and cells of CSV files, and the numbers in them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace io::csv_text {

/// All bytes of the file or pipe, up to and with the first block that holds a NUL: the parser
/// refuses that byte with its place, and a source of zeros has no end.
/// \throws InputError naming the file, if it cannot be read, is a directory or has more than 4 GiB.
[[nodiscard]] std::string bytes_of(const std::filesystem::path& path);

/// The rest of the text behind spaces and tabs.
[[nodiscard]] std::string_view without_leading_blanks(std::string_view text);
/// Without spaces and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);
/// The text in a message, as "value '...'".
[[nodiscard]] std::string quoted_value(std::string_view text);
/// What stands between the separators that are not in quotes, trimmed, with its quotes.
[[nodiscard]] std::vector<std::string_view> split(std::string_view text, char separator);
/// Whether the line has as many cells as the comment above it has names, and one of them is a
/// number.
[[nodiscard]] bool is_row_below(std::string_view comment, std::string_view line);

/// Sets the value and returns what was expected, or nothing if the text fits; nan and inf fit.
[[nodiscard]] std::string_view parse_any_double(std::string_view text, double& value);
/// The same of finite numbers only.
[[nodiscard]] std::string_view parse_finite(std::string_view text, double& value);
/// The same of numbers without point and exponent.
[[nodiscard]] std::string_view parse_integer(std::string_view text, long& value);

}  // namespace io::csv_text
