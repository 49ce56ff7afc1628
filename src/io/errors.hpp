#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace io {

/// What is wrong with an input, and where.
struct InputFault {
  /// The input file.
  std::filesystem::path path = {};
  /// Line of the file, counted from 1; 0 if the fault concerns the whole file.
  std::size_t line = 0;
  /// Name of the column in quotes, or its number; empty if no column is at fault.
  std::string column = {};
  /// What was found, in printable form, such as "value 'abc'" or "no rows".
  std::string found = {};
  /// Completes the sentence "expected ...".
  std::string expected = {};
};

/// The fault as one line, such as "x.csv:4: column 'phase_deg': value 'abc': expected a finite
/// number".
std::string describe(const InputFault& fault);

/// An error that the user can correct: a missing file, a bad value, an unknown option. what() is
/// one line that names the file, the place, the value and what was expected. A program that ends
/// with this error exits with status 2.
class InputError : public std::runtime_error {
 public:
  /// An error that belongs to no place in a file.
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  /// An error with its place; what() is describe(fault).
  explicit InputError(InputFault fault) : std::runtime_error(describe(fault)), fault_(std::move(fault)) {}
  /// The parts of the message; the path is empty if there is only the message.
  [[nodiscard]] const InputFault& fault() const noexcept { return fault_; }

 private:
  InputFault fault_;
};

/// An output that cannot be written. what() is one line with the path, the system's reason and what
/// was expected. A program that ends with this error exits with status 2.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The text made safe for a one-line message: control characters and bytes that are not UTF-8
/// become escapes (\n, \t, \r, \x1B), and everything after the first `max_bytes` bytes becomes
/// "...".
std::string printable(std::string_view text, std::size_t max_bytes = 40);

/// The whole path, made safe in the same way as printable() does.
std::string printable_path(const std::filesystem::path& path);

}  // namespace io
