// Any bytes as a CSV file, read as a table and as each file that the experiments read. Either the
// file is refused with an io::InputError that names file, line and column, or what was read is
// written and read again as the same cells and numbers.

#include <sys/mman.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <regex>
#include <stdexcept>
#include <tuple>

#include "check.hpp"
#include "inputs.hpp"

namespace {

/// A file in memory, with a path.
class MemoryFile {
 public:
  MemoryFile() : fd_(::memfd_create("fuzz", 0)), path_("/dev/fd/" + std::to_string(fd_)) {
    if (fd_ < 0) throw std::runtime_error("memfd_create");
  }
  ~MemoryFile() { ::close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  void put(const std::uint8_t* data, std::size_t size) const {
    if (::pwrite(fd_, data, size, 0) != static_cast<ssize_t>(size)) throw std::runtime_error("pwrite");
  }
  const std::string& path() const { return path_; }

 private:
  int fd_;
  std::string path_;
};

// Each complaint names the file; then the line and what stands there, or the row of a prior that is
// missing.
void check_message(const std::string& path, const std::string& message) {
  require_one_line(message);
  require(message.starts_with(path + ":"), "a message names the file", message);
  const std::string rest = message.substr(path.size());
  static const std::regex placed(
      R"(:[1-9][0-9]*: (column ('.*'|[1-9][0-9]*): (value '.*'|missing value)|header '.*'|empty file|no rows): expected .+)");
  static const std::regex whole_file(
      R"(: (column 'parameter': no row '.*'|no column of samples): expected .+)");
  require(std::regex_match(rest, placed) || std::regex_match(rest, whole_file),
          "a message has line, column, value and what was expected", message);
}

/// Whether the call accepts its file.
template <class Call>
bool accepts(const std::string& path, Call call) {
  try {
    call();
    return true;
  } catch (const io::InputError& error) {
    check_message(path, error.what());
    return false;
  }
}

void require_same(const std::vector<double>& a, const std::vector<double>& b, const std::string& column) {
  require(a.size() == b.size(), "as many numbers are read again", column);
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool same =
        std::isnan(a[i]) ? std::isnan(b[i]) : a[i] == b[i] && std::signbit(a[i]) == std::signbit(b[i]);
    require(same, "the same numbers are read again", io::format_number(a[i]) + " " + io::format_number(b[i]));
  }
}

void check_round_trip(const io::CsvTable& table) {
  const auto& names = table.column_names();
  const MemoryFile copy;
  io::CsvWriter writer(copy.path(), names);
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> cells;
    for (const auto& name : names) {
      cells.emplace_back(table.cell(row, name));
    }
    writer.row(cells);
  }
  writer.commit();
  const auto again = io::CsvTable::read(copy.path());
  require(again.column_names() == names, "the same columns are read again", copy.path());
  for (const auto& name : names) {
    require(again.text(name) == table.text(name), "the same cells are read again", name);
  }
}

void check_columns(const io::CsvTable& table) {
  for (const auto& name : table.column_names()) {
    std::vector<double> finite, numbers;
    std::vector<long> integers;
    const std::string path = table.path().string();
    const bool are_finite = accepts(path, [&] { finite = table.numbers(name); });
    const bool are_numbers = accepts(path, [&] { numbers = table.numbers_or_nan(name); });
    const bool are_integers = accepts(path, [&] { integers = table.integers(name); });
    require(are_numbers || !are_finite, "finite numbers are numbers", name);
    require(are_numbers || !are_integers, "integers are numbers", name);
    if (are_finite) require_same(finite, numbers, name);
    for (std::size_t i = 0; are_integers && i < integers.size(); ++i) {
      require(static_cast<double>(integers[i]) == numbers[i], "integers have their value", name);
    }
    if (!are_numbers) continue;
    const MemoryFile copy;
    io::CsvWriter writer(copy.path(), {name});
    for (const double x : numbers) writer.row(x);
    writer.commit();
    require_same(io::CsvTable::read(copy.path()).numbers_or_nan(name), numbers, name);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file;
  file.put(data, size);
  const std::string& path = file.path();
  const bool is_table = accepts(path, [&] {
    const auto table = io::CsvTable::read(path);
    check_round_trip(table);
    check_columns(table);
  });
  bool read = false;
  read |= accepts(path, [&] { std::ignore = experiments::read_observations(path); });
  read |= accepts(path, [&] { std::ignore = experiments::read_prior(path); });
  read |= accepts(path, [&] { std::ignore = experiments::read_samples(path); });
  read |= accepts(path, [&] { std::ignore = experiments::read_studies(path); });
  read |= accepts(path, [&] { std::ignore = experiments::read_printed_tables(path, path); });
  require(is_table || !read, "what an experiment reads is a table", path);
  return 0;
}
