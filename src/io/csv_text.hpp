/// \file
/// Cells and lines of CSV files as text, and the numbers in them.
#pragma once

#include <string>
#include <string_view>

namespace io::csv_text {

/// Space or tab.
bool is_blank(char c);
std::string_view without_leading_blanks(std::string_view text);  ///< the rest of the text
/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

/// The text in a message, as "value '...'".
std::string quoted_value(std::string_view text);

bool has_outside_quotes(std::string_view text, char wanted);  ///< whether the mark separates cells

/// Whether the line is a row of as many cells as the comment above it names, and one of them is a number.
bool is_row_below(std::string_view comment, std::string_view line);

/// Each parser sets the value and returns what was expected, or nothing if the text fits.
std::string_view parse_any_double(std::string_view text, double& value);
std::string_view parse_finite(std::string_view text, double& value);  ///< neither nan nor inf
std::string_view parse_integer(std::string_view text, long& value);   ///< no point, no exponent

}  // namespace io::csv_text
