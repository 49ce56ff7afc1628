// What spreadsheets and editors make of a table: accepted where the meaning is certain, else
// refused with file, line, column, value and what was expected.

#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include "csv_fixture.hpp"

using Catch::Matchers::Contains;

namespace {

constexpr std::size_t huge = 1000000;

struct Accepted {
  const char* what;
  std::string content;  // of a table with a column x that holds 1.5 and -2
};

struct Refused {
  const char* what;
  std::string content;
  std::string message;
};

std::string bytes(const char* text, std::size_t size) {
  return {text, size};
}

}  // namespace

TEST_CASE_METHOD(CsvFixture, "spreadsheet files whose meaning is certain are accepted",
                 "[io][csv][spreadsheet]") {
  const std::vector<Accepted> files = {
      {"CRLF", "x,y\r\n1.5,a\r\n-2,b\r\n"},
      {"CRLF and LF mixed", "x,y\r\n1.5,a\n-2,b\r\n"},
      {"UTF-8 byte order mark", "\xEF\xBB\xBFx,y\n1.5,a\n-2,b\n"},
      {"byte order mark and quotes", "\xEF\xBB\xBF\"x\",\"y\"\r\n\"1.5\",\"a\"\r\n\"-2\",\"b\"\r\n"},
      {"no final newline", "x,y\n1.5,a\n-2,b"},
      {"blank lines", "\n\nx,y\n\n1.5,a\n \t \n-2,b\n\n\n"},
      {"blanks and tabs around cells", " x ,y\n 1.5 ,a\n\t-2\t,b\n"},
      {"blanks inside quotes", "x,y\n\" 1.5 \",a\n\" -2 \",b\n"},
      {"signs and bare points", "x,y\n+1.5,a\n-2.,b\n"},
      {"exponents", "x,y\n15e-1,a\n-.2E+1,b\n"},
      {"leading and trailing zeros", "x,y\n01.50,a\n-002.000,b\n"},
      {"separators inside quotes", "x,y\n1.5,\"a;b,c\"\n-2,\"\"\n"},
      {"other columns", "note,x\n\"measured, twice\",1.5\n,-2\n"},
      {"semicolons in a cell beside commas", "x,y;z\n1.5,a;b\n-2,\n"},
  };
  CHECK(table("\"x;y\"\n1\n").numbers("x;y") == std::vector<double>{1.0});
  CHECK(table("\"x\ty\"\n1\n").numbers("x\ty") == std::vector<double>{1.0});
  for (const auto& [what, content] : files) {
    CAPTURE(what);
    CHECK(table(content).numbers("x") == std::vector<double>{1.5, -2.0});
  }
}

