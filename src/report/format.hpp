/// \file
/// Numbers and texts of CSV files as LaTeX. The rounding of a document is stated here, once.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace report {

/// A number is rounded to so many significant digits unless its format says otherwise.
constexpr int significant_digits = 3;

/// A format that is none of those below, or a number that it does not fit.
class FormatError : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Text with the characters special to LaTeX escaped, and the symbols that plain text spells out (F_mu, omega_n, N_eff,
/// chi^2, CoV^2) set as mathematics.
[[nodiscard]] std::string escape_tex(std::string_view text);

/// A number for text or mathematics. With significant digits, a magnitude below 1e-4 or of at least 1e6 becomes a power of
/// ten; five digits and more before the point are grouped by thin spaces.
/// \param format  "": `significant_digits` of them; "sK": K significant digits; "fK": K digits after the point;
///                "percent" or "percentK": 100 times the number, rounded as "" or "sK"; "integer": must be one
/// \throws FormatError
[[nodiscard]] std::string format_tex(double value, std::string_view format);

}  // namespace report
