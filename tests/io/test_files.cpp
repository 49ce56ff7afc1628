#include <fcntl.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "io/files.hpp"
#include "io/progress.hpp"
#include "redirection.hpp"
#include "temporary_directory.hpp"

using Catch::Matchers::Contains;
using io::OutputFile;
namespace fs = std::filesystem;

namespace {

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::size_t entries(const fs::path& directory) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory), fs::directory_iterator()));
}

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  REQUIRE(::stat(path.c_str(), &status) == 0);
  return status.st_mode & 07777;
}

void write_file(const fs::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

std::string open_failure(const fs::path& path) {
  try {
    const OutputFile file(path);
  } catch (const io::OutputError& error) {
    const std::string text = error.what();
    CHECK(text.find('\n') == std::string::npos);
    return text;
  }
  return "no OutputError";
}

}  // namespace

TEST_CASE("a committed file is complete and leaves nothing beside it", "[io][files]") {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "out.csv";
  {
    OutputFile file(path);
    file.write("one\n");
    CHECK_FALSE(fs::exists(path));
    CHECK(entries(directory.path()) == 0);  // it has no name yet
    file.write("two\n");
    file.prepare();
    const std::string part = fs::directory_iterator(directory.path())->path().filename().string();
    CHECK(part == ".out.csv." + std::to_string(::getpid()) + ".part");
    file.commit();
    CHECK(content(path) == "one\ntwo\n");
    CHECK_THROWS_AS(file.write("more"), std::logic_error);
    CHECK_THROWS_AS(file.commit(), std::logic_error);
  }
  CHECK(content(path) == "one\ntwo\n");
  CHECK(entries(directory.path()) == 1);
}

TEST_CASE("without commit the old file stays and nothing is left behind", "[io][files]") {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "out.csv";
  {
    OutputFile file(path);
    file.write("new");
  }
  CHECK(entries(directory.path()) == 0);
  put(path, "old");
  {
    OutputFile file(path);
    file.write(std::string(1000000, 'n'));
  }
  CHECK(content(path) == "old");
  CHECK(entries(directory.path()) == 1);
  write_file(path, "new");
  CHECK(content(path) == "new");
}

TEST_CASE("large and many small writes arrive in order", "[io][files]") {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "out";
  std::string expected;
  OutputFile file(path);
  for (int i = 0; i < 50000; ++i) {
    const std::string piece = i == 25000 ? std::string(300000, 'x') : std::to_string(i) + "\n";
    file.write(piece);
    expected += piece;
  }
  file.commit();
  CHECK(content(path) == expected);
}

TEST_CASE("two writers of one path do not disturb each other, the last one wins", "[io][files]") {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "out";
  OutputFile first(path);
  OutputFile second(path);
  first.write("first");
  second.write("second");
  first.commit();
  CHECK(content(path) == "first");
  second.commit();
  CHECK(content(path) == "second");
  CHECK(entries(directory.path()) == 1);
}

TEST_CASE("bad paths are reported when the file is opened", "[io][files]") {
  const TemporaryDirectory directory;
  const fs::path file = directory.path() / "file";
  put(file, "x");
  CHECK(open_failure(directory.path() / "none" / "out.csv") ==
        (directory.path() / "none" / "out.csv").string() +
            ": cannot be opened for writing: No such file or directory: expected a file path in an existing, "
            "writable directory");
  CHECK_THAT(open_failure(file / "out.csv"), Contains("Not a directory"));
  CHECK_THAT(open_failure(directory.path()), Contains("Is a directory"));
  CHECK_THAT(open_failure(directory.path() / "none" / ""), Contains("Is a directory"));
  CHECK_THAT(open_failure(""), Contains("'': cannot be opened for writing: No such file"));
  CHECK_THAT(open_failure(directory.path() / std::string(300, 'n')), Contains("name too long"));
  CHECK_THAT(open_failure(directory.path() / "no\nne" / "out.csv"), Contains("no\\nne"));
  CHECK_THAT(open_failure("/dev/fd/987"), Contains("Bad file descriptor"));
  fs::create_symlink("loop", directory.path() / "loop");
  CHECK_THAT(open_failure(directory.path() / "loop"), Contains("symbolic links"));
  CHECK(entries(directory.path()) == 2);
}

TEST_CASE("names near the length limit of the file system still work", "[io][files]") {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / std::string(255, 'n');
  write_file(path, "x");
  CHECK(content(path) == "x");
}

TEST_CASE("a file that cannot be put in place is reported and cleaned up", "[io][files]") {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "out";
  {
    OutputFile file(path);
    fs::create_directory(path);
    CHECK_THROWS_WITH(file.commit(), Contains("cannot be put in place: Is a directory"));
  }
  CHECK(entries(directory.path()) == 1);
}

