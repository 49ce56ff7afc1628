#include <catch2/catch.hpp>
#include <fstream>

#include "io/temporary_directory.hpp"
#include "report/values.hpp"

using Catch::Matchers::Contains;

namespace {

class ReportFixture {
 protected:
  ReportFixture() {
    put("data.csv",
        "sampler,run,area,low,word\n"
        "A,0,1,0.5,first_one\n"
        "A,1,2,0.5,x\n"
        "A,2,6,0.25,x\n"
        "B,0,4,nan,100 %\n");
  }
  void put(const std::string& name, const std::string& content) {
    std::ofstream(directory.path() / name, std::ios::binary) << content;
  }
  io::CsvTable list(const std::string& header, const std::string& rows) {
    put("list.csv", header + "\n" + rows);
    return io::CsvTable::read(directory.path() / "list.csv");
  }
  std::string values(const std::string& rows) {
    return report::tex_values(list("key,file,where,column,statistic,format", rows), roots);
  }
  /// TeX of the last value of a list.
  std::string value(const std::string& rows) {
    const std::string tex = values(rows);
    const auto begin = tex.rfind("}{") + 2;
    return tex.substr(begin, tex.size() - 2 - begin);
  }
  std::string tables(const std::string& rows) {
    return report::tex_tables(list("key,file,where,columns", rows), roots);
  }

  TemporaryDirectory directory;
  report::Roots roots = {{"generated", directory.path()}};
};

}  // namespace

TEST_CASE_METHOD(ReportFixture, "statistics of the rows that meet the conditions", "[values]") {
  const auto area = [&](const std::string& statistic) {
    return value("k,generated/data.csv,sampler=A,area," + statistic + ",\n");
  };
  CHECK(area("count") == "3.00");
  CHECK(area("sum") == "9.00");
  CHECK(area("mean") == "3.00");
  CHECK(area("sd") == "2.65");
  CHECK(area("min") == "1.00");
  CHECK(area("max") == "6.00");
  CHECK(area("median") == "2.00");
  CHECK(area("q025") == "1.05");
  CHECK(area("q975") == "5.80");
  CHECK(value("k,generated/data.csv,,area,sum,\n") == "13.0");
  CHECK(value("k,generated/data.csv,sampler=A;run=2,area,value,\n") == "6.00");
  CHECK(value("k,generated/data.csv,sampler!=A,area,value,\n") == "4.00");
  CHECK(value("k,generated/data.csv,word=first*,area,value,\n") == "1.00");
  CHECK(value("k,generated/data.csv,low!=nan,low - area,max_abs,\n") == "5.75");
  CHECK(value("k,generated/data.csv,low!=nan,low - area,max,\n") == "\\ensuremath{-0.500}");
}

TEST_CASE_METHOD(ReportFixture, "texts stand as in the file", "[values]") {
  CHECK(values("word,generated/data.csv,sampler=B,word,value,text\n") == "\\reportvalue{word}{100 \\%}\n");
  CHECK(value("k,generated/data.csv,run=0;sampler=A,word,value,name\n") == "\\columnname{first_one}");
}

TEST_CASE_METHOD(ReportFixture, "derived values use numbers before rounding", "[values]") {
  const std::string two =
      "a,generated/data.csv,sampler=A,area,mean,f0\nb,generated/data.csv,sampler=A,area,sd,f0\n";
  CHECK(value(two + "c,,,a b,ratio,s4\n") == "1.134");
  CHECK(value(two + "c,,,a b,sum,s4\n") == "5.646");
  CHECK(value(two + "c,,,a b,difference,s4\n") == "0.3542");
  CHECK(value(two + "c,,,a b,product,s4\n") == "7.937");
  CHECK(value(two + "c,,,a b,less,\n") == "no");
  CHECK(value(two + "c,,,b a,less,\n") == "yes");
}

TEST_CASE_METHOD(ReportFixture, "tables hold the rows in the order of the file", "[values]") {
  CHECK(tables("t,generated/data.csv,run=0,sampler:text area:integer low:f1\n") ==
        "\\reporttable{t}{%\nA & 1 & 0.5 \\\\\nB & 4 & -- \\\\\n}\n");
}

TEST_CASE_METHOD(ReportFixture, "a bad list names file, line, column and value", "[values]") {
  const auto refuses = [&](const std::string& rows, const std::string& what) {
    CHECK_THROWS_WITH(values(rows), Contains("list.csv:") && Contains(what));
  };
  refuses("K,generated/data.csv,,area,sum,\n", "column 'key': value 'K'");
  refuses("k,generated/data.csv,,area,sum,\nk,generated/data.csv,,area,sum,\n", "list.csv:3: column 'key'");
  refuses("k,elsewhere/data.csv,,area,sum,\n", "column 'file': value 'elsewhere/data.csv'");
  refuses("k,generated/data.csv,sampler,area,sum,\n", "column 'where': value 'sampler'");
  refuses("k,generated/data.csv,sampler=C,area,sum,\n", "column 'where': value 'sampler=C'");
  refuses("k,generated/data.csv,sampler=A,area,value,\n", "one row meets, not 3");
  refuses("k,generated/data.csv,,area,mode,\n", "column 'statistic': value 'mode'");
  refuses("k,generated/data.csv,,area,sum,roman\n", "column 'format': value 'roman'");
  refuses("k,,,a b,sum,\n", "column 'column': value 'a b'");
  refuses("a,generated/data.csv,,area,sum,\nk,,,a a,power,\n", "column 'statistic': value 'power'");
  refuses("a,generated/data.csv,sampler=B,word,value,text\nk,,,a a,less,\n", "column 'statistic'");
  CHECK_THROWS_WITH(values("k,generated/data.csv,,low,sum,\n"), Contains("data.csv:5: column 'low'"));
  CHECK_THROWS_WITH(values("k,generated/none.csv,,low,sum,\n"), Contains("none.csv"));
  CHECK_THROWS_WITH(values("k,generated/data.csv,,height,sum,\n"), Contains("height"));
  CHECK_THROWS_AS(tables("t,generated/data.csv,,\n"), io::InputError);
  CHECK_THROWS_AS(tables("t,generated/data.csv,,area:roman\n"), io::InputError);
}
