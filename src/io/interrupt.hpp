/// \file
/// Cooperative interrupts: a signal sets a flag, long work looks at it and throws, destructors
/// clean up.
#pragma once

#include <string>

namespace io {

/// Thrown by stop_if_interrupted. It is no std::exception, so that code which handles the failures
/// of a computation lets it pass.
struct Interrupted {
  /// What the user finds afterwards, for the message.
  std::string kept = "no unfinished output is kept";
};

/// From here on SIGINT, SIGTERM, SIGHUP, SIGPIPE and SIGXCPU set a flag; the first one counts.
/// System calls that wait are broken off with EINTR, again every 100 ms in case one had not begun
/// when the signal came. A program that has not ended after 0.9 s is ended by the signal without
/// cleaning up. Signals that are ignored stay ignored. SIGXFSZ is ignored, so that a file beyond
/// the limit of its size is a failed write. Call it once, early in main.
void catch_interrupts();

/// Number of the first signal that came; 0 if none has come.
[[nodiscard]] int interrupt_signal() noexcept;

/// To be called by all work that lasts, several times a second, from any thread.
/// \throws Interrupted if a signal has come.
void stop_if_interrupted();

/// Ends the process by the signal that came, so that a shell or make sees it; for the end of main.
[[noreturn]] void die_of_interrupt() noexcept;

}  // namespace io