TEST_CASE_METHOD(CsvFixture, "spreadsheet files that could mean something else are refused",
                 "[io][csv][spreadsheet]") {
  const std::vector<Refused> files = {
      {"UTF-16, little end first", bytes("\xFF\xFEx\0,\0", 6),
       "1: column 1: value '\\xFF\\xFE': expected UTF-8 text, not UTF-16"},
      {"UTF-16, big end first", bytes("\xFE\xFF\0x\0,", 6),
       "1: column 1: value '\\xFE\\xFF': expected UTF-8 text, not UTF-16"},
      {"UTF-16 without a mark", bytes("x\0,\0y\0\n\0", 8),
       "1: column 1: value 'x\\x00': expected UTF-8 text without NUL bytes"},
      {"a NUL byte in a cell", bytes("x,y\n1,2\n3,4\0\n", 13),
       "3: column 'y': value '4\\x00': expected UTF-8 text without NUL bytes"},
      {"a NUL byte in quotes", bytes("x,y\n1,\"\0\"\n", 10),
       "2: column 'y': value '\"\\x00': expected UTF-8 text without NUL bytes"},
      {"a workbook", bytes("PK\x03\x04\x14\0\x06\0", 8),
       "1: column 1: value 'PK\\x03\\x04\\x14\\x00\\x06\\x00': expected UTF-8 text without NUL bytes"},
      {"lines that end in CR", "x,y\r1,2\r",
       "1: column 2: value 'y\\r1': expected lines that end in LF or CRLF"},
      {"a CR inside a row", "x,y\n1,2\r3,4\n",
       "2: column 'y': value '2\\r3': expected lines that end in LF or CRLF"},
      {"two CR", "x,y\r\r\n1,2\r\r\n", "1: column 2: value 'y\\r': expected lines that end in LF or CRLF"},
      {"semicolons", "x;y\n1;2\n",
       "1: header 'x;y': expected columns separated by commas, not by semicolons"},
      {"semicolons below a header with commas", "x,y\n1;2\n",
       "2: column 'y': missing value: expected 2 cells, as in the header, not 1"},
      {"semicolons and quotes", "\"x\";\"y\"\n1;2\n",
       "1: header '\"x\";\"y\"': expected columns separated by commas, not by semicolons"},
      {"a separator line", "sep=;\nx;y\n1;2\n",
       "1: header 'sep=;': expected columns separated by commas, not by semicolons"},
      {"decimal commas and semicolons", "x;y\n1,5;2,5\n",
       "1: header 'x;y': expected columns separated by commas, not by semicolons"},
      {"decimal commas and commas", "x,y\n1,5,2,5\n",
       "2: column 3: value '2': expected 2 cells, as in the header, not more"},
      {"tabs", "x\ty\n1\t2\n", "1: header 'x\\ty': expected columns separated by commas, not by tabs"},
      {"trailing commas", "x,y,\n1,2,\n",
       "1: column 3: value '': expected a column name, which only row names in a first column may lack"},
      {"trailing commas in the rows", "x,y\n1,2,\n",
       "2: column 3: value '': expected 2 cells, as in the header, not more"},
      {"a quoted cell over two lines", "x,y\n1,\"two\nlines\"\n",
       "2: column 'y': value '\"two': expected a closing quote on the same line"},
      {"the same column twice", "x,y,x\n1,2,3\n", "1: column 3: value 'x': expected each column name once"},
      {"a header alone", "x,y\n", "1: no rows: expected at least one row after the header"},
      {"a header alone, below blank lines", "\n\nx,y\n\n",
       "3: no rows: expected at least one row after the header"},
      {"nothing", "", "1: empty file: expected a header line"},
      {"a byte order mark alone", "\xEF\xBB\xBF", "1: empty file: expected a header line"},
  };
  for (const auto& [what, content, expected] : files) {
    CAPTURE(what);
    CHECK(refusal(content) == "x.csv:" + expected);
  }
}

TEST_CASE_METHOD(CsvFixture, "row names below an unnamed first column are left out",
                 "[io][csv][spreadsheet]") {
  const std::vector<Accepted> files = {
      {"pandas, to_csv", ",x,y\n0,1.5,a\n1,-2,b\n"},
      {"pandas, a part of the rows in another order", ",x,y\n17,1.5,a\n4,-2,b\n"},
      {"pandas, after concat", ",x,y\n0,1.5,a\n0,-2,b\n"},
      {"R, write.csv", "\"\",\"x\",\"y\"\n\"1\",1.5,\"a\"\n\"2\",-2,\"b\"\n"},
      {"R, row names that are words", "\"\",\"x\"\n\"rig 2\",1.5\n\"rig 3\",-2\n"},
      {"dates", ",x\n2023-05-03,1.5\n2023-05-04,-2\n"},
      {"an empty first column", ",x\n,1.5\n,-2\n"},
      {"byte order mark and CRLF", "\xEF\xBB\xBF,x\r\n0,1.5\r\n1,-2\r\n"},
  };
  for (const auto& [what, content] : files) {
    CAPTURE(what);
    const io::CsvTable t = table(content);
    CHECK(t.numbers("x") == std::vector<double>{1.5, -2.0});
    CHECK(t.column_names().front() == "x");
    CHECK_FALSE(t.has(""));
  }
  CHECK(message([&] { table(",x,y\n0,1.5,a\n1,zero,b\n").numbers("x"); }) ==
        "x.csv:3: column 'x': value 'zero': expected a finite number");
  CHECK(message([&] { table(",lower,upper\nfriction,0,1\n").text("parameter"); }) ==
        "x.csv:1: header ',lower,upper': expected a column 'parameter' "
        "(the first one, without a name, is taken for row names)");
}

TEST_CASE_METHOD(CsvFixture, "columns without a name that are no row names are refused",
                 "[io][csv][spreadsheet]") {
  const std::vector<Refused> files = {
      {"measurements", ",x\n1,1.5\n0.643,-2\n",
       "3: column 1: value '0.643': expected a row number or a row name, since the column has no name in the "
       "header"},
      {"two of them", ",,x\n0,0,1.5\n",
       "1: column 2: value '': expected a column name, which only row names in a first column may lack"},
      {"one further on", "x,\"\",y\n1.5,0,a\n",
       "1: column 2: value '': expected a column name, which only row names in a first column may lack"},
      {"nothing else", "\"\"\n1\n", "1: column 1: value '': expected a column name"},
      {"R, write.table: no place for them in the header", "\"x\",\"y\"\n\"1\",1.5,\"a\"\n\"2\",-2,\"b\"\n",
       "2: column 3: value 'a': expected 2 cells, as in the header, not more "
       "(row names need a column in the header too, and decimals a point)"},
      {"a row that is too short", ",x,y\n0,1.5\n",
       "2: column 'y': missing value: expected 3 cells, as in the header, not 2"},
      {"a row that is too long", ",x\n0,1.5\n1,2,3\n",
       "3: column 3: value '3': expected 2 cells, as in the header, not more"},
  };
  for (const auto& [what, content, expected] : files) {
    CAPTURE(what);
    CHECK(refusal(content) == "x.csv:" + expected);
  }
}

