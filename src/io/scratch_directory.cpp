#include "io/scratch_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "io/ending.hpp"
#include "io/errors.hpp"

namespace io {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view random_part = "XXXXXX";  // of mkdtemp
constexpr std::time_t stale_after_s = 60;
constexpr int most_attempts = 20;
constexpr int pause_ms = 5;

std::array<std::atomic<const ScratchDirectory*>, 4096> registered;
static_assert(std::atomic<const ScratchDirectory*>::is_always_lock_free,
              "the signal handler needs lock-free atomics");

void exchange(const ScratchDirectory* from, const ScratchDirectory* to) noexcept {
  for (auto& slot : registered) {
    const ScratchDirectory* expected = from;
    if (slot.compare_exchange_strong(expected, to)) return;
  }
}

[[noreturn]] void fail_directory(const fs::path& path, int error) {
  throw OutputError(fmt::format("{}: cannot be made: {}: expected a directory for temporary files",
                                printable_path(path), std::generic_category().message(error)));
}

bool is_name(std::string_view text, std::string_view name) {
  return text.size() == name.size() + 1 + random_part.size() && text.starts_with(name) &&
         text[name.size()] == '-' &&
         std::all_of(text.end() - random_part.size(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) != 0; });
}

/// Locked, so that whoever starts at the same time leaves it alone.
void remove_if_stale(const fs::path& path) {
  const int fd = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (fd < 0) return;
  struct stat status {};
  if (::fstat(fd, &status) == 0 && status.st_uid == ::geteuid() &&
      status.st_mtime < std::time(nullptr) - stale_after_s && ::flock(fd, LOCK_EX | LOCK_NB) == 0) {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  ::close(fd);
}

}  // namespace

ScratchDirectory::ScratchDirectory(const std::string& name, const std::vector<std::string>& files) {
  std::error_code error;
  fs::path parent = fs::temp_directory_path(error);
  if (error) fail_directory(parent.empty() ? fs::path("TMPDIR") : parent, error.value());
  parent = fs::absolute(parent);  // the program starts in another directory
  std::string path = (parent / fmt::format("{}-{}", name, random_part)).string();
  const ending::Registration registration;
  if (::mkdtemp(path.data()) == nullptr) fail_directory(path, errno);
  for (const std::string& file : files) paths_.push_back(path + "/" + file);
  paths_.push_back(path);
  lock_ = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (lock_ < 0) {
    const int reason = errno;
    ::rmdir(path.c_str());
    fail_directory(path, reason);
  }
  // Where directories cannot be locked, remove_stale finds none that can.
  static_cast<void>(::flock(lock_, LOCK_EX | LOCK_NB));
  exchange(nullptr, this);
}

ScratchDirectory::~ScratchDirectory() {
  std::error_code ignored;
  fs::remove_all(path(), ignored);
  const ending::Registration registration;
  exchange(this, nullptr);
  ::close(lock_);
}

void ScratchDirectory::remove_stale(const std::string& name) noexcept {
  try {
    for (const fs::directory_entry& entry : fs::directory_iterator(fs::temp_directory_path())) {
      if (is_name(entry.path().filename().string(), name)) remove_if_stale(entry.path());
    }
  } catch (const std::exception&) {
    return;  // a directory that cannot be listed keeps what is in it
  }
}

void ScratchDirectory::remove_known() const noexcept {
  // A program that has just been killed may finish a system call that makes its file once more.
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    for (std::size_t i = 0; i + 1 < paths_.size(); ++i) ::unlink(paths_[i].c_str());
    if (::rmdir(path().c_str()) == 0 || errno == ENOENT) return;
    ::poll(nullptr, 0, pause_ms);
  }
}

void ScratchDirectory::remove_all() noexcept {
  for (const auto& slot : registered) {
    if (const ScratchDirectory* const directory = slot.load()) directory->remove_known();
  }
}

}  // namespace io
