#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "io/errors.hpp"
#include "io/scratch_directory.hpp"
#include "io/signals.hpp"
#include "temporary_directory.hpp"

using io::ScratchDirectory;
namespace fs = std::filesystem;

namespace {

/// A directory for temporary files of this test's own.
class ScratchFixture {
 protected:
  ScratchFixture() { ::setenv("TMPDIR", directory.path().c_str(), 1); }
  ~ScratchFixture() {
    if (before.empty()) {
      ::unsetenv("TMPDIR");
    } else {
      ::setenv("TMPDIR", before.c_str(), 1);
    }
  }

  void make(const std::string& name, int age_s) const {
    fs::create_directory(directory.path() / name);
    std::ofstream(directory.path() / name / "file") << "x";
    set_age(directory.path() / name, age_s);
  }
  static void set_age(const fs::path& path, int age_s) {
    const timespec then{::time(nullptr) - age_s, 0};
    const timespec times[2] = {then, then};
    REQUIRE(::utimensat(AT_FDCWD, path.c_str(), times, AT_SYMLINK_NOFOLLOW) == 0);
  }
  bool exists(const std::string& name) const {
    return fs::symlink_status(directory.path() / name).type() != fs::file_type::not_found;
  }
  static int signal_of_child(const std::function<void()>& body) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      ::close(STDERR_FILENO);
      ::signal(SIGTERM, SIG_DFL);
      body();
      ::_exit(7);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  }

  std::string before = std::getenv("TMPDIR") == nullptr ? "" : std::getenv("TMPDIR");
  TemporaryDirectory directory;
};

}  // namespace

TEST_CASE_METHOD(ScratchFixture, "a scratch directory goes with all that is in it", "[io][scratch]") {
  fs::path path;
  {
    const ScratchDirectory scratch("name", {"known"});
    path = scratch.path();
    CHECK(path.parent_path() == directory.path());
    CHECK(path.filename().string().starts_with("name-"));
    for (const char* file : {"known", "other"}) std::ofstream(path / file) << "x";
  }
  CHECK_FALSE(fs::exists(path));
  ::setenv("TMPDIR", (directory.path() / "none").c_str(), 1);
  CHECK_THROWS_AS(ScratchDirectory("name", {}), io::OutputError);
}

TEST_CASE_METHOD(ScratchFixture, "a signal removes a scratch directory of known files", "[io][scratch]") {
  const auto killed_with = [&](const std::string& file) {
    return signal_of_child([&] {
      io::end_cleanly_on_signals("program");
      const ScratchDirectory one("name", {"known"});
      const ScratchDirectory two("name", {"known"});
      std::ofstream(two.path() + "/" + file) << "x";
      ::raise(SIGTERM);
    });
  };
  CHECK(killed_with("known") == SIGTERM);
  CHECK(fs::is_empty(directory.path()));
  CHECK(killed_with("other") == SIGTERM);
  CHECK(std::distance(fs::directory_iterator(directory.path()), {}) == 1);
}

TEST_CASE_METHOD(ScratchFixture, "only what nobody holds any more is stale", "[io][scratch]") {
  make("name-abcDE1", 100);
  make("name-abcDE2", 20);  // may have been made just now
  make("name-abcDE", 100);  // other names
  make("name-abcDE11", 100);
  make("name-abc.E1", 100);
  make("names-abcDE1", 100);
  make("elsewhere", 100);
  fs::create_directory_symlink(directory.path() / "elsewhere", directory.path() / "name-linked");
  set_age(directory.path() / "name-linked", 100);
  std::ofstream(directory.path() / "name-file01") << "x";
  set_age(directory.path() / "name-file01", 100);
  const ScratchDirectory live("name", {});
  set_age(live.path(), 100);
  if (::geteuid() == 0) {
    make("name-others", 100);
    REQUIRE(::chown((directory.path() / "name-others").c_str(), 12345, 12345) == 0);
  }

  ScratchDirectory::remove_stale("name");
  CHECK_FALSE(exists("name-abcDE1"));
  for (const char* name : {"name-abcDE2", "name-abcDE", "name-abcDE11", "name-abc.E1", "names-abcDE1",
                           "elsewhere/file", "name-linked", "name-file01"}) {
    CAPTURE(name);
    CHECK(exists(name));
  }
  CHECK(fs::exists(live.path()));
  CHECK((::geteuid() != 0 || exists("name-others/file")));
}

TEST_CASE_METHOD(ScratchFixture, "what a killed process leaves is stale after a minute", "[io][scratch]") {
  fs::path left;
  CHECK(signal_of_child([&] {
          const ScratchDirectory scratch("name", {});
          ::raise(SIGKILL);
        }) == SIGKILL);
  REQUIRE_FALSE(fs::is_empty(directory.path()));
  left = fs::directory_iterator(directory.path())->path();
  ScratchDirectory::remove_stale("name");
  CHECK(fs::exists(left));
  set_age(left, 100);
  ScratchDirectory::remove_stale("name");
  CHECK_FALSE(fs::exists(left));
}
