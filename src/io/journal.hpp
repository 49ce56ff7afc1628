#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace io {

/// Rows of a long computation, kept as they come, so that a run that was killed goes on where it stopped.
///
/// The journal of an output PATH is the file PATH.journal: its first line is the key, each further line a row. Only one
/// process may have it open.
class Journal {
 public:
  /// Opens the journal or starts one. A last line that was cut off is dropped.
  /// \param key  one line that names everything the rows depend on
  /// \throws InputError if the journal there has another key, or another process has it open; OutputError if it cannot
  ///         be opened or written.
  Journal(const std::filesystem::path& output, const std::string& key);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Complete rows, without line ends.
  [[nodiscard]] const std::vector<std::string>& rows() const { return rows_; }

  /// Appends rows in one write and waits until they are on the disk.
  /// \throws OutputError
  void append(const std::vector<std::string>& rows);

  /// Drops all rows from number `count` on.
  void truncate(std::size_t count);

  /// Puts the output in place, header (if not empty) and rows, and removes the journal.
  /// \throws OutputError
  void finish(std::string_view header);

 private:
  void write(std::string_view text);

  std::filesystem::path output_;
  std::filesystem::path path_;
  std::string key_;
  int fd_ = -1;
  std::vector<std::string> rows_;
};

}  // namespace io
