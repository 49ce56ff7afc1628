#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/errors.hpp"
#include "io/journal.hpp"
#include "temporary_directory.hpp"

using Catch::Matchers::Contains;
using io::Journal;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> all_rows = {"0,a,1.5", "0,b,-2e-300", "1,a,", "1,b,nan"};
const std::string key = "study 1 | seed 7";

class JournalFixture {
 protected:
  void put(const std::string& text) const { std::ofstream(journal, std::ios::binary) << text; }
  /// A journal of all rows, and its bytes.
  std::string filled() const {
    fs::remove(journal);
    Journal j(output, key);
    j.append({all_rows[0], all_rows[1]});
    j.append({all_rows[2], all_rows[3]});
    return content(journal);
  }
  std::vector<std::string> rows() const { return Journal(output, key).rows(); }

  TemporaryDirectory directory;
  fs::path output = directory.path() / "out.csv";
  fs::path journal = directory.path() / "out.csv.journal";
};

bool is_start_of_all(const std::vector<std::string>& rows) {
  return rows.size() <= all_rows.size() && std::equal(rows.begin(), rows.end(), all_rows.begin());
}

}  // namespace

TEST_CASE_METHOD(JournalFixture, "a journal keeps its rows until the output is finished", "[io][journal]") {
  filled();
  CHECK(rows() == all_rows);
  {
    Journal j(output, key);
    CHECK(j.path() == journal);
    CHECK_FALSE(j.was_damaged());
    j.truncate(9);
    CHECK(j.rows() == all_rows);
    j.truncate(1);
  }
  CHECK(rows() == std::vector<std::string>{all_rows[0]});
  {
    Journal j(output, key);
    j.append({"last"});
    CHECK_FALSE(fs::exists(output));
    j.finish("header");
  }
  CHECK(content(output) == "header\n0,a,1.5\nlast\n");
  CHECK_FALSE(fs::exists(journal));
}

TEST_CASE_METHOD(JournalFixture, "a journal belongs to one key and one process", "[io][journal]") {
  filled();
  CHECK_THROWS_AS(Journal(output, "study 1 | seed 8"), io::InputError);
  CHECK_THROWS_WITH(Journal(output, "other"),
                    Contains("out.csv.journal:1: made with other inputs or options"));
  {
    const Journal open(output, key);
    CHECK_THROWS_WITH(Journal(output, key), Contains("in use by another process"));
  }
  CHECK(rows() == all_rows);
  // Rows that were made under another key are not intact under this one, even if the first line is.
  const std::string foreign = content(journal);
  fs::remove(journal);
  { const Journal other(output, "study 1 | seed 8"); }
  put(content(journal) + foreign.substr(foreign.find('\n') + 1));
  Journal other(output, "study 1 | seed 8");
  CHECK(other.rows().empty());
  CHECK(other.was_damaged());
}

TEST_CASE_METHOD(JournalFixture, "a journal that is cut off anywhere goes on from its last complete row",
                 "[io][journal]") {
  const std::string whole = filled();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CAPTURE(size);
    put(whole.substr(0, size));
    const auto lines = std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size), '\n');
    Journal j(output, key);
    CHECK_FALSE(j.was_damaged());
    REQUIRE(j.rows().size() == static_cast<std::size_t>(std::max<std::ptrdiff_t>(lines - 1, 0)));
    REQUIRE(is_start_of_all(j.rows()));
    j.append(std::vector(all_rows.begin() + static_cast<std::ptrdiff_t>(j.rows().size()), all_rows.end()));
    REQUIRE(content(journal) == whole);
  }
}

TEST_CASE_METHOD(JournalFixture, "a damaged byte is never taken for a result", "[io][journal]") {
  const std::string whole = filled();
  const std::size_t first_line = whole.find('\n') + 1;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const unsigned flipped : {0x01U, 0x08U, 0x80U, 0xFFU}) {
      CAPTURE(at, flipped);
      std::string damaged = whole;
      damaged[at] = static_cast<char>(static_cast<unsigned char>(damaged[at]) ^ flipped);
      put(damaged);
      if (at < first_line) {
        REQUIRE_THROWS_AS(Journal(output, key), io::InputError);
        REQUIRE(content(journal) == damaged);
        continue;
      }
      Journal j(output, key);
      const auto before = std::count(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(at), '\n');
      REQUIRE(j.rows().size() == static_cast<std::size_t>(before - 1));
      REQUIRE(is_start_of_all(j.rows()));
      // The last line without its end is one that was cut off.
      REQUIRE(j.was_damaged() == (at + 1 < whole.size()));
    }
  }
}

TEST_CASE_METHOD(JournalFixture, "a tail of zeros, as a power failure may leave it, is dropped",
                 "[io][journal]") {
  const std::string whole = filled();
  put(whole + std::string(5000, '\0'));
  CHECK(rows() == all_rows);
  CHECK(content(journal) == whole);
}

TEST_CASE_METHOD(JournalFixture, "a file that is no journal is not touched", "[io][journal]") {
  const std::string whole = filled();
  const std::string first_line = whole.substr(0, whole.find('\n'));
  for (const std::string& foreign : {std::string("notes"), std::string("notes\n"),
                                     first_line.substr(0, 5) + "x", std::string(10, '\0') + "x"}) {
    CAPTURE(foreign);
    put(foreign);
    CHECK_THROWS_WITH(Journal(output, key), Contains("out.csv.journal:1: made with other inputs or options"));
    CHECK(content(journal) == foreign);
  }
  put(std::string(4096, '\0'));  // a power failure
  CHECK(rows().empty());
  CHECK(content(journal) == first_line + "\n");
}

TEST_CASE_METHOD(JournalFixture, "a journal is a regular file", "[io][journal]") {
  REQUIRE(::mkfifo(journal.c_str(), 0600) == 0);
  CHECK_THROWS_WITH(Journal(output, key),
                    Contains("out.csv.journal: a pipe or a device: expected a journal"));
  fs::remove(journal);
  fs::create_symlink("/dev/null", journal);
  CHECK_THROWS_AS(Journal(output, key), io::InputError);
}

TEST_CASE_METHOD(JournalFixture, "a journal that cannot be written is reported", "[io][journal]") {
  CHECK_THROWS_AS(Journal(directory.path() / "none" / "out.csv", key), io::OutputError);
  fs::create_directory(journal);
  CHECK_THROWS_WITH(Journal(output, key), Contains("out.csv.journal: cannot be written: Is a directory"));
}
