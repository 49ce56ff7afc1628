#include "io/csv_bytes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "io/errors.hpp"
#include "io/interrupt.hpp"

namespace io {
namespace {

constexpr std::size_t read_chunk_bytes = std::size_t{1} << 18U;
constexpr std::size_t largest_file_bytes = std::size_t{1} << 32U;

[[noreturn]] void fail_unreadable(const std::filesystem::path& path, int error) {
  throw InputError({.path = path,
                    .found = "cannot be read: " + std::generic_category().message(error),
                    .expected = "a CSV file"});
}

void require_size(const std::filesystem::path& path, std::size_t bytes) {
  if (bytes <= largest_file_bytes) return;
  throw InputError({.path = path,
                    .found = fmt::format("{} bytes or more", bytes),
                    .expected = fmt::format("a CSV file of at most {} bytes", largest_file_bytes)});
}

class ReadDescriptor {
 public:
  explicit ReadDescriptor(const std::filesystem::path& path)
      : fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (fd_ < 0) fail_unreadable(path, errno);
  }
  ~ReadDescriptor() { ::close(fd_); }
  ReadDescriptor(const ReadDescriptor&) = delete;
  ReadDescriptor& operator=(const ReadDescriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

}  // namespace

std::string csv_bytes(const std::filesystem::path& path) {
  const ReadDescriptor file(path);
  struct stat status {};
  if (::fstat(file.get(), &status) != 0) fail_unreadable(path, errno);
  if (S_ISDIR(status.st_mode)) fail_unreadable(path, EISDIR);
  std::string text;
  if (status.st_size > 0) {
    require_size(path, static_cast<std::size_t>(status.st_size));
    text.reserve(static_cast<std::size_t>(status.st_size) + read_chunk_bytes);
  }
  for (;;) {
    stop_if_interrupted();  // a pipe may wait for its writer for ever
    const std::size_t old_size = text.size();
    text.resize(old_size + read_chunk_bytes);
    const ssize_t got = ::read(file.get(), text.data() + old_size, read_chunk_bytes);
    if (got < 0 && errno != EINTR) fail_unreadable(path, errno);
    text.resize(old_size + static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    if (got == 0) return text;
    require_size(path, text.size());
    if (text.find('\0', old_size) != std::string::npos) return text;
  }
}

}  // namespace io
