#include "io/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "io/interrupt.hpp"

namespace io {
namespace {

constexpr std::size_t buffer_bytes = std::size_t{1} << 16U;
constexpr int most_links = 40;
constexpr int most_partial_names = 100;
constexpr std::size_t longest_name_part = 200;  // leaves room for the process id below NAME_MAX
constexpr mode_t permission_bits = 07777;
constexpr std::string_view cannot_open = "cannot be opened for writing";
constexpr std::string_view cannot_write = "cannot be written";
constexpr std::string_view expected_file = "a file path in an existing, writable directory";
constexpr std::string_view expected_writable = "a writable path";
constexpr std::string_view expected_whole = "room and permission for the whole output";

std::optional<int> descriptor_named_by(const std::string& path) {
  if (path == "-" || path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  for (const std::string_view prefix : {"/dev/fd/", "/proc/self/fd/"}) {
    if (!path.starts_with(prefix)) continue;
    int descriptor = -1;
    const char* const end = path.data() + path.size();
    const auto [stop, error] = std::from_chars(path.data() + prefix.size(), end, descriptor);
    if (stop == end && error == std::errc() && descriptor >= 0) return descriptor;
  }
  return std::nullopt;
}

int open_retrying(const char* path, int flags, mode_t mode = 0) {
  for (;;) {
    stop_if_interrupted();  // a pipe may wait for its reader for ever
    const int fd = ::open(path, flags | O_CLOEXEC | O_NOCTTY, mode);
    if (fd >= 0 || errno != EINTR) return fd;
  }
}

struct Target {
  std::filesystem::path path;  // links followed
  std::optional<int> descriptor;
};

Target target_of(const std::filesystem::path& path, std::error_code& error) {
  Target target{path, descriptor_named_by(path.string())};
  for (int links = 0; !target.descriptor && std::filesystem::is_symlink(target.path, error); ++links) {
    const std::filesystem::path next = std::filesystem::read_symlink(target.path, error);
    if (!error && links == most_links) error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    if (error) return target;
    target.path = next.is_absolute() ? next : target.path.parent_path() / next;
    target.descriptor = descriptor_named_by(target.path.string());
  }
  error.clear();  // of a path that does not exist
  return target;
}

}  // namespace

bool is_same_output(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code error;
  const Target first = target_of(a, error);
  const Target second = target_of(b, error);
  if (first.descriptor || second.descriptor) return first.descriptor == second.descriptor;
  if (std::filesystem::exists(first.path, error) && std::filesystem::exists(second.path, error)) {
    return std::filesystem::is_regular_file(first.path, error) &&
           std::filesystem::equivalent(first.path, second.path, error);
  }
  const auto place = [&error](const std::filesystem::path& path) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
  };
  return place(first.path) == place(second.path) && !error;
}

OutputFile::OutputFile(const std::filesystem::path& path) : path_(path) {
  std::error_code error;
  const Target target = target_of(path, error);
  target_ = target.path;
  if (error) fail(cannot_open, error.value(), expected_file);
  if (target.descriptor) {
    open_descriptor(*target.descriptor);
  } else {
    if (target_.empty()) fail(cannot_open, ENOENT, expected_file);
    target_ = std::filesystem::absolute(target_, error);
    if (error) fail(cannot_open, error.value(), expected_file);
    struct stat status {};
    const bool exists = ::stat(target_.c_str(), &status) == 0;
    if (!exists && errno != ENOENT) fail(cannot_open, errno, expected_file);
    const bool is_directory = !target_.has_filename() || (exists && S_ISDIR(status.st_mode));
    if (is_directory) fail(cannot_open, EISDIR, expected_file);
    if (exists && !S_ISREG(status.st_mode)) {
      open_in_place();
    } else {
      open_partial();
    }
  }
  buffer_.reserve(buffer_bytes);
}

OutputFile::~OutputFile() {
  discard();
}

void OutputFile::open_descriptor(int descriptor) {
  fd_ = ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
  if (fd_ < 0) fail(cannot_open, errno, "an open descriptor");
  is_stdout_ = descriptor == STDOUT_FILENO;
}

void OutputFile::open_in_place() {
  fd_ = open_retrying(target_.c_str(), O_WRONLY);
  if (fd_ < 0) fail(cannot_open, errno, expected_writable);
}

void OutputFile::open_partial() {
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (exists && ::access(target_.c_str(), W_OK) != 0) fail(cannot_open, errno, expected_writable);
  const mode_t mode = exists ? status.st_mode & permission_bits : mode_t{0666};

  in_place_ = false;
  // A file without a name cannot stay behind, whatever ends the process. It gets its name through /proc.
  if (::access("/proc/self/fd", X_OK) == 0) {
    fd_ = open_retrying(target_.parent_path().c_str(), O_WRONLY | O_TMPFILE, mode);
  }
  if (fd_ < 0) name_partial(mode);  // some file systems know none, NFS among them

  if (exists && ::fchmod(fd_, mode) != 0) {
    const int error = errno;
    discard();
    fail(cannot_open, error, "permissions that can be kept");
  }
}

/// Gives the temporary file a name beside the target, or makes it if there is none.
void OutputFile::name_partial(unsigned mode) {
  const std::string stem = fmt::format(".{}", target_.filename().string().substr(0, longest_name_part));
  const std::string unnamed = fmt::format("/proc/self/fd/{}", fd_);
  for (int attempt = 0; partial_.empty(); ++attempt) {
    const std::string suffix = attempt == 0 ? "" : fmt::format("-{}", attempt);
    const auto candidate = target_.parent_path() / fmt::format("{}.{}{}.part", stem, ::getpid(), suffix);
    bool named = false;
    if (fd_ >= 0) {
      named = ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, candidate.c_str(), AT_SYMLINK_FOLLOW) == 0;
    } else {
      fd_ = open_retrying(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL, mode);
      named = fd_ >= 0;
    }
    if (named) {
      partial_ = candidate;
    } else if (errno != EEXIST || attempt == most_partial_names) {
      fail(cannot_open, errno, expected_file);
    }
  }
}

