#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "io/errors.hpp"
#include "io/files.hpp"

namespace io {

/// A CSV file with a header line, held in memory. The dialect is RFC 4180, read as follows:
///  - lines end in LF or CRLF; a UTF-8 byte order mark and blank lines are skipped;
///  - blanks and tabs around a cell are dropped; inside quotes they are kept;
///  - a quoted cell must end on the line on which it begins;
///  - there are no comments: a line above the header that begins with `#` is refused, unless it is
///    the header itself, as numpy.savetxt writes it: it names as many columns as the next line has
///    cells, and one of these is a number;
///  - a first column without a name holds row numbers or row names (pandas, R) and is ignored;
///  - the separator is the comma and the decimal sign is the point, whatever the locale.
///
/// Every complaint about the file is an InputError with a one-line message, such as
///
///     data/x.csv:4: column 'phase_deg': value 'abc': expected a finite number
///
/// that begins with file and line and, where a cell is at fault, its column: by name, or by number
/// in the header and beyond the header's last column. For files that cannot be read or exceed 4 GiB
/// the message names no line.
class CsvTable {
 public:
  /// Reads the whole file.
  /// \throws InputError if the file cannot be read, has no header or no row; if a column name is
  ///         empty (except that of row numbers or names) or repeated; if a row does not have as
  ///         many cells as the header; if a quote is not closed or stands inside an unquoted cell;
  ///         if the file is UTF-16, holds NUL bytes or a CR without LF, is separated by semicolons
  ///         or tabs, or exceeds 4 GiB.
  static CsvTable read(const std::filesystem::path& path);

  /// The path as given to read().
  const std::filesystem::path& path() const noexcept { return path_; }
  /// Number of rows below the header, at least 1.
  std::size_t rows() const noexcept { return lines_.size(); }
  /// Column names of the header, in the order of the file.
  const std::vector<std::string>& column_names() const noexcept { return names_; }
  /// Whether there is a column of this name.
  bool has(std::string_view column) const noexcept { return places_.find(column) != places_.end(); }
  /// Line of the file, counted from 1, that holds the row.
  /// \throws std::out_of_range if there is no such row.
  std::size_t line(std::size_t row) const { return lines_.at(row); }
  /// One cell, unquoted; valid as long as the table exists.
  /// \throws InputError if there is no such column, std::out_of_range if there is no such row.
  std::string_view cell(std::size_t row, std::string_view column) const;
  /// The number in one cell, as numbers_or_nan reads it; nothing if the cell holds no number.
  /// \throws as cell().
  std::optional<double> find_number(std::size_t row, std::string_view column) const;
  /// Requires these columns; others may exist too.
  /// \throws InputError naming the first column that is missing.
  void require_columns(std::initializer_list<std::string_view> columns) const;

  /// A whole column of finite numbers, one per row (the functions below also return one value per
  /// row). Numbers are decimal, correctly rounded, and may carry a sign; a magnitude that a double
  /// cannot hold (1e400, 1e-400), decimal commas, thousands separators and hexadecimal digits are
  /// refused.
  /// \throws InputError if there is no such column or a cell does not hold such a number.
  std::vector<double> numbers(std::string_view column) const;
  /// As numbers(), with nan, inf and -inf allowed in any case.
  std::vector<double> numbers_or_nan(std::string_view column) const;
  /// A column of whole numbers without point and exponent.
  std::vector<long> integers(std::string_view column) const;
  /// A column of arbitrary text, which may be empty.
  std::vector<std::string> text(std::string_view column) const;

  /// Throws the InputError for a cell that breaks a rule only the caller knows; `expected`
  /// completes the sentence "expected ...".
  [[noreturn]] void fail(std::size_t row, std::string_view column, std::string_view expected) const;

 private:
  struct Line {
    std::string_view text = {};
    std::size_t number = 0;
  };
  CsvTable() = default;
  void parse(std::string_view bytes);
  void parse_header(const Line& line);
  void parse_row(const Line& line);
  void parse_line(const Line& line, std::vector<std::string>& cells) const;
  void require_text(const Line& part, std::size_t place) const;
  std::string column_label(std::size_t place) const;
  [[noreturn]] void complain(std::size_t line, std::string_view column, std::string_view found,
                             std::string_view expected) const;
  std::size_t place_of(std::string_view column) const;
  template <class Value, class Parser>
  std::vector<Value> parsed_column(std::string_view column, Parser parser) const;

  std::filesystem::path path_;
  std::vector<std::string> names_;
  // column number of each name
  std::map<std::string, std::size_t, std::less<>> places_;
  // cells of a line, including the row name
  std::size_t width_ = 0;
  // in a first column without a header name
  bool has_row_names_ = false;
  std::size_t header_line_ = 0;
  // row by row
  std::vector<std::string> cells_;
  std::vector<std::size_t> lines_;
};

/// Shortest decimal text that reads back as the same double; "nan" (without sign), "inf", "-inf".
std::string format_number(double value);

/// Writes a CSV file that CsvTable reads back exactly. Nothing appears under the path before
/// commit().
class CsvWriter {
 public:
  /// Opens the output ("-" is standard output) and writes the header.
  /// \throws OutputError if it cannot be opened; std::logic_error if there is no column or a name
  ///         is empty or repeated.
  CsvWriter(const std::filesystem::path& path, const std::vector<std::string>& columns);

  /// Writes one row: each argument is a number, a text, or a range of doubles or texts that fills
  /// several cells. Doubles are written by format_number. Texts are quoted where necessary; a text
  /// with a line break in it is valid RFC 4180, but CsvTable refuses it.
  /// \throws OutputError; std::logic_error if the number of cells differs from the number of
  ///         columns: such a row leaves no trace. a row leaves no trace.
  template <class... Cells>
  void row(const Cells&... cells) {
    (append(cells), ...);
    end_row();
  }

  /// See OutputFile::prepare.
  void prepare() { file_.prepare(); }
  /// Puts the finished file in place; see OutputFile::commit.
  void commit() { file_.commit(); }
  /// See OutputFile::in_place.
  [[nodiscard]] bool in_place() const noexcept { return file_.in_place(); }

 private:
  template <class Cell>
  void append(const Cell& cell) {
    if constexpr (std::is_convertible_v<const Cell&, std::string_view>) {
      append_field(quoted(cell));
    } else if constexpr (std::is_same_v<Cell, double>) {
      append_field(format_number(cell));
    } else if constexpr (std::is_integral_v<Cell>) {
      static_assert(!std::is_same_v<Cell, bool> && !std::is_same_v<Cell, char>, "not a number");
      append_field(std::to_string(cell));
    } else {
      for (const auto& part : cell) append(part);
    }
  }
  static std::string quoted(std::string_view text);
  void append_field(std::string_view field);
  void end_row();

  OutputFile file_;
  std::size_t columns_;
  std::size_t cells_in_row_ = 0;
  std::string row_;
};

}  // namespace io
