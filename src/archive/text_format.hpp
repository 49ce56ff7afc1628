/// \file
/// Lines "name = value", and tables "name: rows" with a line of numbers a row; internal to archive.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/csv.hpp"

namespace archive {

/// Ends a complaint about a file that only a new start can replace.
inline constexpr std::string_view start_again = "(delete it to start again)";

/// Builds the text of a file in memory.
class Writer {
 public:
  /// The line that says what kind of file it is.
  explicit Writer(std::string_view first_line) : text_(fmt::format("{}\n", first_line)) {}

  /// A line `name = value`; numbers in the shortest digits that read back as the same.
  void line(std::string_view name, std::string_view value) { text_ += fmt::format("{} = {}\n", name, value); }
  /// \copydoc line
  void line(std::string_view name, double value) { line(name, io::format_number(value)); }
  /// \copydoc line
  void line(std::string_view name, std::integral auto value) { line(name, std::to_string(value)); }

  /// Announces a table of so many rows.
  void table(std::string_view name, std::size_t rows) { text_ += fmt::format("{}: {}\n", name, rows); }
  /// A whole table, a line a row.
  template <class Number>
  void table(std::string_view name, const std::vector<std::vector<Number>>& rows) {
    table(name, rows.size());
    for (const auto& numbers : rows) {
      for (const Number number : numbers) {
        cell(number);
      }
      end_row();
    }
  }
  /// A number in the present row, behind a space if it is not the first.
  void cell(double value) { text_ += io::format_number(value) + ' '; }
  /// \copydoc cell
  void cell(std::integral auto value) { text_ += std::to_string(value) + ' '; }
  /// Ends the row; it may be empty.
  void end_row() {
    if (text_.back() == ' ') {
      text_.pop_back();
    }
    text_ += '\n';
  }

  /// All that was written.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Reads lines in the order in which they were written. Whatever does not fit is an io::InputError that names the file.
class Reader {
 public:
  /// Both have to live as long as the reader.
  Reader(const std::filesystem::path& path, std::string_view text) : path_(path), left_(text) {}

  /// \throws io::InputError with the path, what is wrong, and how to start again.
  [[noreturn]] void fail(std::string_view what) const {
    throw io::InputError(fmt::format("{}: {} {}", path_.string(), what, start_again));
  }

  /// What stands behind the name and the separator in the next line.
  std::string_view value(std::string_view name, std::string_view separator = " = ") {
    next_line();
    if (!line_.starts_with(name) || !line_.substr(name.size()).starts_with(separator)) {
      fail(fmt::format("line '{}': expected '{}{}'", io::printable(line_), name, separator));
    }
    return line_.substr(name.size() + separator.size());
  }
  /// The number in the next line, which has this name.
  template <class Number>
  void read(std::string_view name, Number& number) {
    line_ = value(name);
    cell(number);
    end_row();
  }
  /// The number of rows that a table announces.
  std::size_t table(std::string_view name) {
    std::size_t rows = 0;
    line_ = value(name, ": ");
    cell(rows);
    end_row();
    return rows;
  }
  /// A whole table, added to the rows.
  template <class Number>
  void table(std::string_view name, std::vector<std::vector<Number>>& rows) {
    for (std::size_t left = table(name); left > 0; --left) {
      rows.emplace_back();
      for (next_line(); !line_.empty();) {
        cell(rows.back().emplace_back());
      }
    }
  }

  /// Goes to the next line.
  void next_line() {
    const auto end = left_.find('\n');
    if (end == std::string_view::npos) {
      fail("ends early: expected further lines");
    }
    line_ = left_.substr(0, end);
    left_.remove_prefix(end + 1);
  }
  /// The next cell of the line.
  template <class Number>
  void cell(Number& number) {
    const auto text = line_.substr(0, line_.find(' '));
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || stop != text.data() + text.size()) {
      fail(fmt::format("value '{}': expected a number", io::printable(text)));
    }
    line_.remove_prefix(std::min(text.size() + 1, line_.size()));
  }
  /// Fails if the line has further cells.
  void end_row() const {
    if (!line_.empty()) {
      fail(fmt::format("'{}': expected the end of the line", io::printable(line_)));
    }
  }
  /// Fails if the file has further lines.
  void end() const {
    if (!left_.empty()) {
      fail("goes on after its last table: expected the checksum");
    }
  }

 private:
  const std::filesystem::path& path_;
  std::string_view left_;
  std::string_view line_;  // what is left of it
};

}  // namespace archive