TEST_CASE_METHOD(CsvFixture, "a header behind the sign of a comment is the header",
                 "[io][csv][spreadsheet]") {
  const std::vector<Accepted> files = {
      {"numpy.savetxt", "# x,y\n1.500000e+00,3\n-2.000000e+00,4\n"},
      {"byte order mark and CRLF", "\xEF\xBB\xBF# x,y\r\n1.5,a1\r\n-2,b\r\n"},
      {"blank lines", "\n\n # x,y\n\n1.5,3\n-2,4\n"},
      {"without a blank", "#x,y\n1.5,a\n-2,b\n"},
      {"one column", "# x\n1.5\n-2\n"},
      {"quoted", "# \"x\",\"y,z\"\n\"1.5\",3\n\"-2\",4\n"},
      {"over row numbers", "#,x\n1,1.5\n2,-2\n"},
  };
  for (const auto& [what, content] : files) {
    CAPTURE(what);
    CHECK(table(content).numbers("x") == std::vector<double>{1.5, -2.0});
  }
  CHECK(message([&] { table("# x,y\n\n1.5,3\ntwo,4\n").numbers("x"); }) ==
        "x.csv:4: column 'x': value 'two': expected a finite number");
  CHECK(message([&] { table("# y\n1\n").numbers("x"); }) == "x.csv:1: header 'y': expected a column 'x'");
}

TEST_CASE_METHOD(CsvFixture, "a hash elsewhere is text, or explained on its line", "[io][csv][spreadsheet]") {
  CHECK(table("x,y\n\"#1\",a\n2,#b\n").text("x") == std::vector<std::string>{"#1", "2"});
  CHECK(table("\"#x\",y\n\"# 1\",a\n").text("#x") == std::vector<std::string>{"# 1"});
  const std::vector<Refused> files = {
      {"a comment between rows", "x,y\n1.5,a\n# moved, on 4 May, at noon\n-2,b\n",
       "3: column 'x': value '# moved, on 4 May, at noon': expected 2 cells, as in the header, and no "
       "comments"},
      {"a comment below", "x,y\n1.5,a\n# end\n",
       "3: column 'x': value '# end': expected 2 cells, as in the header, and no comments"},
      {"a row behind the sign of a comment", "x,y\n1.5,a\n#-2,b\n3,c\n",
       "3: column 'x': value '#-2,b': expected 2 cells, as in the header, and no comments"},
      {"the same behind blanks", "x,y\n1.5,a\n  # -2,b\n",
       "3: column 'x': value '# -2,b': expected 2 cells, as in the header, and no comments"},
      {"a comment above the header", "# tower 4, west\nx,y\n1.5,a\n-2,b\n",
       "1: column 1: value '# tower 4, west': expected the header, without lines that begin with # above it"},
      {"a comment below a blank line", "\n##tower 4\nx,y\n1.5,2\n",
       "2: column 1: value '# tower 4': expected the header, without lines that begin with # above it"},
      {"a comment above a commented header", "# tower 4, west\n# x,y\n1.5,3\n",
       "1: column 1: value '# tower 4, west': expected the header, without lines that begin with # above it"},
      {"comments alone", "#\n# \n",
       "1: column 1: value '# ': expected the header, without lines that begin with # above it"},
      {"a NUL byte in a comment", bytes("# a\0b\nx\n1\n", 10),
       "1: column 1: value '# a\\x00b': expected UTF-8 text without NUL bytes"},
      {"lines that end in CR", "# rig 2\rx\r1.5\r",
       "1: column 1: value '# rig 2\\rx\\r1.5': expected lines that end in LF or CRLF"},
  };
  for (const auto& [what, content, expected] : files) {
    CAPTURE(what);
    CHECK(refusal(content) == "x.csv:" + expected);
  }
  const std::filesystem::path path = directory.path() / "out.csv";
  io::CsvWriter writer(path, {"#x", "y"});
  writer.row("# 1", "#");
  writer.commit();
  CHECK(io::CsvTable::read(path).text("#x") == std::vector<std::string>{"# 1"});
}

