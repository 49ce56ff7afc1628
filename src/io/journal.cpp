#include "io/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>

#include <boost/crc.hpp>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "io/errors.hpp"
#include "io/files.hpp"

namespace io {

namespace {

constexpr std::size_t checksum_size = 9;  // a tab and eight digits

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  throw OutputError(fmt::format("{}: cannot be written: {}: expected a journal that can be written",
                                printable_path(path), std::generic_category().message(error)));
}

[[noreturn]] void fail_as_foreign(const std::filesystem::path& path) {
  throw InputError(
      fmt::format("{}:1: made with other inputs or options, or damaged: expected the same, or no journal "
                  "(delete it to start again)",
                  printable_path(path)));
}

}  // namespace

Journal::Journal(const std::filesystem::path& output, const std::string& key)
    : output_(output), path_(output.string() + ".journal"), key_(key) {
  file_.reset(::open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666));
  struct stat status {};
  if (file_.get() < 0 || ::fstat(file_.get(), &status) != 0) fail(path_, errno);
  const auto refuse = [&](const char* why) { throw InputError(printable_path(path_) + why); };
  if (!S_ISREG(status.st_mode)) refuse(": a pipe or a device: expected a journal, or no such file");
  if (::flock(file_.get(), LOCK_EX | LOCK_NB) != 0) {
    refuse(": in use by another process: expected to be alone");
  }
  read_lines();
}

void Journal::read_lines() {
  std::ifstream file(path_, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  std::size_t begin = 0;
  bool has_key = false;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    const std::size_t size = end - begin;
    std::string row = text.substr(begin, size < checksum_size ? 0 : size - checksum_size);
    const bool intact = text.compare(begin, size + 1, line(row)) == 0;
    if (!has_key && (!intact || row != key_)) fail_as_foreign(path_);
    if (!intact) {
      was_damaged_ = true;
      break;
    }
    if (has_key) rows_.push_back(std::move(row));
    has_key = true;
    begin = end + 1;
  }
  // A first line that was cut off belongs to this run if it is a beginning of this run's key line;
  // after a power failure it may be zeros.
  if (!has_key && !line(key_).starts_with(text) && text.find_first_not_of('\0') != std::string::npos)
    fail_as_foreign(path_);
  cut_to(begin);
  if (!has_key) write(line(key_));
}

std::string Journal::line(std::string_view text) const {
  boost::crc_32_type crc;
  crc.process_bytes(key_.data(), key_.size());
  crc.process_bytes(text.data(), text.size());
  return fmt::format("{}\t{:08x}\n", text, crc.checksum());
}

void Journal::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(file_.get(), text.data(), text.size());
    if (written < 0 && errno != EINTR) fail(path_, errno);
    text.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
  }
  if (::fsync(file_.get()) != 0 && errno != EINVAL) fail(path_, errno);
}

void Journal::cut_to(std::size_t size) {
  if (::ftruncate(file_.get(), static_cast<off_t>(size)) != 0) fail(path_, errno);
}

void Journal::append(const std::vector<std::string>& rows) {
  std::string text;
  for (const std::string& row : rows) text += line(row);
  write(text);
  rows_.insert(rows_.end(), rows.begin(), rows.end());
}

void Journal::truncate(std::size_t count) {
  if (count >= rows_.size()) return;
  rows_.resize(count);
  std::size_t size = line(key_).size();
  for (const std::string& row : rows_) {
    size += row.size() + checksum_size + 1;
  }
  cut_to(size);
}

void Journal::finish(std::string_view header) {
  OutputFile file(output_);
  if (!header.empty()) file.write(fmt::format("{}\n", header));
  for (const std::string& row : rows_) file.write(row + "\n");
  file.commit();
  std::error_code ignored;
  const auto through_links = std::filesystem::canonical(path_, ignored);  // a link to the journal stays
  std::filesystem::remove(through_links.empty() ? path_ : through_links, ignored);
}

}  // namespace io
