#include "io/scratch_directory.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "io/errors.hpp"

namespace io {

ScratchDirectory::ScratchDirectory(const std::string& name) {
  const char* const parent = std::getenv("TMPDIR");
  const bool is_named = parent != nullptr && *parent != '\0';
  path_ = std::filesystem::absolute(std::filesystem::path(is_named ? parent : "/tmp") / (name + "-XXXXXX"));
  if (::mkdtemp(path_.data()) == nullptr) {
    throw OutputError(fmt::format("{}: cannot be made: {}: expected {} to be a directory that can be written",
                                  printable_path(path_), std::generic_category().message(errno),
                                  is_named ? "TMPDIR" : "/tmp"));
  }
}

ScratchDirectory::~ScratchDirectory() {
  // A program that has just been killed may finish a system call that makes one more file.
  std::error_code error;
  for (int attempt = 0; attempt < 20; ++attempt) {
    std::filesystem::remove_all(path_, error);
    if (!error) return;
    ::poll(nullptr, 0, 5);
  }
}

}  // namespace io
