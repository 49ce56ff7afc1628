#include "external/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <system_error>

#include "io/process_groups.hpp"

namespace external {

namespace {

using Clock = std::chrono::steady_clock;

/// Only calls that are safe between fork and exec in a program with threads.
[[noreturn]] void become(char* const* arguments, const char* directory, pid_t parent, int error_pipe) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  // A process of the background that reads from the terminal would be stopped.
  const int nothing = open("/dev/null", O_RDONLY);
  if (getppid() == parent && chdir(directory) == 0 && dup2(nothing, STDIN_FILENO) >= 0 && dup2(STDERR_FILENO, STDOUT_FILENO) >= 0) {
    execv(arguments[0], arguments);
  }
  const int error = errno;
  [[maybe_unused]] const auto written = write(error_pipe, &error, sizeof error);
  _exit(127);
}

/// Whether the process ended before the deadline.
bool wait_until(int process, bool limited, Clock::time_point deadline) {
  for (;;) {
    int milliseconds = -1;
    if (limited) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
      milliseconds = static_cast<int>(std::clamp<long long>(left, 0, 1000000));
    }
    pollfd waited{process, POLLIN, 0};
    const int ready = poll(&waited, 1, milliseconds);
    if (ready > 0) {
      return true;
    }
    if (ready == 0 && limited && Clock::now() >= deadline) {
      return false;
    }
  }
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& arguments, const std::string& directory,
                   double timeout_seconds) {
  std::vector<char*> pointers;
  for (const std::string& argument : arguments) {
    pointers.push_back(const_cast<char*>(argument.c_str()));
  }
  pointers.push_back(nullptr);
  int error_pipe[2];
  if (pipe2(error_pipe, O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe");
  }
  const bool limited = timeout_seconds > 0.0;
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(
                         std::chrono::duration<double>(limited ? std::min(timeout_seconds, 1e9) : 0.0));
  const pid_t parent = getpid();
  const pid_t child = io::fork_group();
  if (child == 0) {
    become(pointers.data(), directory.c_str(), parent, error_pipe[1]);
  }
  const int fork_error = errno;
  close(error_pipe[1]);
  if (child < 0) {
    close(error_pipe[0]);
    return {ChildEnd::Kind::not_started, fork_error};
  }
  int start_error = 0;
  const bool failed = read(error_pipe[0], &start_error, sizeof start_error) == sizeof start_error;
  close(error_pipe[0]);

  const int process = static_cast<int>(syscall(SYS_pidfd_open, child, 0));
  if (process < 0) {
    const int error = errno;
    io::end_group(child);
    throw std::system_error(error, std::generic_category(), "pidfd_open");
  }
  const bool ended = wait_until(process, limited, deadline);
  close(process);
  const int status = io::end_group(child);
  if (failed) {
    return {ChildEnd::Kind::not_started, start_error};
  }
  if (!ended) {
    return {ChildEnd::Kind::timed_out, 0};
  }
  return WIFSIGNALED(status) ? ChildEnd{ChildEnd::Kind::signalled, WTERMSIG(status)}
                             : ChildEnd{ChildEnd::Kind::exited, WEXITSTATUS(status)};
}

}  // namespace external
