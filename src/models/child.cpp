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

/// Value of errno for a child that could not be started, or 0.
int spawn(char* const* arguments, const char* directory, int input, int output, pid_t& child) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (input < 0) {  // a process of the background that reads from the terminal would be stopped
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  } else {
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  }
  posix_spawn_file_actions_adddup2(&actions, output < 0 ? STDERR_FILENO : output, STDOUT_FILENO);
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

}  // namespace

Clock::time_point deadline_after(double seconds) {
  const std::chrono::duration<double> limit(std::min(seconds, 1e9));
  return seconds > 0.0 ? Clock::now() + std::chrono::duration_cast<Clock::duration>(limit)
                       : Clock::time_point::max();
}

Child::Child(const std::vector<std::string>& arguments, const std::string& directory, int input, int output) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) {
    pointers.push_back(const_cast<char*>(argument.c_str()));
  }
  pointers.push_back(nullptr);
  if (const int error = spawn(pointers.data(), directory.c_str(), input, output, leader_); error != 0) {
    leader_ = -1;
    end_ = {ChildEnd::Kind::not_started, error};
    return;
  }
  descriptor_ = static_cast<int>(syscall(SYS_pidfd_open, leader_, 0));
  if (descriptor_ < 0) {
    const int error = errno;
    end();
    throw std::system_error(error, std::generic_category(), "pidfd_open");
  }
}

Child::~Child() {
  end();
}

bool Child::wait_until(Clock::time_point deadline) const {
  if (leader_ < 0) {
    return true;
  }
  for (auto now = Clock::now(); now < deadline && io::interrupt_signal() == 0; now = Clock::now()) {
    const auto wait = std::min<Clock::duration>(longest_wait, deadline - now);
    pollfd waited{descriptor_, POLLIN, 0};
    const auto milliseconds = std::chrono::ceil<std::chrono::milliseconds>(wait).count();
    if (poll(&waited, 1, static_cast<int>(milliseconds)) > 0) {
      return true;
    }
  }
  return false;
}

ChildEnd Child::end() {
  if (leader_ < 0) {
    return end_;
  }
  kill(-leader_, SIGKILL);  // until waitpid the number is the leader's own, even if it has ended
  int status = 0;
  while (waitpid(leader_, &status, 0) < 0 && errno == EINTR) {
  }
  leader_ = -1;
  if (descriptor_ >= 0) {
    close(descriptor_);
  }
  end_ = WIFSIGNALED(status) ? ChildEnd{ChildEnd::Kind::signalled, WTERMSIG(status)}
                             : ChildEnd{ChildEnd::Kind::exited, WEXITSTATUS(status)};
  return end_;
}

ChildEnd run_child(const std::vector<std::string>& arguments, const std::string& directory,
                   double timeout_seconds) {
  const auto deadline = deadline_after(timeout_seconds);
  Child child(arguments, directory);
  const bool ended = child.wait_until(deadline);
  const ChildEnd end = child.end();
  io::stop_if_interrupted();
  return ended ? end : ChildEnd{ChildEnd::Kind::timed_out, 0};
}

}  // namespace models
