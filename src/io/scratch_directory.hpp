#pragma once

#include <string>
#include <vector>

namespace io {

/// A directory of temporary files, `$TMPDIR/NAME-XXXXXX`, that is removed with all that is in it. It holds a lock (flock) on
/// itself. A signal that ends the process (end_cleanly_on_signals) or exit removes it too, unless other files than the known
/// ones are in it; those, and what a kill leaves behind, are for remove_stale at the next start.
class ScratchDirectory {
 public:
  /// \param name   without a slash
  /// \param files  names of the files that will be in it
  /// \throws OutputError if it cannot be made.
  ScratchDirectory(const std::string& name, const std::vector<std::string>& files);
  ~ScratchDirectory();
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  /// Of the directory, absolute.
  [[nodiscard]] const std::string& path() const { return paths_.back(); }

  /// Removes directories of this name that no process holds: those of this user that can be locked and that nothing was
  /// added to for a minute. What cannot be removed stays.
  static void remove_stale(const std::string& name) noexcept;

  /// Removes all that are registered, as far as they hold known files only; internal to io, may be called by a signal handler
  /// after ending::begin.
  static void remove_all() noexcept;

 private:
  void remove_known() const noexcept;

  std::vector<std::string> paths_;  // of the known files, then of the directory
  int lock_ = -1;
};

}  // namespace io
