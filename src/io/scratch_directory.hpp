#pragma once

#include <string>

namespace io {

/// A directory of temporary files, `$TMPDIR/NAME-XXXXXX`, that is removed with all that is in it. A
/// kill -9 leaves it behind.
class ScratchDirectory {
 public:
  /// \param name  without a slash
  /// \throws OutputError if it cannot be made.
  explicit ScratchDirectory(const std::string& name);
  ~ScratchDirectory();
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  /// Of the directory, absolute.
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace io
