#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/descriptor.hpp"

namespace io {

/// Rows of a long computation, kept as they come, so that a run that was killed goes on where it
/// stopped.
///
/// The journal of an output PATH is the file PATH.journal. Its first line is the key, each further
/// line a row; after a tab stands the line's CRC-32, seeded with that of the key. Only one process
/// may have it open.
class Journal {
 public:
  /// Opens the journal or starts one. From the first row on that is cut off or damaged the rows are
  /// dropped.
  /// \param key  one line that names everything the rows depend on
  /// \throws InputError if the journal there has another or a damaged key (one that was cut off
  ///         counts as none), is no regular file, or another process has it open; OutputError if it
  ///         cannot be opened or written.
  Journal(const std::filesystem::path& output, const std::string& key);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// The file that is written.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Complete rows, without line ends.
  [[nodiscard]] const std::vector<std::string>& rows() const { return rows_; }

  /// Whether whole lines were dropped when the journal was opened, as damaged. A last line that was
  /// cut off is no damage.
  [[nodiscard]] bool was_damaged() const { return was_damaged_; }

  /// Appends rows, none with a line end in it, in one write and waits until they are on the disk.
  /// \throws OutputError
  void append(const std::vector<std::string>& rows);

  /// Drops all rows from number `count` on.
  /// \throws OutputError
  void truncate(std::size_t count);

  /// Puts the output in place, header (if not empty) and rows, and removes the journal.
  /// \throws OutputError
  void finish(std::string_view header);

 private:
  void read_lines();
  [[nodiscard]] std::string line(std::string_view text) const;
  void write(std::string_view text);
  void cut_to(std::size_t size);

  std::filesystem::path output_;
  std::filesystem::path path_;
  std::string key_;
  Descriptor file_;
  std::vector<std::string> rows_;
  bool was_damaged_ = false;
};

}  // namespace io
