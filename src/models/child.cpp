#include "models/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>

#include "io/interrupt.hpp"

namespace models {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds longest_wait(50);  // between two looks at the interrupt flag

/// Errno of a child that could not be started, or 0. It leads a process group.
int spawn(char* const* arguments, const char* directory, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // A process of the background that reads from the terminal would be stopped.
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, directory);

  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  sigaddset(&signals, SIGXFSZ);  // which io::catch_interrupts ignores
  posix_spawnattr_setsigdefault(&attributes, &signals);

  const int error = posix_spawn(&child, arguments[0], &actions, &attributes, arguments, environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// Kills what is left of the group; gives the leader's wait status.
int end_group(pid_t leader) {
  kill(-leader, SIGKILL);  // until waitpid the number is the leader's own, even if it has ended
  int status = 0;
  while (waitpid(leader, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// Whether the process ended before the deadline and before an interrupt.
bool wait_for(int process, Clock::time_point deadline) {
  for (auto now = Clock::now(); now < deadline && io::interrupt_signal() == 0; now = Clock::now()) {
    const auto wait = std::min<Clock::duration>(longest_wait, deadline - now);
    pollfd waited{process, POLLIN, 0};
    const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(wait).count();
    if (poll(&waited, 1, static_cast<int>(milliseconds)) > 0) {
      return true;
    }
  }
  return false;
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& arguments, const std::string& directory,
                   double timeout_seconds) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) {
    pointers.push_back(const_cast<char*>(argument.c_str()));
  }
  pointers.push_back(nullptr);
  const auto limit = std::chrono::duration<double>(std::min(timeout_seconds, 1e9));
  const auto deadline = timeout_seconds > 0.0
                            ? Clock::now() + std::chrono::duration_cast<Clock::duration>(limit)
                            : Clock::time_point::max();
  pid_t child = -1;
  if (const int error = spawn(pointers.data(), directory.c_str(), child); error != 0) {
    return {ChildEnd::Kind::not_started, error};
  }
  const int process = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  if (process < 0) {
    const int error = errno;
    end_group(child);
    throw std::system_error(error, std::generic_category(), "pidfd_open");
  }
  const bool ended = wait_for(process, deadline);
  close(process);
  const int status = end_group(child);
  io::stop_if_interrupted();
  if (!ended) {
    return {ChildEnd::Kind::timed_out, 0};
  }
  return WIFSIGNALED(status) ? ChildEnd{ChildEnd::Kind::signalled, WTERMSIG(status)}
                             : ChildEnd{ChildEnd::Kind::exited, WEXITSTATUS(status)};
}

}  // namespace models
