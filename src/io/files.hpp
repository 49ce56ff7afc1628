#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "io/descriptor.hpp"
#include "io/errors.hpp"

namespace io {

/// A file that appears complete or not at all. The data go to a temporary file in the target's
/// directory, which has no name until prepare() names it `.name.csv.<process id>.part` (where the
/// file system does not support unnamed files it has that name from the start); commit() renames it
/// over the target. Without commit() no trace of the data is left, and whatever stood under the
/// path before is untouched. Not thread-safe.
///
/// What the path may be:
///  - "-" or /dev/stdout, /dev/stderr, /dev/fd/N: that open descriptor, in place;
///  - a device or a pipe: written in place, never renamed over;
///  - a symbolic link: the file it points to is replaced or created, the link stays;
///  - an existing file: replaced, keeping its permissions; one that is write-protected is refused.
///
/// Every failure is an OutputError that names the path, the system's reason and what was expected.
/// The constructor and the members that write also throw Interrupted (stop_if_interrupted).
class OutputFile {
 public:
  /// Opens the output, so that a bad path is reported before the work.
  /// \throws OutputError
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends the text, through a buffer.
  /// \throws OutputError; std::logic_error after commit().
  void write(std::string_view text);

  /// Flushes, syncs to the disk and closes: the operations that can fail for lack of space.
  /// \throws OutputError, which leaves the target as it was; std::logic_error if called twice.
  void prepare();

  /// Calls prepare(), unless that is done, and renames the file.
  /// \throws OutputError, which leaves the target as it was; std::logic_error if called twice.
  void commit();

  /// The path as given.
  const std::filesystem::path& path() const noexcept { return path_; }

  /// Whether the path is a descriptor, device or pipe, which is written in place, so that no file
  /// can be put beside it.
  bool in_place() const noexcept { return in_place_; }

 private:
  void open_partial(std::optional<unsigned> kept);
  void name_partial(unsigned mode);
  void flush();
  void require_open() const;
  [[noreturn]] void fail(std::string_view action, int error, std::string_view expected) const;

  std::filesystem::path path_;
  // absolute, links followed
  std::filesystem::path target_;
  // empty as long as the temporary file has no name
  std::filesystem::path partial_;
  Descriptor file_;
  bool is_prepared_ = false;
  bool is_stdout_ = false;
  bool in_place_ = true;
  std::string buffer_;
};

/// Puts several outputs in place, skipping those that are absent: all are prepared before the first
/// is renamed, so that if one lacks space every target stays as it was. For OutputFile and
/// CsvWriter.
/// \throws OutputError
template <class... Outputs>
void commit_all(std::optional<Outputs>&... outputs) {
  ((outputs ? outputs->prepare() : void()), ...);
  ((outputs ? outputs->commit() : void()), ...);
}

/// Whether two paths lead to the same place for an output: the same descriptor or the same file,
/// also through links and if the file does not exist yet. Devices and pipes may be written to
/// twice.
[[nodiscard]] bool is_same_output(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace io
