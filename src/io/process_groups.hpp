#pragma once

#include <sys/types.h>

namespace io {

/// fork() for a child that leads a process group. When this process is ended by a signal (end_cleanly_on_signals) or calls
/// exit, the group is killed with all that is in it. Returns 0 in the child, and -1 with errno set if there is no
/// child. Thread-safe; up to 4096 groups at a time. Between this call and exec the child may do only what is
/// async-signal-safe.
[[nodiscard]] pid_t fork_group() noexcept;

/// Kills what is left of a group of fork_group, waits for its leader, and gives the leader's wait status.
int end_group(pid_t leader) noexcept;

namespace process_groups {

/// Kills every group; internal to io, may be called by a signal handler.
void kill_all() noexcept;

}  // namespace process_groups
}  // namespace io
