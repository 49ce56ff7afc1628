#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "csv_fixture.hpp"

using Catch::Matchers::Contains;
using io::CsvTable;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Processor time of this program, s, which other programs do not lengthen.
double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

TEST_CASE_METHOD(CsvFixture, "a table gives its columns, rows and lines", "[io][csv]") {
  const CsvTable t = table("time_s,count,name\n0.5,3,first\n-1e-3,-4,\"second, quoted\"\n");
  CHECK(t.rows() == 2);
  CHECK(t.path().filename() == "x.csv");
  CHECK(t.column_names() == std::vector<std::string>{"time_s", "count", "name"});
  CHECK(t.has("count"));
  CHECK_FALSE(t.has("Count"));
  CHECK(t.line(1) == 3);
  CHECK(t.cell(1, "name") == "second, quoted");
  CHECK(t.numbers("time_s") == std::vector<double>{0.5, -1e-3});
  CHECK(t.numbers("count") == std::vector<double>{3, -4});
  CHECK(t.integers("count") == std::vector<long>{3, -4});
  CHECK(t.text("name") == std::vector<std::string>{"first", "second, quoted"});
  CHECK_THROWS_AS(t.line(2), std::out_of_range);
  CHECK_THROWS_AS(t.cell(2, "name"), std::out_of_range);
  CHECK_NOTHROW(t.require_columns({"name", "time_s"}));
}

TEST_CASE_METHOD(CsvFixture, "a table outlives copies and moves", "[io][csv]") {
  CsvTable first = table("a\n1\n");
  const CsvTable copy = first;
  const CsvTable moved = std::move(first);
  CHECK(copy.cell(0, "a") == "1");
  CHECK(moved.numbers("a") == std::vector<double>{1});
}

TEST_CASE_METHOD(CsvFixture, "harmless varieties of the format are accepted", "[io][csv]") {
  const std::vector<double> expected{1.5, -2};
  CHECK(table("a,b\r\n1.5,x\r\n-2,y\r\n").numbers("a") == expected);
  CHECK(table("\xEF\xBB\xBF"
              "a,b\n1.5,x\n-2,y")
            .numbers("a") == expected);
  CHECK(table("a , b\n \t1.5\t ,x\n-2,y\n").numbers("a") == expected);
  CHECK(table("a,b\n+1.5,x\n-2.,y\n").numbers("a") == expected);
  CHECK(table("\na,b\n\n1.5,x\n  \t\n-2,y\n\n\r\n").numbers("a") == expected);
  CHECK(table("\"a\",\"b\"\n\"1.5\", \"x\" \n\" -2 \",y\n").numbers("a") == expected);
  CHECK(table("a\n1\n\n2\n").line(1) == 4);
  CHECK(table("a,b\n1,\r").text("b") == std::vector<std::string>{""});
}

TEST_CASE_METHOD(CsvFixture, "quotes are read as RFC 4180 has them", "[io][csv]") {
  CHECK(table("a,b\n\"say \"\"hi\"\"\",\"\"\n").cell(0, "a") == "say \"hi\"");
  CHECK(table("a,b\n\" kept \",\"\"\n").cell(0, "a") == " kept ");
  CHECK(table("a,b\n\"\"\"\",x\n").cell(0, "a") == "\"");
  CHECK(table("a,b\n\"\",x\n").cell(0, "a").empty());
  CHECK(refusal("a,b\n1,\"open\n2,3\n") ==
        "x.csv:2: column 'b': value '\"open': expected a closing quote on the same line");
  CHECK(refusal("a,b\n\"1\"2,3\n") ==
        "x.csv:2: column 'a': value '\"1\"2,3': expected a comma after the closing quote");
  CHECK(refusal("a,b\n1\"2,3\n") ==
        "x.csv:2: column 'a': value '1\"2': expected quotes around the whole cell");
  CHECK(refusal("a,\"b\n1,2\n") ==
        "x.csv:1: column 2: value '\"b': expected a closing quote on the same line");
}

