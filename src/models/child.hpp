/// \file
/// A child process with a limit of time.
#pragma once

#include <string>
#include <vector>

namespace models {

/// How a child ended.
struct ChildEnd {
  /// By itself, by a signal, killed when the time was over, or never begun.
  enum class Kind { exited, signalled, timed_out, not_started };
  Kind kind;  ///< which of them
  int value;  ///< exit status, number of the signal, or errno
};

/// Runs arguments[0], a path, in the given directory with standard output on standard error. The child leads a process
/// group, which is killed when the time is over, when the child has ended and at an interrupt. A kill -9 of this process
/// leaves it running.
/// \param timeout_seconds  0: no limit
/// \throws io::Interrupted if a signal has come (io::catch_interrupts); std::system_error without pidfd_open.
[[nodiscard]] ChildEnd run_child(const std::vector<std::string>& arguments, const std::string& directory,
                                 double timeout_seconds);

}  // namespace models
