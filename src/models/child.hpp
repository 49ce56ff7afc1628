/// \file
/// A child process with a time limit.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <vector>

namespace models {

/// How a child ended.
struct ChildEnd {
  /// It exited by itself, was ended by a signal, was killed at the time limit, or was never
  /// started.
  enum class Kind { exited, signalled, timed_out, not_started };
  /// How the child ended.
  Kind kind;
  /// Exit status, number of the signal, or errno.
  int value;
};

/// The deadline of a time limit that begins now.
/// \param seconds  0: no limit
[[nodiscard]] std::chrono::steady_clock::time_point deadline_after(double seconds);

/// A program that has been started and leads its own process group, which end() or the destructor
/// kills. If this process is ended by kill -9, the program keeps running.
class Child {
 public:
  /// Starts arguments[0], a path, with default signal handling. A program that cannot be started is
  /// treated as a child that has ended.
  /// \param directory  working directory of the child
  /// \param input  descriptor of its standard input; -1: /dev/null
  /// \param output  descriptor of its standard output; -1: the standard error that it shares with
  ///        this process
  /// \throws std::system_error if pidfd_open is not available.
  Child(const std::vector<std::string>& arguments, const std::string& directory, int input = -1,
        int output = -1);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Waits for the leader of the group. Returns whether it ended before the deadline and before an
  /// interrupt (io::catch_interrupts).
  [[nodiscard]] bool wait_until(std::chrono::steady_clock::time_point deadline) const;

  /// Kills the remaining processes of the group. Returns how the leader ended; by this kill if it
  /// was still running.
  ChildEnd end();

 private:
  pid_t leader_ = -1;
  // readable when the leader has ended
  int descriptor_ = -1;
  // valid once leader_ is -1
  ChildEnd end_{};
};

/// Runs a child until it ends, the time limit is reached or an interrupt arrives, with an empty
/// standard input and its standard output sent to standard error.
/// \param timeout_seconds  0: no limit
/// \throws io::Interrupted if a signal has been received (io::catch_interrupts); std::system_error
///         if pidfd_open is not available.
[[nodiscard]] ChildEnd run_child(const std::vector<std::string>& arguments, const std::string& directory,
                                 double timeout_seconds);

}  // namespace models