TEST_CASE_METHOD(CsvFixture, "files that cannot be read say why", "[io][csv]") {
  CHECK(message([&] { CsvTable::read(directory.path() / "none.csv"); }) ==
        "none.csv: cannot be read: No such file or directory: expected a CSV file");
  CHECK_THAT(message([&] { CsvTable::read(directory.path()); }), Contains("Is a directory"));
  CHECK_THAT(message([&] { CsvTable::read(""); }), Contains("No such file"));
  CHECK_THAT(message([&] { CsvTable::read(put("a\n1\n") / "below.csv"); }), Contains("Not a directory"));
  CHECK_THAT(message([&] { CsvTable::read(directory.path() / "two\nlines.csv"); }),
             Contains("two\\nlines.csv"));
}

TEST_CASE_METHOD(CsvFixture, "files without header or rows are refused", "[io][csv]") {
  CHECK(refusal("") == "x.csv:1: empty file: expected a header line");
  CHECK(refusal("\n \n") == "x.csv:1: empty file: expected a header line");
  CHECK(refusal("\xEF\xBB\xBF") == "x.csv:1: empty file: expected a header line");
  CHECK(refusal("a,b\n") == "x.csv:1: no rows: expected at least one row after the header");
  CHECK(refusal("a,b\n\n\n") == "x.csv:1: no rows: expected at least one row after the header");
}

TEST_CASE_METHOD(CsvFixture, "headers that name columns badly are refused", "[io][csv]") {
  CHECK(refusal("a,b,a\n1,2,3\n") == "x.csv:1: column 3: value 'a': expected each column name once");
  CHECK(
      refusal("a,,b\n1,2,3\n") ==
      "x.csv:1: column 2: value '': expected a column name, which only row names in a first column may lack");
  CHECK(
      refusal("a,b,\n1,2,\n") ==
      "x.csv:1: column 3: value '': expected a column name, which only row names in a first column may lack");
  CHECK(refusal("a;b\n1,5;2\n") ==
        "x.csv:1: header 'a;b': expected columns separated by commas, not by semicolons");
  CHECK(refusal("a\tb\n1\t2\n") ==
        "x.csv:1: header 'a\\tb': expected columns separated by commas, not by tabs");
  const std::string missing = "x.csv:1: header 'a,b': expected a column 'phase_deg'";
  CHECK(message([&] { table("a,b\n1,2\n").require_columns({"a", "phase_deg"}); }) == missing);
  CHECK(message([&] { table("a,b\n1,2\n").numbers("phase_deg"); }) == missing);
  CHECK(message([&] { table("a,b\n1,2\n").cell(0, "phase_deg"); }) == missing);
}

TEST_CASE_METHOD(CsvFixture, "rows with too few or too many cells are refused", "[io][csv]") {
  CHECK(refusal("a,b\n1,2\n3\n") ==
        "x.csv:3: column 'b': missing value: expected 2 cells, as in the header, not 1");
  CHECK(refusal("a,b\n1,2,7\n") ==
        "x.csv:2: column 3: value '7': expected 2 cells, as in the header, not more "
        "(row names need a column in the header too, and decimals a point)");
  CHECK(refusal("a,b\n1,2,\n") ==
        "x.csv:2: column 3: value '': expected 2 cells, as in the header, not more");
  CHECK(refusal("a,b\n1,5,2\n") ==
        "x.csv:2: column 3: value '2': expected 2 cells, as in the header, not more "
        "(row names need a column in the header too, and decimals a point)");
}

