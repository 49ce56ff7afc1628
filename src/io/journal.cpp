#include "io/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "io/errors.hpp"
#include "io/files.hpp"

namespace io {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw OutputError(
      fmt::format("{}: {}: expected a journal that can be written", path.string(), std::strerror(error)));
}

}  // namespace

Journal::Journal(const std::filesystem::path& output, const std::string& key)
    : output_(output), path_(output.string() + ".journal"), key_(key) {
  fd_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (fd_ < 0) {
    fail(path_, errno);
  }
  if (::flock(fd_, LOCK_EX | LOCK_NB) != 0) {
    ::close(fd_);
    throw InputError(fmt::format("{}: in use by another process: expected to be alone", path_.string()));
  }
  std::ifstream file(path_, std::ios::binary);
  std::ostringstream content;
  content << file.rdbuf();
  const std::string text = content.str();
  std::size_t at = 0;
  std::vector<std::string> lines;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', at)) {
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  if (lines.empty()) {
    if (::ftruncate(fd_, 0) != 0) {
      fail(path_, errno);
    }
    write(key_ + "\n");
    return;
  }
  if (lines.front() != key_) {
    ::close(fd_);
    throw InputError(
        fmt::format("{}: made with other inputs or options: expected the same, or no journal (delete it to "
                    "start again)",
                    path_.string()));
  }
  if (at < text.size() && ::ftruncate(fd_, static_cast<off_t>(at)) != 0) {
    fail(path_, errno);
  }
  rows_.assign(lines.begin() + 1, lines.end());
}

Journal::~Journal() {
  if (fd_ >= 0) {
    ::close(fd_);
  }
}

void Journal::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(fd_, text.data(), text.size());
    if (written < 0 && errno != EINTR) {
      fail(path_, errno);
    }
    text.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
  if (::fsync(fd_) != 0 && errno != EINVAL) {
    fail(path_, errno);
  }
}

void Journal::append(const std::vector<std::string>& rows) {
  std::string text;
  for (const std::string& row : rows) {
    text += row + "\n";
  }
  write(text);
  rows_.insert(rows_.end(), rows.begin(), rows.end());
}

void Journal::truncate(std::size_t count) {
  if (count >= rows_.size()) {
    return;
  }
  rows_.resize(count);
  std::size_t size = key_.size() + 1;
  for (const std::string& row : rows_) {
    size += row.size() + 1;
  }
  if (::ftruncate(fd_, static_cast<off_t>(size)) != 0) {
    fail(path_, errno);
  }
}

void Journal::finish(std::string_view header) {
  OutputFile file(output_);
  if (!header.empty()) {
    file.write(fmt::format("{}\n", header));
  }
  for (const std::string& row : rows_) {
    file.write(row + "\n");
  }
  file.commit();
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace io
