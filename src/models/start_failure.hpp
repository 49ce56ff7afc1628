/// \file
/// Reasons why a program could not be started, or how it ended.
#pragma once

#include <string>

#include "models/child.hpp"

namespace models {

/// Explains a failed exec from the first bytes of the program: a missing interpreter, Windows line
/// ends, no `#!`.
/// \param error  errno after the exec
/// \return text that completes the sentence "could not be started: ..."; the system's own message
///         if there is no more to say
[[nodiscard]] std::string explain_start_failure(const std::string& program, int error);

/// For a script that ended with status 126 or 127, with which shells and env(1) report that they
/// could not run a command: its first line, in parentheses after a space. Empty for other programs
/// and statuses.
[[nodiscard]] std::string explain_command_not_run(const std::string& program, int status);

/// How a program ended that should have ended with status 0, such as "was ended by signal 11
/// (Segmentation fault): expected an exit". Empty for status 0.
[[nodiscard]] std::string explain_end(const std::string& program, const ChildEnd& end,
                                      double timeout_seconds);

/// The absolute path of a program.
/// \throws ModelError unless the program is an executable file.
[[nodiscard]] std::string runnable_path(const std::string& program);

}  // namespace models