TEST_CASE("a full device is reported by write or commit", "[io][files]") {
  OutputFile small("/dev/full");
  small.write("x");
  CHECK_THROWS_WITH(small.commit(),
                    "/dev/full: cannot be written: No space left on device: expected room and "
                    "permission for the whole output");
  OutputFile large("/dev/full");
  CHECK_THROWS_AS(large.write(std::string(1000000, 'x')), io::OutputError);
  CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("devices and pipes are written in place", "[io][files]") {
  const TemporaryDirectory directory;
  write_file("/dev/null", "gone");
  CHECK(fs::is_character_file("/dev/null"));

  const fs::path fifo = directory.path() / "fifo";
  REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
  std::string received;
  std::thread reader([&] { received = content(fifo); });
  write_file(fifo, std::string(200000, 'p'));
  reader.join();
  CHECK(received == std::string(200000, 'p'));
  CHECK(fs::is_fifo(fifo));
  CHECK(entries(directory.path()) == 1);
}

TEST_CASE("a symbolic link stays and the file behind it is replaced", "[io][files]") {
  const TemporaryDirectory directory;
  fs::create_directory(directory.path() / "sub");
  const fs::path real = directory.path() / "sub" / "real";
  put(real, "old");
  fs::create_symlink("sub/real", directory.path() / "link");
  fs::create_symlink("link", directory.path() / "link_to_link");
  write_file(directory.path() / "link_to_link", "new");
  CHECK(content(real) == "new");
  CHECK(fs::is_symlink(directory.path() / "link"));
  CHECK(fs::is_symlink(directory.path() / "link_to_link"));

  fs::create_symlink("sub/created", directory.path() / "dangling");
  write_file(directory.path() / "dangling", "made");
  CHECK(content(directory.path() / "sub" / "created") == "made");
  CHECK(fs::is_symlink(directory.path() / "dangling"));
  CHECK(entries(directory.path() / "sub") == 2);
}

TEST_CASE("permissions follow the umask or the existing file", "[io][files]") {
  const TemporaryDirectory directory;
  const fs::path path = directory.path() / "out";
  const mode_t previous = ::umask(027);
  write_file(path, "x");
  CHECK(mode_of(path) == 0640);
  ::chmod(path.c_str(), 0606);
  write_file(path, "y");
  CHECK(mode_of(path) == 0606);
  ::umask(previous);
}

TEST_CASE("a relative path keeps its meaning when the working directory changes", "[io][files]") {
  const TemporaryDirectory directory;
  const fs::path before = fs::current_path();
  fs::current_path(directory.path());
  {
    OutputFile file("out");
    fs::current_path(before);
    file.write("x");
    file.commit();
  }
  CHECK(content(directory.path() / "out") == "x");
}

TEST_CASE("a dash and /dev/stdout are standard output, in order with what was printed", "[io][files]") {
  const TemporaryDirectory directory;
  const fs::path capture = directory.path() / "capture";
  for (const char* name : {"-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    {
      const Redirection stdout_to_file(STDOUT_FILENO, capture.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
      std::printf("before\n");
      write_file(name, "data\n");
      std::printf("after\n");
      std::fflush(stdout);
    }
    CAPTURE(name);
    CHECK(content(capture) == "before\ndata\nafter\n");
  }
  CHECK(entries(directory.path()) == 1);
}

TEST_CASE("errors of standard output are reported", "[io][files]") {
  std::string full;
  std::string closed;
  {
    const Redirection stdout_to_full(STDOUT_FILENO, "/dev/full", O_WRONLY);
    try {
      write_file("-", "data");
    } catch (const io::OutputError& error) {
      full = error.what();
    }
    ::close(STDOUT_FILENO);
    try {
      write_file("-", "data");
    } catch (const io::OutputError& error) {
      closed = error.what();
    }
  }
  CHECK_THAT(full, Contains("standard output: cannot be written: No space left on device"));
  CHECK_THAT(closed, Contains("standard output: cannot be opened for writing: Bad file descriptor"));
}

TEST_CASE("many files are open at a time", "[io][files]") {
  const TemporaryDirectory directory;
  std::vector<std::unique_ptr<OutputFile>> files;
  for (int i = 0; i < 70; ++i) {
    files.push_back(std::make_unique<OutputFile>(directory.path() / std::to_string(i)));
  }
  for (const auto& file : files) file->commit();
  CHECK(entries(directory.path()) == 70);
}

TEST_CASE("progress is silent unless standard error is a terminal", "[io][progress]") {
  const TemporaryDirectory directory;
  const fs::path capture = directory.path() / "capture";
  {
    const Redirection stderr_to_file(STDERR_FILENO, capture.c_str(), O_WRONLY | O_CREAT);
    io::Progress progress("runs", 2, true);
    std::this_thread::sleep_for(std::chrono::milliseconds(1600));
    progress.advance(2);
  }
  CHECK(content(capture).empty());
}

TEST_CASE("progress on a terminal appears late, redraws seldom and clears its line", "[io][progress]") {
  const int terminal = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  REQUIRE(terminal >= 0);
  REQUIRE(::grantpt(terminal) == 0);
  REQUIRE(::unlockpt(terminal) == 0);
  std::array<char, 128> name{};
  REQUIRE(::ptsname_r(terminal, name.data(), name.size()) == 0);
  REQUIRE(::fcntl(terminal, F_SETFL, O_NONBLOCK) == 0);
  const auto shown = [terminal] {
    std::array<char, 65536> bytes{};
    const ssize_t got = ::read(terminal, bytes.data(), bytes.size());
    return std::string(bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
  };

  ::setenv("TERM", "xterm", 1);
  std::string early;
  std::string late;
  std::string at_end;
  {
    const Redirection stderr_to_terminal(STDERR_FILENO, name.data(), O_RDWR | O_NOCTTY);
    {
      const io::Progress nothing_to_do("none", 0, true);
      io::Progress disabled("off", 10, false);
      io::Progress progress("runs", 4000, true);
      for (int i = 0; i < 1000; ++i) progress.advance();
      early = shown();
      std::this_thread::sleep_for(std::chrono::milliseconds(1600));
      disabled.advance();
      std::thread other([&progress] {
        for (int i = 0; i < 500; ++i) progress.advance();
      });
      for (int i = 0; i < 500; ++i) progress.advance();
      other.join();
      late = shown();
    }
    at_end = shown();
  }
  ::close(terminal);
  CHECK(early.empty());
  CHECK_THAT(late, Contains("\rruns ["));
  CHECK_THAT(late, Contains("/4000, "));
  CHECK(std::count(late.begin(), late.end(), '\r') <= 2);
  CHECK(at_end == "\r\x1B[K");
}
