#include "io/files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>

#include <charconv>
#include <cstdio>
#include <stdexcept>
#include <system_error>

#include "io/interrupt.hpp"

namespace io {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_bytes = std::size_t{1} << 16U;
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

int open_retrying(const fs::path& path, int flags, mode_t mode = 0) {
  for (;;) {
    stop_if_interrupted();  // a pipe may wait for its reader for ever
    const int fd = ::open(path.c_str(), flags | O_CLOEXEC | O_NOCTTY, mode);
    if (fd >= 0 || errno != EINTR) return fd;
  }
}

struct Target {
  fs::path path;  // links followed
  std::optional<int> descriptor;
};

Target target_of(const fs::path& path, std::error_code& error) {
  constexpr int most_links = 40;
  Target target{path, descriptor_named_by(path.string())};
  for (int links = 0; !target.descriptor && fs::is_symlink(target.path, error); ++links) {
    const fs::path next = fs::read_symlink(target.path, error);
    if (!error && links == most_links) error = std::make_error_code(std::errc::too_many_symbolic_link_levels);
    if (error) return target;
    target.path = target.path.parent_path() / next;
    target.descriptor = descriptor_named_by(target.path.string());
  }
  error.clear();  // of a path that does not exist
  return target;
}

}  // namespace

bool is_same_output(const fs::path& a, const fs::path& b) {
  std::error_code error;
  const Target first = target_of(a, error);
  const Target second = target_of(b, error);
  if (first.descriptor || second.descriptor) return first.descriptor == second.descriptor;
  if (fs::exists(first.path, error) && fs::exists(second.path, error)) {
    return fs::is_regular_file(first.path, error) && fs::equivalent(first.path, second.path, error);
  }
  const auto place = [&error](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(path, error), error);
  };
  return place(first.path) == place(second.path) && !error;
}

OutputFile::OutputFile(const fs::path& path) : path_(path) {
  std::error_code error;
  const Target target = target_of(path, error);
  if (error) fail(cannot_open, error.value(), expected_file);
  if (target.descriptor) {
    file_.reset(::fcntl(*target.descriptor, F_DUPFD_CLOEXEC, 0));
    if (file_.get() < 0) fail(cannot_open, errno, "an open descriptor");
    is_stdout_ = *target.descriptor == STDOUT_FILENO;
    return;
  }
  if (target.path.empty()) fail(cannot_open, ENOENT, expected_file);
  target_ = fs::absolute(target.path, error);
  if (error) fail(cannot_open, error.value(), expected_file);
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail(cannot_open, errno, expected_file);
  if (!target_.has_filename() || (exists && S_ISDIR(status.st_mode)))
    fail(cannot_open, EISDIR, expected_file);
  if (exists && !S_ISREG(status.st_mode)) {
    file_.reset(open_retrying(target_, O_WRONLY));
    if (file_.get() < 0) fail(cannot_open, errno, expected_writable);
  } else {
    if (exists && ::access(target_.c_str(), W_OK) != 0) fail(cannot_open, errno, expected_writable);
    open_partial(exists ? std::optional(status.st_mode & 07777U) : std::nullopt);
  }
}

OutputFile::~OutputFile() {
  if (!partial_.empty()) ::unlink(partial_.c_str());
}

/// \param kept  permissions of the file that is replaced
void OutputFile::open_partial(std::optional<unsigned> kept) {
  const mode_t mode = kept.value_or(0666U);
  in_place_ = false;
  // A file without a name cannot remain, however the process ends. It gets its name through /proc.
  if (::access("/proc/self/fd", X_OK) == 0) {
    file_.reset(open_retrying(target_.parent_path(), O_WRONLY | O_TMPFILE, mode));
  }
  if (file_.get() < 0) name_partial(mode);  // some file systems know none, NFS among them
  if (kept && ::fchmod(file_.get(), mode) != 0) {
    const int error = errno;
    if (!partial_.empty()) ::unlink(partial_.c_str());
    fail(cannot_open, error, "permissions that can be kept");
  }
}

/// Gives the temporary file a name beside the target, or creates the file with this name if there
/// is none yet.
void OutputFile::name_partial(unsigned mode) {
  constexpr int most_names = 100;
  constexpr std::size_t longest_stem = 200;  // leaves room for the process id below NAME_MAX
  const std::string stem = target_.filename().string().substr(0, longest_stem);
  const std::string unnamed = fmt::format("/proc/self/fd/{}", file_.get());
  for (int attempt = 0; partial_.empty(); ++attempt) {
    const std::string suffix = attempt == 0 ? "" : fmt::format("-{}", attempt);
    const auto candidate = target_.parent_path() / fmt::format(".{}.{}{}.part", stem, ::getpid(), suffix);
    bool named = false;
    if (file_.get() >= 0) {
      named = ::linkat(AT_FDCWD, unnamed.c_str(), AT_FDCWD, candidate.c_str(), AT_SYMLINK_FOLLOW) == 0;
    } else {
      file_.reset(open_retrying(candidate, O_WRONLY | O_CREAT | O_EXCL, mode));
      named = file_.get() >= 0;
    }
    if (named) {
      partial_ = candidate;
    } else if (errno != EEXIST || attempt == most_names) {
      fail(cannot_open, errno, expected_file);
    }
  }
}

void OutputFile::write(std::string_view text) {
  require_open();
  buffer_ += text;
  if (buffer_.size() > buffer_bytes) flush();
}

void OutputFile::flush() {
  // Output that the program printed earlier must come out first.
  if (is_stdout_ && std::fflush(stdout) != 0) fail(cannot_write, errno, expected_whole);
  for (std::string_view text = buffer_; !text.empty();) {
    stop_if_interrupted();
    const ssize_t written = ::write(file_.get(), text.data(), text.size());
    if (written > 0) {
      text.remove_prefix(static_cast<std::size_t>(written));
    } else if (written < 0 && errno == EAGAIN) {
      pollfd waiting{file_.get(), POLLOUT, 0};
      ::poll(&waiting, 1, -1);
    } else if (written == 0 || errno != EINTR) {
      fail(cannot_write, written == 0 ? EIO : errno, expected_whole);
    }
  }
  buffer_.clear();
}

void OutputFile::prepare() {
  require_open();
  flush();
  // Some file systems cannot sync and report this; it is not a failure of the write.
  const bool synced = in_place_ || ::fsync(file_.get()) == 0 || errno == EINVAL || errno == ENOSYS;
  if (!synced) fail(cannot_write, errno, expected_whole);
  if (!in_place_ && partial_.empty()) name_partial(0);
  if (!file_.close()) fail(cannot_write, errno, expected_whole);
  is_prepared_ = true;
}

void OutputFile::commit() {
  if (!is_prepared_) prepare();
  is_prepared_ = false;
  if (in_place_) return;
  if (::rename(partial_.c_str(), target_.c_str()) != 0) {
    fail("cannot be put in place", errno, "a path that can be replaced");
  }
  partial_.clear();
}

void OutputFile::require_open() const {
  if (file_.get() < 0) throw std::logic_error("io::OutputFile: used after commit: " + path_.string());
}

void OutputFile::fail(std::string_view action, int error, std::string_view expected) const {
  const std::string name = path_ == "-" ? "standard output" : printable_path(path_);
  throw OutputError(fmt::format("{}: {}: {}: expected {}", name.empty() ? "''" : name, action,
                                std::generic_category().message(error), expected));
}

}  // namespace io
