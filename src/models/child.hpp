/// \file
/// A child process with a limit of time.
#pragma once

#include <sys/types.h>

#include <chrono>
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

/// When a time is over that begins now.
/// \param seconds  0: never
[[nodiscard]] std::chrono::steady_clock::time_point deadline_after(double seconds);

/// A program that has been started and leads a process group, which is killed by end() or the destructor. A kill -9 of this
/// process leaves it running.
class Child {
 public:
  /// Starts arguments[0], a path, with default signals. A program that cannot be started is a child that has ended.
  /// \param directory  where it runs
  /// \param input  descriptor of its standard input; -1: /dev/null
  /// \param output  descriptor of its standard output; -1: the standard error, which it shares with this process
  /// \throws std::system_error without pidfd_open.
  Child(const std::vector<std::string>& arguments, const std::string& directory, int input = -1,
        int output = -1);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits for the leader. Whether it ended before the deadline and before an interrupt (io::catch_interrupts).
  [[nodiscard]] bool wait_until(std::chrono::steady_clock::time_point deadline) const;

  /// Kills what is left of the group; how the leader ended, by that kill if it still ran.
  ChildEnd end();

 private:
  pid_t leader_ = -1;
  int descriptor_ = -1;  // readable when the leader has ended
  ChildEnd end_{};       // once leader_ is -1
};

/// Runs a child to its end, to a limit of time or to an interrupt, with nothing to read and its standard output on standard error.
/// \param timeout_seconds  0: no limit
/// \throws io::Interrupted if a signal has come (io::catch_interrupts); std::system_error without pidfd_open.
[[nodiscard]] ChildEnd run_child(const std::vector<std::string>& arguments, const std::string& directory,
                                 double timeout_seconds);

}  // namespace models
