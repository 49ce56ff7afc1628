#pragma once

#include <signal.h>

/// How the clean-up before the end of the process gets to know what the other threads make; internal to io.
namespace io::ending {

/// While one lives, its thread makes or ends something that the clean-up has to know of; the clean-up waits for it. Once the
/// clean-up has begun the constructor does not return: what a thread made from then on would stay behind.
class Registration {
 public:
  Registration() noexcept;
  ~Registration();
  Registration(const Registration&) = delete;
  Registration& operator=(const Registration&) = delete;

 private:
  sigset_t mask_;
};

/// Lets no registration begin any more and waits for those that have; false if one is still there after a second. May be
/// called by a signal handler.
bool begin() noexcept;

}  // namespace io::ending
