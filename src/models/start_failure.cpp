#include "models/start_failure.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "io/csv.hpp"
#include "io/errors.hpp"
#include "models/model_error.hpp"

namespace models {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_first_line = 256;  // that Linux reads
constexpr std::size_t longest_word = 200;

std::string first_line_of(const std::string& program) {
  std::ifstream file(program, std::ios::binary);
  std::array<char, longest_first_line> bytes{};
  file.read(bytes.data(), bytes.size());
  const std::string_view text(bytes.data(), static_cast<std::size_t>(file.gcount()));
  return std::string(text.substr(0, text.find('\n')));
}

/// The path after `#!`.
std::string interpreter_of(std::string_view first_line) {
  constexpr std::string_view blanks = " \t";
  const std::string_view rest = first_line.substr(2);
  const std::size_t begin = std::min(rest.find_first_not_of(blanks), rest.size());
  return std::string(rest.substr(begin, rest.find_first_of(blanks, begin) - begin));
}

std::string_view not_executable(std::string_view first_line) {
  if (first_line.starts_with("\x7F"
                             "ELF")) {
    return "an executable for this machine";
  }
  if (first_line.starts_with("\xEF\xBB\xBF")) {
    return "no byte order mark before the #! of the first line";
  }
  return first_line.starts_with("#!") ? "a first line of #! and the path of an interpreter"
                                      : "a first line that begins with #!, such as #!/bin/sh";
}

}  // namespace

std::string explain_start_failure(const std::string& program, int error) {
  const std::string reason = std::strerror(error);
  const std::string first_line = first_line_of(program);
  const std::string interpreter = first_line.starts_with("#!") ? interpreter_of(first_line) : "";
  if (error == ENOEXEC) {
    return fmt::format("{}: expected {}", reason, not_executable(first_line));
  }
  if (!interpreter.empty()) {
    return fmt::format(
        "the interpreter '{}' of its first line: {}{}", io::printable(interpreter, longest_word), reason,
        first_line.ends_with('\r') ? "; the line ends in CR LF, as on Windows: expected LF alone"
                                   : ": expected a program that can be run");
  }
  if (error == ENOENT && !first_line.empty()) {
    return reason + ": expected the dynamic loader that the executable names";
  }
  return reason;
}

std::string explain_command_not_run(const std::string& program, int status) {
  constexpr int not_runnable = 126;
  constexpr int not_found = 127;
  const std::string first_line = first_line_of(program);
  if ((status != not_runnable && status != not_found) || !first_line.starts_with("#!")) {
    return {};
  }
  return fmt::format(" (a command that could not be run; the first line is '{}'{})",
                     io::printable(first_line, longest_word),
                     first_line.ends_with('\r') ? ", which ends in CR LF, as on Windows" : "");
}

std::string explain_end(const std::string& program, const ChildEnd& end, double timeout_seconds) {
  switch (end.kind) {
    case ChildEnd::Kind::exited:
      return end.value == 0 ? std::string()
                            : fmt::format("ended with status {}{}: expected 0", end.value,
                                          explain_command_not_run(program, end.value));
    case ChildEnd::Kind::signalled:
      return fmt::format("was ended by signal {} ({}): expected an exit", end.value, strsignal(end.value));
    case ChildEnd::Kind::timed_out:
      return fmt::format("took more than {} s and was killed", io::format_number(timeout_seconds));
    case ChildEnd::Kind::not_started:
      return "could not be started: " + explain_start_failure(program, end.value);
  }
  return {};
}

std::string runnable_path(const std::string& program) {
  std::error_code error;
  const bool is_file = fs::is_regular_file(program, error);
  if (!is_file || access(program.c_str(), X_OK) != 0) {
    throw ModelError(fmt::format("{}: {}: expected a program that can be run",
                                 io::printable(program, longest_word),
                                 is_file ? std::strerror(errno)
                                 : error ? error.message()
                                         : "not a file"));
  }
  return fs::absolute(program).string();
}

}  // namespace models
