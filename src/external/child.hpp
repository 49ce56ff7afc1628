/// \file
/// A child process with a limit of time.
#pragma once

#include <string>
#include <vector>

namespace external {

/// How a child ended.
struct ChildEnd {
  /// By itself, by a signal, killed when the time was over, or never begun.
  enum class Kind { exited, signalled, timed_out, not_started };
  Kind kind;  ///< which of them
  int value;  ///< exit status, number of the signal, or errno
};

/// Runs arguments[0], a path, in the given directory with standard output on standard error. The child leads a process group
/// (io::fork_group), which is killed when the time is over or the child has ended, and when a signal ends this process. The
/// child itself is killed too when the calling thread ends.
/// \param timeout_seconds  0: no limit
[[nodiscard]] ChildEnd run_child(const std::vector<std::string>& arguments, const std::string& directory,
                                 double timeout_seconds);

}  // namespace external
