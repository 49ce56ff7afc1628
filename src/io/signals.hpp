#pragma once

#include <string>
#include <string_view>

namespace io {

/// From here on a signal that ends the process (SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXCPU, SIGXFSZ) first kills the process
/// groups of fork_group, removes the temporary files of all live OutputFiles, up to 64 of them, and the ScratchDirectories,
/// and says in one line on standard error what is kept (after SIGPIPE nothing is said):
///
///     PROGRAM: interrupted: NOTE
///
/// Then it ends the process as it would have, so that a shell or make sees the signal. Signals that are ignored stay
/// ignored. exit, which libraries call when they cannot go on, cleans up in the same way and says nothing. A process that was
/// forked from this one cleans up nothing and says nothing. Call it once, early in main.
void end_cleanly_on_signals(std::string_view program);

/// The NOTE from here on; one thread at a time. Without a call it says that no unfinished output is kept, and the empty
/// note says that again. Does nothing before end_cleanly_on_signals.
void set_interruption_note(std::string_view note);

}  // namespace io
