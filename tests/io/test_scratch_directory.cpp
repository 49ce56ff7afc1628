#include <stdlib.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/errors.hpp"
#include "io/scratch_directory.hpp"
#include "temporary_directory.hpp"

using Catch::Matchers::Contains;
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

  std::string before = std::getenv("TMPDIR") == nullptr ? "" : std::getenv("TMPDIR");
  TemporaryDirectory directory;
};

}  // namespace

TEST_CASE_METHOD(ScratchFixture, "a scratch directory goes with all that is in it", "[io][scratch]") {
  fs::path path;
  {
    const ScratchDirectory scratch("name");
    path = scratch.path();
    CHECK(path.parent_path() == directory.path());
    CHECK(path.filename().string().starts_with("name-"));
    fs::create_directory(path / "below");
    for (const char* file : {"one", "below/two"}) std::ofstream(path / file) << "x";
  }
  CHECK_FALSE(fs::exists(path));
}

TEST_CASE_METHOD(ScratchFixture, "two scratch directories of one name are two", "[io][scratch]") {
  const ScratchDirectory one("name");
  const ScratchDirectory two("name");
  CHECK(one.path() != two.path());
}

TEST_CASE_METHOD(ScratchFixture, "a relative TMPDIR is made absolute", "[io][scratch]") {
  const fs::path working_directory = fs::current_path();
  fs::current_path(directory.path());
  ::setenv("TMPDIR", ".", 1);
  const std::string path = ScratchDirectory("name").path();
  fs::current_path(working_directory);
  CHECK(fs::path(path).is_absolute());
}

TEST_CASE_METHOD(ScratchFixture, "the message names a TMPDIR that cannot hold it", "[io][scratch]") {
  const std::string missing = (directory.path() / "none").string();
  ::setenv("TMPDIR", missing.c_str(), 1);
  CHECK_THROWS_WITH(ScratchDirectory("name"), Contains(missing + "/name-") &&
                                                  Contains("No such file or directory") &&
                                                  Contains("expected TMPDIR to be a directory"));
}