void OutputFile::write(std::string_view text) {
  require_open();
  if (buffer_.size() + text.size() > buffer_bytes) flush();
  if (text.size() > buffer_bytes) {
    write_through(text);
  } else {
    buffer_ += text;
  }
}

void OutputFile::flush() {
  // What the program printed before comes out before.
  if (is_stdout_ && std::fflush(stdout) != 0) fail(cannot_write, errno, expected_whole);
  write_through(buffer_);
  buffer_.clear();
}

void OutputFile::write_through(std::string_view text) {
  while (!text.empty()) {
    stop_if_interrupted();
    const ssize_t written = ::write(fd_, text.data(), text.size());
    if (written > 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (written < 0 && errno == EAGAIN) {
      pollfd waiting{fd_, POLLOUT, 0};
      ::poll(&waiting, 1, -1);
    } else if (written == 0 || errno != EINTR) {
      fail(cannot_write, written == 0 ? EIO : errno, expected_whole);
    }
  }
}

void OutputFile::prepare() {
  require_open();
  flush();
  // Some file systems cannot sync and say so; that is no failure of the write.
  const bool synced = in_place_ || ::fsync(fd_) == 0 || errno == EINVAL || errno == ENOSYS;
  if (!synced) fail(cannot_write, errno, expected_whole);
  if (!in_place_ && partial_.empty()) name_partial(0);
  const bool closed = ::close(fd_) == 0 || errno == EINTR;
  fd_ = -1;
  if (!closed) fail(cannot_write, errno, expected_whole);
  prepared_ = true;
}

void OutputFile::commit() {
  if (!prepared_) prepare();
  prepared_ = false;
  if (in_place_) return;
  if (::rename(partial_.c_str(), target_.c_str()) != 0) {
    fail("cannot be put in place", errno, "a path that can be replaced");
  }
  partial_.clear();
}

void OutputFile::require_open() const {
  if (fd_ < 0) throw std::logic_error("io::OutputFile: used after commit: " + path_.string());
}

void OutputFile::discard() noexcept {
  if (fd_ >= 0) ::close(fd_);
  fd_ = -1;
  if (!partial_.empty()) ::unlink(partial_.c_str());
  partial_.clear();
}

void OutputFile::fail(std::string_view action, int error, std::string_view expected) const {
  const std::string name = path_ == "-" ? "standard output" : printable_path(path_);
  throw OutputError(fmt::format("{}: {}: {}: expected {}", name.empty() ? "''" : name, action,
                                std::generic_category().message(error), expected));
}

}  // namespace io
