#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace io {

/// Something the user can mend: a missing file, a bad value, an unknown option. what() is one line that
/// names the file, the place, the value and what was expected. A program that ends with it exits with
/// status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// An output that cannot be written. what() is one line with the path, the system's reason and what was
/// expected. A program that ends with it exits with status 2.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The text made safe for a one-line message: control characters and bytes that are not UTF-8 become escapes
/// (\n, \t, \r, \x1B), and what follows the first `max_bytes` bytes of it becomes "...".
std::string printable(std::string_view text, std::size_t max_bytes = 40);

/// The whole path, made safe in the same way.
std::string printable_path(const std::filesystem::path& path);

}  // namespace io