TEST_CASE_METHOD(CsvFixture, "cells that are no finite number are refused", "[io][csv]") {
  for (const std::string cell : {"abc",
                                 "",
                                 "1.5x",
                                 "0x1p3",
                                 "0x10",
                                 "1 2",
                                 "+-1",
                                 "++1",
                                 "+",
                                 "-",
                                 ".",
                                 "e5",
                                 "1e",
                                 "1_0",
                                 "--1",
                                 "1.5.2",
                                 "nan",
                                 "NaN",
                                 "inf",
                                 "-inf",
                                 "Infinity",
                                 "nan(1)",
                                 "\xE2\x88\x92"
                                 "1"}) {
    CAPTURE(cell);
    CHECK(number_refusal("\"" + cell + "\"") ==
          "x.csv:3: column 'b': value '" + cell + "': expected a finite number");
  }
  for (const std::string cell : {"1e400", "-1e400", "1e-400"}) {
    CHECK(number_refusal(cell) ==
          "x.csv:3: column 'b': value '" + cell + "': expected a finite number within the range of a double");
  }
}

TEST_CASE_METHOD(CsvFixture, "numbers are correctly rounded over the whole range", "[io][csv]") {
  const CsvTable t = table(
      "a\n1.7976931348623157e308\n5e-324\n2.2250738585072011e-308\n0.1\n-0\n9007199254740993\n"
      "0e400\n1E5\n.5\n");
  const std::vector<double> values = t.numbers("a");
  CHECK(values == std::vector<double>{std::numeric_limits<double>::max(), 0x1p-1074, 2.2250738585072011e-308,
                                      0.1, 0.0, 9007199254740992.0, 0.0, 1e5, 0.5});
  CHECK(std::signbit(values[4]));
}

TEST_CASE_METHOD(CsvFixture, "generated files may hold nan and inf", "[io][csv]") {
  const std::vector<double> values = table("a\nnan\nNaN\ninf\n-inf\n+Inf\n-nan\n2\n").numbers_or_nan("a");
  CHECK(std::isnan(values[0]));
  CHECK(std::isnan(values[1]));
  CHECK(values[2] == infinity);
  CHECK(values[3] == -infinity);
  CHECK(values[4] == infinity);
  CHECK(std::isnan(values[5]));
  CHECK(values[6] == 2.0);
  for (const std::string cell : {"nan(1)", "na", "nanx", "word", "\"\""}) {
    CHECK_THAT(message([&] { table("a\n" + cell + "\n").numbers_or_nan("a"); }),
               Contains("expected a number, nan or inf"));
  }
  CHECK_THAT(message([&] { table("a\n1e400\n").numbers_or_nan("a"); }), Contains("within the range"));
}

TEST_CASE_METHOD(CsvFixture, "integers are whole and fit", "[io][csv]") {
  CHECK(table("a\n+7\n-9223372036854775808\n 0 \n").integers("a") ==
        std::vector<long>{7, std::numeric_limits<long>::min(), 0});
  for (const std::string cell : {"1.0", "1e3", "x", "\"\"", "0x1", "nan", "+-1"}) {
    CHECK_THAT(message([&] { table("a\n" + cell + "\n").integers("a"); }), Contains("expected an integer"));
  }
  CHECK_THAT(message([&] { table("a\n9223372036854775808\n").integers("a"); }), Contains("at most 64 bits"));
}

TEST_CASE_METHOD(CsvFixture, "messages stay one short printable line", "[io][csv]") {
  CHECK(number_refusal("a\x1B[31m\x07\x7F") ==
        "x.csv:3: column 'b': value 'a\\x1B[31m\\x07\\x7F': expected a finite number");
  CHECK(number_refusal(std::string(1000, 'x')) ==
        "x.csv:3: column 'b': value '" + std::string(40, 'x') + "...': expected a finite number");
  CHECK(number_refusal(std::string(40, 'x')) ==
        "x.csv:3: column 'b': value '" + std::string(40, 'x') + "': expected a finite number");
  CHECK(number_refusal("\xE9t\xC3\xA9") ==
        "x.csv:3: column 'b': value '\\xE9t\xC3\xA9': expected a finite number");
  CHECK(refusal("a,b\r1,2\r") == "x.csv:1: column 2: value 'b\\r1': expected lines that end in LF or CRLF");
  CHECK(refusal(std::string("a,b\n1,\0", 7)) ==
        "x.csv:2: column 'b': value '\\x00': expected UTF-8 text without NUL bytes");
}

