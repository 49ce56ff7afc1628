/// \file
/// The exception for a refused value: it names the field, the value and what was expected.
#pragma once

#include <charconv>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace errors {

/// A value that a library function refuses. The exception carries the parts of the message, so that
/// a caller who knows more (the file, the line, the column, the command-line option) can say where
/// the value stands without parsing what().
class InvalidValue : public std::invalid_argument {
 public:
  /// \param field     name of the field as the library calls it, such as "options.samples"
  /// \param value     the value as text; empty if there is none
  /// \param expected  completes the sentence "expected ..."
  InvalidValue(std::string field, std::string value, std::string expected)
      : std::invalid_argument(field + (value.empty() ? "" : " = " + value) + ": expected " + expected),
        field_(std::move(field)),
        value_(std::move(value)),
        expected_(std::move(expected)) {}

  /// As the constructor above, for a number, which is written with the fewest digits from which it
  /// can be read back.
  template <class Number>
  requires std::is_arithmetic_v<Number> InvalidValue(std::string field, Number value, std::string expected)
      : InvalidValue(std::move(field), text_of(value), std::move(expected)) {}

  /// Name of the field as the library calls it.
  [[nodiscard]] const std::string& field() const noexcept { return field_; }
  /// The value as text; empty if there is none.
  [[nodiscard]] const std::string& value() const noexcept { return value_; }
  /// What was expected, without the word "expected".
  [[nodiscard]] const std::string& expected() const noexcept { return expected_; }

 private:
  template <class Number>
  static std::string text_of(Number value) {
    char digits[32];
    const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
    return error == std::errc() ? std::string(digits, end) : std::to_string(value);
  }

  std::string field_;
  std::string value_;
  std::string expected_;
};

}  // namespace errors
