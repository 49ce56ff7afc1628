#include "io/signals.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <climits>
#include <cstdlib>
#include <cstring>

#include "io/ending.hpp"
#include "io/partial_files.hpp"
#include "io/process_groups.hpp"
#include "io/scratch_directory.hpp"

namespace io {
namespace {

constexpr std::string_view nothing_kept = "no unfinished output is kept";
constexpr std::size_t longest_line = PATH_MAX + 512;

enum State : int { free_slot, filling, live, claimed };

/// Two of them, so that one can be filled while the other may be read by the signal handler.
struct Line {
  std::atomic<int> state{free_slot};
  std::size_t size = 0;
  char text[longest_line];
};

std::array<Line, 2> lines;
std::string start_of_line;
std::atomic<pid_t> owner{0};
std::atomic<bool> is_dying{false};
static_assert(std::atomic<int>::is_always_lock_free, "the signal handler needs lock-free atomics");

void say_what_is_kept() {
  for (Line& line : lines) {
    int expected = live;
    if (!line.state.compare_exchange_strong(expected, claimed)) continue;
    [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, line.text, line.size);
    return;
  }
}

/// What a forked process has inherited is not its own.
bool owns_the_files() {
  return ::getpid() == owner;
}

extern "C" void clean_up() {
  if (!owns_the_files()) return;
  const bool settled = ending::begin();
  process_groups::kill_all();
  partial_files::unlink_all();
  if (settled) ScratchDirectory::remove_all();
}

extern "C" void clean_up_and_die(int signal_number) {
  // A second signal, to whichever thread, must not end the process before the first one's handler has cleaned up.
  if (is_dying.exchange(true)) {
    for (;;) ::pause();
  }
  clean_up();
  if (owns_the_files() && signal_number != SIGPIPE) say_what_is_kept();
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  ::sigemptyset(&action.sa_mask);
  ::sigaction(signal_number, &action, nullptr);
  ::raise(signal_number);  // delivered when this handler returns
}

}  // namespace

void end_cleanly_on_signals(std::string_view program) {
  // The line of a progress bar is cleared first.
  start_of_line = fmt::format("{}{}: interrupted: ", ::isatty(STDERR_FILENO) != 0 ? "\r\x1B[K" : "", program);
  set_interruption_note("");
  owner = ::getpid();
  std::atexit(clean_up);
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU, SIGXFSZ}) {
    struct sigaction old {};
    if (::sigaction(signal_number, nullptr, &old) != 0 || old.sa_handler == SIG_IGN) continue;
    struct sigaction action {};
    action.sa_handler = clean_up_and_die;
    ::sigfillset(&action.sa_mask);
    ::sigaction(signal_number, &action, nullptr);
  }
}

void set_interruption_note(std::string_view note) {
  if (start_of_line.empty()) return;
  std::string text = fmt::format("{}{}", start_of_line, note.empty() ? nothing_kept : note);
  text.resize(std::min(text.size(), longest_line - 1));
  text += '\n';
  for (std::size_t i = 0; i < lines.size(); ++i) {
    Line& line = lines[i];
    int expected = free_slot;
    if (!line.state.compare_exchange_strong(expected, filling)) continue;
    std::memcpy(line.text, text.data(), text.size());
    line.size = text.size();
    line.state.store(live);
    expected = live;
    lines[1 - i].state.compare_exchange_strong(expected, free_slot);
    return;
  }
}

}  // namespace io