TEST_CASE("an endless source of zeros is refused", "[io][csv]") {
  CHECK_THROWS_AS(CsvTable::read("/dev/zero"), io::InputError);
}

TEST_CASE("printable escapes, keeps UTF-8 and never cuts inside a character", "[io][csv]") {
  CHECK(io::printable("a\nb\tc\rd") == "a\\nb\\tc\\rd");
  CHECK(io::printable("\xC3\xA9\xC3\xA9", 3) == "\xC3\xA9...");
  CHECK(io::printable("\xC3") == "\\xC3");
  CHECK(io::printable("\xC2\x9B"
                      "31m") == "\\xC2\\x9B31m");
  CHECK(io::printable("\u2028") == "\\xE2\\x80\\xA8");
  CHECK(io::printable("abc", 3) == "abc");
  CHECK(io::printable("").empty());
}

TEST_CASE_METHOD(CsvFixture, "the caller can refuse a cell in the same words", "[io][csv]") {
  const CsvTable t = table("case,phase_deg\n1,20\n\n2,400\n");
  CHECK(message([&] { t.fail(1, "phase_deg", "an angle in [-180, 180]"); }) ==
        "x.csv:4: column 'phase_deg': value '400': expected an angle in [-180, 180]");
}

TEST_CASE_METHOD(CsvFixture, "a large table takes no quadratic time", "[io][csv]") {
  constexpr std::size_t rows = 100000;
  std::string content = "a,b,c,d,e,f\n";
  for (std::size_t i = 0; i < rows; ++i) {
    content += "0.12345678901234567,-1.5e-7,3,123456.789,-0.333333333333333,1e10\n";
  }
  const std::filesystem::path path = put(content);
  const double start = processor_time();
  const CsvTable t = CsvTable::read(path);
  double sum = 0.0;
  for (const std::string& name : t.column_names()) sum += t.numbers(name).back();
  const double elapsed = processor_time() - start;
  CHECK(t.rows() == rows);
  CHECK(sum > 1e10);
  // Loose, because instrumented builds are slow: an algorithm that is quadratic in the rows takes
  // minutes.
  CHECK(elapsed < 5.0);
}

TEST_CASE_METHOD(CsvFixture, "a long table of one column takes no quadratic time", "[io][csv]") {
  constexpr std::size_t rows = 300000;
  std::string content = "a\n";
  for (std::size_t i = 0; i < rows; ++i) content += "0.125\n";
  const std::filesystem::path path = put(content);
  const double start = processor_time();
  CHECK(CsvTable::read(path).numbers("a").size() == rows);
  const double elapsed = processor_time() - start;
  CHECK(elapsed < 5.0);
}

TEST_CASE_METHOD(CsvFixture, "a table of many columns takes no quadratic time", "[io][csv]") {
  constexpr std::size_t columns = 100000;
  std::string line = "0";
  for (std::size_t i = 1; i < columns; ++i) line.append(",").append(std::to_string(i));
  const std::filesystem::path path = put(line + "\n" + line + "\n");
  const double start = processor_time();
  const CsvTable t = CsvTable::read(path);
  bool right = t.column_names().size() == columns;
  for (std::size_t i = 0; i < columns; i += 10) {
    right = right && t.cell(0, std::to_string(i)) == std::to_string(i);
  }
  const double elapsed = processor_time() - start;
  CHECK(right);
  CHECK(elapsed < 5.0);
}

TEST_CASE("numbers are written in the shortest form that reads back", "[io][csv]") {
  CHECK(io::format_number(0.1) == "0.1");
  CHECK(io::format_number(1.0) == "1");
  CHECK(io::format_number(-2.5e-7) == "-2.5e-07");
  CHECK(io::format_number(1.0 / 3.0) == "0.3333333333333333");
  CHECK(io::format_number(5e-324) == "5e-324");
  CHECK(io::format_number(infinity) == "inf");
  CHECK(io::format_number(-infinity) == "-inf");
  CHECK(io::format_number(std::numeric_limits<double>::quiet_NaN()) == "nan");
  CHECK(io::format_number(std::copysign(std::numeric_limits<double>::quiet_NaN(), -1.0)) == "nan");
}

