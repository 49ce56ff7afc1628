#include "io/ending.hpp"

#include <poll.h>
#include <unistd.h>

#include <atomic>

namespace io::ending {
namespace {

constexpr int longest_wait_ms = 1000;

std::atomic<int> open_registrations{0};
std::atomic<int> begun{0};
static_assert(std::atomic<int>::is_always_lock_free, "the signal handler needs lock-free atomics");

}  // namespace

Registration::Registration() noexcept {
  // A handler that interrupted this thread would wait for it.
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &mask_);
  ++open_registrations;
  if (begun == 0) return;
  --open_registrations;
  for (;;) ::pause();
}

Registration::~Registration() {
  --open_registrations;
  ::pthread_sigmask(SIG_SETMASK, &mask_, nullptr);
}

bool begin() noexcept {
  begun = 1;
  for (int waited = 0; open_registrations > 0; ++waited) {
    if (waited == longest_wait_ms) return false;
    ::poll(nullptr, 0, 1);
  }
  return true;
}

}  // namespace io::ending
