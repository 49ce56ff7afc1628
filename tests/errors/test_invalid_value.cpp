// The exception for a refused value: its parts, and the sentence that they make.

#include <catch2/catch.hpp>
#include <limits>

#include "errors/invalid_value.hpp"

using errors::InvalidValue;

TEST_CASE("a refused value says field, value and expectation", "[errors]") {
  const InvalidValue error("reading", "none", "one of the readings");
  CHECK(error.field() == "reading");
  CHECK(error.value() == "none");
  CHECK(error.expected() == "one of the readings");
  CHECK(std::string(error.what()) == "reading = none: expected one of the readings");
  CHECK(std::string(InvalidValue("samples", "", "at least one").what()) == "samples: expected at least one");
}

TEST_CASE("a refused number has the fewest digits from which it can be read back", "[errors]") {
  CHECK(InvalidValue("runs", 0, "at least 1").value() == "0");
  CHECK(InvalidValue("seed", std::numeric_limits<unsigned long long>::max(), "less").value() ==
        "18446744073709551615");
  CHECK(InvalidValue("noise", -0.1, "more").value() == "-0.1");
  CHECK(InvalidValue("noise", 1e-300, "more").value() == "1e-300");
  CHECK(InvalidValue("ratio", 1.0 / 3.0, "another").value() == "0.3333333333333333");
  CHECK(InvalidValue("ratio", std::numeric_limits<double>::quiet_NaN(), "a number").value() == "nan");
  CHECK(InvalidValue("ratio", -std::numeric_limits<double>::infinity(), "a number").value() == "-inf");
}