TEST_CASE_METHOD(CsvFixture, "what is written is read back exactly", "[io][csv]") {
  const std::filesystem::path path = directory.path() / "out.csv";
  const std::vector<double> tail{1.0 / 3.0, std::numeric_limits<double>::denorm_min()};
  const std::vector<std::string> texts{"plain", "a,b", "say \"hi\"", " padded ", "", "semi;colon", "\tt"};
  {
    io::CsvWriter writer(path, {"text", "int", "size", "x", "y"});
    for (const std::string& text : texts) writer.row(text, -3, std::size_t{7}, tail);
    writer.row("literal", std::int64_t{1} << 40, 2U, infinity, std::numeric_limits<double>::quiet_NaN());
    CHECK_FALSE(std::filesystem::exists(path));
    writer.commit();
  }
  const CsvTable t = CsvTable::read(path);
  REQUIRE(t.rows() == texts.size() + 1);
  const std::vector<std::string> read_texts = t.text("text");
  CHECK(std::vector(read_texts.begin(), std::prev(read_texts.end())) == texts);
  CHECK(t.integers("int").front() == -3);
  CHECK(t.integers("int").back() == 1099511627776L);
  CHECK(t.integers("size").front() == 7);
  CHECK(t.numbers_or_nan("x").front() == tail[0]);
  CHECK(t.numbers_or_nan("x").back() == infinity);
  CHECK(t.numbers_or_nan("y").front() == tail[1]);
  CHECK(std::isnan(t.numbers_or_nan("y").back()));
}

TEST_CASE_METHOD(CsvFixture, "the written bytes are plain", "[io][csv]") {
  const std::filesystem::path path = directory.path() / "out.csv";
  io::CsvWriter writer(path, {"a", "b c", "d,e"});
  writer.row(1, 0.5, "two\nlines");
  writer.commit();
  CHECK(content(path) == "a,b c,\"d,e\"\n1,0.5,\"two\nlines\"\n");
}

TEST_CASE_METHOD(CsvFixture, "rows of the wrong length are a mistake of the program", "[io][csv]") {
  const std::filesystem::path path = directory.path() / "out.csv";
  io::CsvWriter writer(path, {"a", "b"});
  CHECK_THROWS_AS(writer.row(1.0), std::logic_error);
  CHECK_THROWS_AS(writer.row(1.0, 2.0, 3.0), std::logic_error);
  CHECK_THROWS_AS(writer.row(std::vector<double>{}), std::logic_error);
  writer.row(4.0, 5.0);
  writer.commit();
  CHECK(CsvTable::read(path).numbers("a") == std::vector<double>{4.0});
  CHECK_THROWS_AS(writer.row(1.0, 2.0), std::logic_error);
  CHECK_THROWS_AS(io::CsvWriter(path, {}), std::logic_error);
  CHECK_THROWS_AS(io::CsvWriter(path, {"a", "a"}), std::logic_error);
  CHECK_THROWS_AS(io::CsvWriter(path, {"a", ""}), std::logic_error);
}

TEST_CASE_METHOD(CsvFixture, "column names with separators and byte order marks are read back", "[io][csv]") {
  const std::filesystem::path path = directory.path() / "out.csv";
  for (const std::string name : {"a;b", "a\tb", "a,b",
                                 "\xEF\xBB\xBF"
                                 "a",
                                 "\xFF\xFE", "\xFE\xFF", " ", "\""}) {
    CAPTURE(name);
    io::CsvWriter writer(path, {name});
    writer.row(1.5);
    writer.commit();
    CHECK(CsvTable::read(path).numbers(name) == std::vector<double>{1.5});
  }
}

TEST_CASE("a full disk is reported", "[io][csv]") {
  io::CsvWriter writer("/dev/full", {"a"});
  writer.row(1.0);
  CHECK_THROWS_AS(writer.commit(), io::OutputError);
}
