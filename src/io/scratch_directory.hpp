#pragma once

#include <string>

namespace io {

/// A directory for temporary files, `$TMPDIR/NAME-XXXXXX`, that is removed with all its contents by
/// the destructor. It remains if the process is ended by kill -9.
class ScratchDirectory {
 public:
  /// \param name  without a slash
  /// \throws OutputError if the directory cannot be made.
  explicit ScratchDirectory(const std::string& name);
  ~ScratchDirectory();
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;

  /// Absolute path of the directory.
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace io
