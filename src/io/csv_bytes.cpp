#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <system_error>

#include "io/csv_text.hpp"
#include "io/descriptor.hpp"
#include "io/errors.hpp"
#include "io/interrupt.hpp"

namespace io::csv_text {

std::string bytes_of(const std::filesystem::path& path) {
  constexpr std::size_t chunk_bytes = std::size_t{1} << 18U;
  constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 32U;  // more than a size_t of 32 bits holds
  const auto fail = [&](int error) {
    throw InputError(InputFault{.path = path,
                                .found = "cannot be read: " + std::generic_category().message(error),
                                .expected = "a CSV file"});
  };
  const auto require_size = [&](std::uintmax_t bytes) {
    if (bytes > most_bytes) {
      throw InputError(InputFault{.path = path,
                                  .found = fmt::format("{} bytes or more", bytes),
                                  .expected = fmt::format("a CSV file of at most {} bytes", most_bytes)});
    }
  };
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0) fail(errno);
  if (S_ISDIR(status.st_mode)) fail(EISDIR);
  require_size(static_cast<std::uintmax_t>(status.st_size));
  std::string text;
  text.reserve(static_cast<std::size_t>(status.st_size) + chunk_bytes);
  for (;;) {
    stop_if_interrupted();  // a pipe may wait for its writer for ever
    const std::size_t old_size = text.size();
    text.resize(old_size + chunk_bytes);
    const ssize_t got = ::read(file.get(), text.data() + old_size, chunk_bytes);
    if (got < 0 && errno != EINTR) fail(errno);
    text.resize(old_size + (got > 0 ? static_cast<std::size_t>(got) : 0));
    if (got == 0 || text.find('\0', old_size) != std::string::npos) return text;
    require_size(text.size());
  }
}

}  // namespace io::csv_text
