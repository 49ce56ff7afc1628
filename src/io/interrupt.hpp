/// \file
/// Cooperative interrupts: a signal sets a flag, long computations check it and throw, and
/// destructors clean up.
#pragma once

#include <string>

namespace io {

/// Thrown by stop_if_interrupted. It is not derived from std::exception, so that code which handles
/// failures of a computation lets it pass.
struct Interrupted {
  /// States what the user finds afterwards, for the message.
  std::string kept = "no unfinished output is kept";
};

/// From this call on SIGINT, SIGTERM, SIGHUP, SIGPIPE and SIGXCPU set a flag; the first signal
/// counts. System calls that wait are interrupted with EINTR, and again every 100 ms in case a call
/// had not begun when the signal came. A program that has not ended after 0.9 s is terminated by
/// the signal without cleaning up. Signals that are ignored stay ignored. SIGXFSZ is ignored, so
/// that exceeding the file size limit is a failed write. Call this function once, early in main.
void catch_interrupts();

/// Number of the first signal received; 0 if none has been received.
[[nodiscard]] int interrupt_signal() noexcept;

/// Must be called several times a second, from any thread, by every long computation.
/// \throws Interrupted if a signal has been received.
void stop_if_interrupted();

/// Ends the process by the signal received, so that a shell or make sees it; for the end of main.
[[noreturn]] void die_of_interrupt() noexcept;

}  // namespace io
