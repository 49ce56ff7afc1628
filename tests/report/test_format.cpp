#include <catch2/catch.hpp>
#include <limits>

#include "report/format.hpp"

using report::escape_tex;
using report::format_tex;
using report::FormatError;

TEST_CASE("numbers are rounded to significant digits, zeros kept", "[format]") {
  CHECK(format_tex(0.99618, "") == "0.996");
  CHECK(format_tex(0.12, "") == "0.120");
  CHECK(format_tex(13.369, "") == "13.4");
  CHECK(format_tex(400.4, "") == "400");
  CHECK(format_tex(0.081514, "s4") == "0.08151");
  CHECK(format_tex(0.9996, "s3") == "1.00");  // rounding carries
  CHECK(format_tex(9.96, "s2") == "10");
  CHECK(format_tex(0.0, "") == "0");
  CHECK(format_tex(1.0358504, "f3") == "1.036");
  CHECK(format_tex(2.0, "f0") == "2");
}

TEST_CASE("a negative number is mathematics, and none rounds to minus zero", "[format]") {
  CHECK(format_tex(-1.5729, "") == "\\ensuremath{-1.57}");
  CHECK(format_tex(-0.004, "f1") == "0.0");
}

TEST_CASE("small and large numbers are powers of ten", "[format]") {
  CHECK(format_tex(1.629e-6, "s2") == "\\ensuremath{1.6\\times10^{-6}}");
  CHECK(format_tex(-1e10, "s1") == "\\ensuremath{-1\\times10^{10}}");
  CHECK(format_tex(0.00012345, "") == "0.000123");
  CHECK(format_tex(0.000099996, "s3") == "0.000100");
  CHECK(format_tex(999999.0, "s3") == "\\ensuremath{1.00\\times10^{6}}");
  CHECK(format_tex(123456.0, "s3") == "123\\,456");  // digits before the point are never dropped
}

TEST_CASE("integers and percentages", "[format]") {
  CHECK(format_tex(1000.0, "integer") == "1000");
  CHECK(format_tex(31000.0, "integer") == "31\\,000");
  CHECK(format_tex(1234567.0, "integer") == "1\\,234\\,567");
  CHECK(format_tex(-20000.0, "integer") == "\\ensuremath{-20\\,000}");
  CHECK(format_tex(0.8469, "percent") == "84.7");
  CHECK(format_tex(0.0753, "percent2") == "7.5");
}

TEST_CASE("formats and numbers that do not fit are refused", "[format]") {
  CHECK_THROWS_AS(format_tex(0.5, "integer"), FormatError);
  CHECK_THROWS_AS(format_tex(1.0, "s0"), FormatError);
  CHECK_THROWS_AS(format_tex(1.0, "s16"), FormatError);
  CHECK_THROWS_AS(format_tex(1.0, "s"), FormatError);
  CHECK_THROWS_AS(format_tex(1.0, "s2x"), FormatError);
  CHECK_THROWS_AS(format_tex(1.0, "f-1"), FormatError);
  CHECK_THROWS_AS(format_tex(1.0, "digits"), FormatError);
  CHECK_THROWS_AS(format_tex(std::numeric_limits<double>::quiet_NaN(), ""), FormatError);
  CHECK_THROWS_AS(format_tex(std::numeric_limits<double>::infinity(), "f2"), FormatError);
}

TEST_CASE("text is escaped, known symbols become mathematics", "[format]") {
  CHECK(escape_tex("P(F_mu > 1 N) is 5 %") == "P($F_\\mu$ \\textgreater{} 1 N) is 5 \\%");
  CHECK(escape_tex("a_b & {c} #1 ~^\\ $") ==
        "a\\_b \\& \\{c\\} \\#1 \\textasciitilde{}\\textasciicircum{}\\textbackslash{} \\$");
  CHECK(escape_tex("chi^2 of N / (1 + CoV^2)") == "$\\chi^2$ of N / (1 + $\\mathrm{CoV}^2$)");
  CHECK(escape_tex("") == "");
}
