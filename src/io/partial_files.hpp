#pragma once

/// Register of the temporary files that the signal handler has to remove; internal to io.
namespace io::partial_files {

/// Registers a path and returns its slot, or -1 if all slots are taken or the path is too long. Thread-safe.
int add(const char* path) noexcept;

/// Frees a slot; -1 does nothing. Thread-safe.
void remove(int slot) noexcept;

/// Unlinks every registered file; may be called by a signal handler.
void unlink_all() noexcept;

}  // namespace io::partial_files
