#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/descriptor.hpp"

namespace io {

/// Rows of a long computation, stored as they are computed, so that a run that was killed resumes
/// where it stopped.
///
/// The journal of an output PATH is the file PATH.journal. Its first line is the key, and each
/// further line is a row; at the end of a line, after a tab, stands its CRC-32, seeded with the
/// CRC-32 of the key. Only one process may have the journal open.
class Journal {
 public:
  /// Opens the journal or starts one. The first row that is cut off or damaged is dropped, with all
  /// rows after it.
  /// \param key  one line that names everything the rows depend on
  /// \throws InputError if the existing journal has another key or a damaged one (a key that was
  ///         cut off counts as none), is not a regular file, or is open in another process;
  ///         OutputError if it cannot be opened or written.
  Journal(const std::filesystem::path& output, const std::string& key);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Path of the journal file.
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// Complete rows, without line ends.
  [[nodiscard]] const std::vector<std::string>& rows() const { return rows_; }

  /// Whether whole lines were dropped as damaged when the journal was opened. A last line that was
  /// cut off does not count as damage.
  [[nodiscard]] bool was_damaged() const { return was_damaged_; }

  /// Appends rows, none of which contains a line end, in one write and waits until they are on the
  /// disk.
  /// \throws OutputError
  void append(const std::vector<std::string>& rows);

  /// Drops all rows from number `count` on.
  /// \throws OutputError
  void truncate(std::size_t count);

  /// Puts the output in place, the header (if not empty) and the rows, and removes the journal.
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
