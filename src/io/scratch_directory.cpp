#include "io/scratch_directory.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "io/errors.hpp"

namespace io {
namespace {

namespace fs = std::filesystem;

constexpr int most_attempts = 20;
constexpr int pause_ms = 5;

}  // namespace

ScratchDirectory::ScratchDirectory(const std::string& name) {
  const char* const parent = std::getenv("TMPDIR");
  const bool is_named = parent != nullptr && *parent != '\0';
  path_ = fs::absolute(fs::path(is_named ? parent : "/tmp") / (name + "-XXXXXX")).string();
  if (::mkdtemp(path_.data()) == nullptr) {
    const int reason = errno;
    throw OutputError(fmt::format("{}: cannot be made: {}: expected {} to be a directory that can be written",
                                  printable_path(path_), std::generic_category().message(reason),
                                  is_named ? "TMPDIR" : "/tmp"));
  }
}

ScratchDirectory::~ScratchDirectory() {
  // A program that has just been killed may finish a system call that makes one more file.
  std::error_code error;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    fs::remove_all(path_, error);
    if (!error) return;
    ::poll(nullptr, 0, pause_ms);
  }
}

}  // namespace io
