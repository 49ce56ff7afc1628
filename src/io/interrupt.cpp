#include "io/interrupt.hpp"

#include <signal.h>
#include <sys/time.h>
#include <unistd.h>

#include <atomic>

namespace io {
namespace {

constexpr suseconds_t tick_us = 100000;
constexpr int most_ticks = 9;

std::atomic<int> first_signal{0};
std::atomic<int> ticks{0};
static_assert(std::atomic<int>::is_always_lock_free, "the signal handlers need lock-free atomics");

void handle(int signal_number, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;    // without SA_RESTART: what waits is broken off
  ::sigfillset(&action.sa_mask);  // a second signal that is pending too must not be handled first
  ::sigaction(signal_number, &action, nullptr);
}

extern "C" void note_signal(int signal_number) {
  int none = 0;
  if (!first_signal.compare_exchange_strong(none, signal_number)) return;
  const itimerval timer{{0, tick_us}, {0, tick_us}};
  ::setitimer(ITIMER_REAL, &timer, nullptr);
}

extern "C" void note_tick(int) {
  if (++ticks == most_ticks) die_of_interrupt();
}

}  // namespace

void catch_interrupts() {
  handle(SIGALRM, note_tick);
  handle(SIGXFSZ, SIG_IGN);
  for (const int signal_number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU}) {
    struct sigaction before {};
    if (::sigaction(signal_number, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    handle(signal_number, note_signal);
  }
}

int interrupt_signal() noexcept {
  return first_signal;
}

void stop_if_interrupted() {
  if (first_signal != 0) throw Interrupted();
}

void die_of_interrupt() noexcept {
  const int signal_number = first_signal;
  handle(signal_number, SIG_DFL);
  sigset_t only;
  ::sigemptyset(&only);
  ::sigaddset(&only, signal_number);
  ::pthread_sigmask(SIG_UNBLOCK, &only, nullptr);
  ::raise(signal_number);
  ::_exit(128 + signal_number);
}

}  // namespace io