TEST_CASE_METHOD(CsvFixture, "a refusal carries its parts", "[io][csv]") {
  try {
    std::ignore = table("x,y\n1,2\n3,four\n").numbers("y");
    FAIL("accepted");
  } catch (const io::InputError& error) {
    const io::InputFault& fault = error.fault();
    CHECK(fault.path == directory.path() / "x.csv");
    CHECK(fault.line == 3);
    CHECK(fault.column == "'y'");
    CHECK(fault.found == "value 'four'");
    CHECK(fault.expected == "a finite number");
    CHECK(error.what() == io::describe(fault));
  }
}

TEST_CASE_METHOD(CsvFixture, "cells of spreadsheets that are no number are refused",
                 "[io][csv][spreadsheet]") {
  for (const std::string comma : {"1,5", "1,000", "1,000.5", "0,5e3", ","}) {
    CHECK(number_refusal("\"" + comma + "\"") ==
          "x.csv:3: column 'b': value '" + comma +
              "': expected a finite number with a decimal point, not a comma");
  }
  for (const std::string cell : {"",
                                 "1_000",
                                 "1'000",
                                 "1 000",
                                 "1\xC2\xA0"
                                 "000",
                                 "0x1p3",
                                 "1.5f",
                                 "1.5 N",
                                 "50%",
                                 "$1",
                                 "(1)",
                                 "=A1",
                                 "#N/A",
                                 "#DIV/0!",
                                 "TRUE",
                                 "12:30",
                                 "2023-09-03",
                                 "1/2",
                                 "1D5",
                                 "\xE2\x88\x92"
                                 "1",
                                 "nan",
                                 "inf",
                                 "1.#INF",
                                 "NULL",
                                 "-"}) {
    CHECK(number_refusal(cell) == "x.csv:3: column 'b': value '" + cell + "': expected a finite number");
  }
  for (const std::string cell : {"1e400", "-1e400", "1e-400"}) {
    CHECK(number_refusal(cell) ==
          "x.csv:3: column 'b': value '" + cell + "': expected a finite number within the range of a double");
  }
  CHECK(message([&] { table("a\n\"1,5\"\n").numbers_or_nan("a"); }) ==
        "x.csv:2: column 'a': value '1,5': expected a number with a decimal point, not a comma");
}

TEST_CASE_METHOD(CsvFixture, "huge cells, lines and headers are read or refused in one short line",
                 "[io][csv][spreadsheet]") {
  const std::string cell(huge, '7');
  CHECK(table("a,b\n" + cell + ",1\n").cell(0, "a") == cell);
  CHECK(number_refusal(cell) == "x.csv:3: column 'b': value '" + cell.substr(0, 40) +
                                    "...': expected a finite number within the range of a double");
  // A million digits of a number that a double can hold.
  CHECK(table("a\n0." + std::string(huge, '3') + "\n").numbers("a") == std::vector<double>{1.0 / 3.0});

  std::string header = "c0";
  std::string row = "0";
  for (std::size_t i = 1; i < 2000; ++i) {
    header.append(",c").append(std::to_string(i));
    row.append(",").append(std::to_string(i));
  }
  CHECK(table(header + "\n" + row + "\n").numbers("c1999") == std::vector<double>{1999.0});
  CHECK(message([&] { table(header + "\n" + row + "\n").numbers("d"); }).size() < 300);
  CHECK_THAT(refusal("a,b\n1" + std::string(huge, ',') + "\n"), Contains("x.csv:2: column 3: value ''"));
  CHECK_THAT(refusal("a,b\n1,\"" + cell + "\n"), Contains("x.csv:2: column 'b'"));
  CHECK(refusal("a,b\n1,\"" + cell + "\n").size() < 200);
  CHECK(refusal(std::string(huge, '\n')) == "x.csv:1: empty file: expected a header line");
  CHECK_THAT(refusal("a,b" + std::string(huge, '\n') + "1\n"), Contains("x.csv:1000001: column 'b'"));
}

TEST_CASE_METHOD(CsvFixture, "a file beyond 4 GiB is refused before it is read", "[io][csv][spreadsheet]") {
  const std::filesystem::path path = put("a\n1\n");
  std::filesystem::resize_file(path, (std::uintmax_t{1} << 32U) + 1);
  CHECK(message([&] { io::CsvTable::read(path); }) ==
        "x.csv: 4294967297 bytes or more: expected a CSV file of at most 4294967296 bytes");
}
