#include "models/worker_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "io/errors.hpp"
#include "io/interrupt.hpp"
#include "models/model_error.hpp"

namespace models {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds longest_wait(50);  // between two looks at the interrupt flag
constexpr std::chrono::seconds time_to_end(1);         // of a worker whose input or output has ended

/// write() without SIGPIPE, which io::catch_interrupts would take for an interrupt.
ssize_t write_quietly(int descriptor, std::string_view text) {
  sigset_t pipe_signal, before;
  sigemptyset(&pipe_signal);
  sigaddset(&pipe_signal, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &pipe_signal, &before);
  const ssize_t written = write(descriptor, text.data(), text.size());
  const int error = errno;
  if (written < 0 && error == EPIPE) {
    const timespec no_wait{};
    while (sigtimedwait(&pipe_signal, nullptr, &no_wait) < 0 && errno == EINTR) {
    }
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  errno = error;
  return written;
}

bool is_not_yet(int error) {
  return error == EAGAIN || error == EINTR;
}

}  // namespace

Pipe::Pipe() {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    throw std::system_error(errno, std::generic_category(), "pipe2");
  }
  reading.reset(ends[0]);
  writing.reset(ends[1]);
}

WorkerProcess::WorkerProcess(const std::vector<std::string>& arguments) {
  child_ = std::make_unique<Child>(arguments, directory_.path(), to_.reading.get(), from_.writing.get());
  to_.reading.close();
  from_.writing.close();
  fcntl(to_.writing.get(), F_SETFL, O_NONBLOCK);
  fcntl(from_.reading.get(), F_SETFL, O_NONBLOCK);
}

WorkerProcess::~WorkerProcess() {
  to_.writing.close();
  from_.reading.close();
  static_cast<void>(child_->wait_until(Clock::now() + time_to_end));
}

/// Whether a line was the last. Lines behind it are taken too.
bool WorkerProcess::take_lines(std::size_t longest_line,
                               const std::function<bool(std::string_view)>& take_line) {
  bool is_complete = false;
  std::size_t begin = 0;
  for (std::size_t end = unread_.find('\n'); end != unread_.npos; end = unread_.find('\n', begin)) {
    is_complete = take_line(std::string_view(unread_).substr(begin, end - begin));
    begin = end + 1;
  }
  unread_.erase(0, begin);
  if (unread_.size() > longest_line) {
    throw ModelError(fmt::format("wrote a line of more than {} bytes", longest_line));
  }
  return is_complete;
}

void WorkerProcess::throw_ended() {
  if (!child_->wait_until(Clock::now() + time_to_end)) {
    io::stop_if_interrupted();
    throw ModelError("closed its standard input or output, and went on");
  }
  throw WorkerEnded{child_->end()};
}

/// False at the end of the worker's output.
bool WorkerProcess::receive() {
  std::array<char, 65536> bytes;
  const ssize_t count = read(from_.reading.get(), bytes.data(), bytes.size());
  if (count > 0) {
    unread_.append(bytes.data(), static_cast<std::size_t>(count));
  }
  return count > 0 || (count < 0 && is_not_yet(errno));
}

/// Writes what the pipe holds and takes it from the text; false if the worker reads no more.
bool WorkerProcess::send(std::string_view& text) {
  const ssize_t count = write_quietly(to_.writing.get(), text);
  text.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
  return count >= 0 || is_not_yet(errno);
}

void WorkerProcess::exchange(std::string_view text, Clock::time_point deadline, std::size_t longest_line,
                             const std::function<bool(std::string_view)>& take_line) {
  try {
    if (!receive()) {
      throw_ended();
    }
    if (!unread_.empty()) {
      throw ModelError(fmt::format("wrote '{}' before it was given points",
                                   io::printable(unread_.substr(0, unread_.find('\n')))));
    }
    for (bool is_complete = false; !is_complete || !text.empty();) {
      io::stop_if_interrupted();
      const auto now = Clock::now();
      if (now >= deadline) {
        throw WorkerEnded{{ChildEnd::Kind::timed_out, 0}};
      }
      std::array<pollfd, 2> waited{
          {{from_.reading.get(), POLLIN, 0}, {text.empty() ? -1 : to_.writing.get(), POLLOUT, 0}}};
      const auto wait = std::chrono::ceil<std::chrono::milliseconds>(
          std::min<Clock::duration>(longest_wait, deadline - now));
      if (poll(waited.data(), waited.size(), static_cast<int>(wait.count())) <= 0) {
        continue;
      }
      const bool reads = waited[1].revents == 0 || send(text);
      const bool writes = waited[0].revents == 0 || receive();
      is_complete = take_lines(longest_line, take_line) || is_complete;
      if ((!reads || !writes) && !(is_complete && text.empty())) {
        throw_ended();
      }
    }
  } catch (...) {
    child_->end();
    throw;
  }
}

}  // namespace models
