/// \file
/// Values and table rows of a document, taken from CSV files as a list of them says, so that no number is typed by hand.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "io/csv.hpp"

namespace report {

/// Where the files of a list are: "generated/x.csv" is x.csv in the directory of the root "generated".
using Roots = std::map<std::string, std::filesystem::path>;

/// LaTeX definitions `\reportvalue{KEY}{TEX}`, one a line, in the order of the list.
///
/// The list has the columns
///  - key: lower-case letters, digits and hyphens; not repeated;
///  - file: ROOT/NAME.csv; empty for a value derived from two above;
///  - where: conditions COLUMN=TEXT, COLUMN=BEGINNING* or COLUMN!=TEXT, separated by semicolons, that a row must meet;
///    empty: every row;
///  - column: the column of the value, or FIRST - SECOND for the difference of two; for a derived value, two keys
///    separated by a blank;
///  - statistic: `value` (the one row that meets the conditions), count, sum, mean, sd (N-1), min, max, max_abs, median,
///    q025 or q975 of the rows that do; for a derived one `sum`, `difference`, `product`, `ratio` (first by second) or
///    `less` (the text yes or no);
///  - format: as format_tex; or `text` (the cell as it stands), `name` (the cell as `\columnname{CELL}`), both with
///    `value` alone.
/// Derived values use the numbers before rounding.
/// \throws io::InputError naming file, line, column and value, for the list or for a file that it names.
[[nodiscard]] std::string tex_values(const io::CsvTable& list, const Roots& roots);

/// LaTeX definitions `\reporttable{KEY}{ROWS}`, ROWS being the cells joined by `&`, each row closed by `\\`.
///
/// The list has the columns key, file and where as above, and columns: blank-separated NAME or NAME:FORMAT, one for each
/// column of the table. A cell that is not a finite number becomes a dash unless its format is `text` or `name`.
/// \throws io::InputError as tex_values.
[[nodiscard]] std::string tex_tables(const io::CsvTable& list, const Roots& roots);

}  // namespace report
