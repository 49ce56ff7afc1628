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
  /// The file.
  std::filesystem::path path = {};
  /// Line of the file, from 1; 0 if the fault is one of the whole file.
  std::size_t line = 0;
  /// Name of the column in quotes, or its number; empty if no column is to blame.
  std::string column = {};
  /// What was found, printable, such as "value 'abc'" or "no rows".
  std::string found = {};
  /// Completes the sentence "expected ...".
  std::string expected = {};
};

/// The fault as one line, such as "x.csv:4: column 'phase_deg': value 'abc': expected a finite
/// number".
std::string describe(const InputFault& fault);

/// Something the user can mend: a missing file, a bad value, an unknown option. what() is one line
/// that names the file, the place, the value and what was expected. A program that ends with it
/// exits with status 2.
class InputError : public std::runtime_error {
 public:
  /// An error that no place in a file belongs to.
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  /// An error with its place; what() is describe(fault).
  explicit InputError(InputFault fault) : std::runtime_error(describe(fault)), fault_(std::move(fault)) {}
  /// The parts of the message; without a path if there is nothing but the message.
  [[nodiscard]] const InputFault& fault() const noexcept { return fault_; }

 private:
  InputFault fault_;
};

/// An output that cannot be written. what() is one line with the path, the system's reason and what
/// was expected. A program that ends with it exits with status 2.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The text made safe for a one-line message: control characters and bytes that are not UTF-8
/// become escapes (\n, \t, \r, \x1B), and what follows the first `max_bytes` bytes of it becomes
/// "...".
std::string printable(std::string_view text, std::size_t max_bytes = 40);

/// The whole path, made safe in the same way.
std::string printable_path(const std::filesystem::path& path);

}  // namespace io
