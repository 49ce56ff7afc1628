/// \file
/// Why a program could not be started, or how it ended.
#pragma once

#include <string>

#include "models/child.hpp"

namespace models {

/// Explains a failed exec by the first bytes of the program: an interpreter that is missing, line ends of Windows, no `#!`.
/// \param error  errno of the exec
/// \return what completes the sentence "could not be started: ..."; the system's own words if there is no more to say
[[nodiscard]] std::string explain_start_failure(const std::string& program, int error);

/// For a script that ended with status 126 or 127, by which shells and env(1) say that they could not run a command: its first
/// line, in parentheses behind a space. Empty for other programs and statuses.
[[nodiscard]] std::string explain_command_not_run(const std::string& program, int status);

/// How a program ended that should have ended with status 0: "was ended by signal 11 (Segmentation fault): expected an exit".
/// Empty for status 0.
[[nodiscard]] std::string explain_end(const std::string& program, const ChildEnd& end,
                                      double timeout_seconds);

/// The absolute path of a program.
/// \throws ModelError unless it is an executable file.
[[nodiscard]] std::string runnable_path(const std::string& program);

}  // namespace models
