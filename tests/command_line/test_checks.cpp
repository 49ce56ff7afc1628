// Checks of option values: what they accept in the form that CLI11 parses, and what they say of the
// rest.

#include <catch2/catch.hpp>
#include <string>

#include "command_line/build_info.hpp"
#include "command_line/checks.hpp"

using namespace command_line;

namespace {

/// The word as the check leaves it, or its complaint.
std::string checked(const CLI::Validator& check, std::string word) {
  const std::string complaint = check(word);
  return complaint.empty() ? word : complaint;
}

}  // namespace

TEST_CASE("whole numbers are normalised, and others refused with the range", "[command_line]") {
  CHECK(checked(count(1, 2000000), "1e6") == "1000000");
  CHECK(checked(count(1, 100), "010") == "10");  // CLI11 would take it for octal
  CHECK(checked(count(1, 100), "0") == "value '0': expected a whole number from 1 to 100");
  CHECK(checked(count(1, 100), "101") == "value '101': expected a whole number from 1 to 100");
  CHECK(checked(count(1, 100), "1.5") == "value '1.5': expected a whole number from 1 to 100");
  CHECK(checked(count(1, 100), "7x") == "value '7x': expected a whole number from 1 to 100");
  CHECK(checked(count(1, 100), "nan") == "value 'nan': expected a whole number from 1 to 100");
}

TEST_CASE("seeds have all of their 64 bits", "[command_line]") {
  CHECK(checked(seed(), "18446744073709551615") == "18446744073709551615");
  CHECK(checked(seed(), "0") == "0");
  for (const char* word : {"18446744073709551616", "-1", "1e3", ""}) {
    CHECK(checked(seed(), word) ==
          "value '" + std::string(word) + "': expected a whole number from 0 to 2^64 - 1");
  }
}

TEST_CASE("positive numbers are those whose squares are numbers", "[command_line]") {
  CHECK(checked(positive(), "2.50") == "2.5");
  for (const char* word : {"0", "-1", "inf", "nan", "1e101", "1e-101", "2,5"}) {
    CHECK(checked(positive(), word) ==
          "value '" + std::string(word) + "': expected a positive number from 1e-100 to 1e100");
  }
  CHECK(checked(non_negative(), "0") == "0");
  CHECK(checked(non_negative(), "-0.1") ==
        "value '-0.1': expected 0 or a positive number from 1e-100 to 1e100");
}

TEST_CASE("a choice is one of its words, and control characters are shown as escapes", "[command_line]") {
  CHECK(checked(one_of({"a", "b", "c"}), "b") == "b");
  CHECK(checked(one_of({"a", "b", "c"}), "B") == "value 'B': expected a, b or c");
  CHECK(checked(one_of({"a"}), "a\nb") == "value 'a\\nb': expected a");
}

TEST_CASE("data files are those of the source tree where the current directory has none", "[command_line]") {
  CHECK(data_file("published", "no_such_file.csv") ==
        source_directory() + "/data/published/no_such_file.csv");
  CHECK(version().find('.') != std::string::npos);
}
