// Contents of Tables 4 and 5 and of Figures 4 and 5, by hand.

#include <catch2/catch.hpp>
#include <cmath>

#include "io/csv_fixture.hpp"
#include "replication/paper_tables.hpp"

using namespace replication;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinRel;

TEST_CASE_METHOD(CsvFixture, "runs are counted by sampler and number of iterations", "[paper_tables]") {
  const auto counted =
      count_iterations(table("sampler,run,iterations\nB,0,11\nA,0,10\nB,1,10\nB,2,10\nA,1,12\n"));
  CHECK(counted.samplers == std::vector<std::string>{"B", "A"});
  CHECK(counted.runs == std::map<long, std::vector<long>>{{10, {2, 1}}, {11, {1, 0}}, {12, {0, 1}}});
  CHECK_THAT(
      message([&] { std::ignore = count_iterations(table("sampler,run,iterations\nB,0,11\nB,0,10\n")); }),
      Contains("x.csv:3: column 'run'"));
  CHECK_THAT(message([&] { std::ignore = count_iterations(table("sampler,iterations\nB,0\n")); }),
             Contains("x.csv:2: column 'iterations': value '0'"));
}

TEST_CASE_METHOD(CsvFixture, "standard errors are the spread of the runs' means", "[paper_tables]") {
  // Runs with means 2 and 4 and standard deviations sqrt(2) and 2 sqrt(2), two samples each.
  const auto rows = standard_errors(read_samples(table("sampler,run,x\nA,0,1\nA,0,3\nA,1,2\nA,1,6\n")));
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].parameter == "x");
  CHECK(rows[0].mean == 3.0);
  CHECK_THAT(rows[0].standard_error, WithinRel(std::sqrt(2.0), 1e-14));
  CHECK_THAT(rows[0].posterior_sd, WithinRel(std::sqrt(5.0 + 2.0), 1e-14));  // within and between
  CHECK_THAT(rows[0].independent, WithinRel(std::sqrt(7.0 / 2.0), 1e-14));
  CHECK_THAT(rows[0].effective_size, WithinRel(3.5, 1e-14));
  const auto one = standard_errors(read_samples(table("sampler,run,x\nA,0,1\nA,0,3\n")));
  CHECK(std::isnan(one[0].standard_error));
  CHECK_THAT(one[0].posterior_sd, WithinRel(std::sqrt(2.0), 1e-14));
}

TEST_CASE_METHOD(CsvFixture, "bars of both sources, with zeros where a source has no such runs",
                 "[paper_tables]") {
  const auto areas = [&](const std::string& rows) {
    return table("sampler,friction_force_n,natural_frequency_hz\n" + rows);
  };
  const AreasAndCounts printed{areas("I,0.1,0.01\nII,0.2,0.02\n"),
                               table("iterations,I,II\n9,6,5\n10,44,36\n")};
  const AreasAndCounts reproduced{areas("II,0.4,0.04\nI,0.3,0.03\n"),
                                  table("iterations,I,II\n10,50,40\n11,0,10\n")};
  const auto bars = bar_pairs(printed, reproduced, {"I", "II"});
  REQUIRE(bars.size() == 10);
  CHECK(bars[0].category == "friction_force_n");
  CHECK(bars[2].source == "reproduced");
  CHECK(bars[2].heights == std::array{0.3, 0.4});  // whatever the order of the rows
  CHECK(bars[3].heights == std::array{0.03, 0.04});
  CHECK(bars[6].category == "11");  // that only the second source has
  CHECK(bars[6].heights == std::array{0.0, 0.0});
  CHECK(bars[7].category == "9");
  CHECK(bars[7].heights == std::array{0.0, 0.0});
  CHECK(bars[9].heights == std::array{0.0, 10.0});
  CHECK_THAT(message([&] {
               std::ignore = bar_pairs(printed, reproduced, {"I", "III"});
             }),
             Contains("no row 'III'"));
  const AreasAndCounts twice{areas("I,0.1,0.01\nI,0.2,0.02\n"), printed.counts};
  CHECK_THAT(message([&] {
               std::ignore = bar_pairs(twice, reproduced, {"I", "II"});
             }),
             Contains("expected each sampler once"));
}

TEST_CASE_METHOD(CsvFixture, "stages have a beta from 0 to 1, each once a run", "[paper_tables]") {
  const std::string header = "sampler,run,stage,beta\n";
  const auto stages = read_stages(table(header + "A,0,1,0.25\nA,0,2,1\n"));
  REQUIRE(stages.size() == 2);
  CHECK(stages[1].stage == 2);
  CHECK(stages[1].beta == 1.0);
  CHECK_THAT(message([&] { std::ignore = read_stages(table(header + "A,0,1,1.5\n")); }),
             Contains("x.csv:2: column 'beta': value '1.5'"));
  CHECK_THAT(message([&] { std::ignore = read_stages(table(header + "A,0,1,0.5\nA,0,1,0.6\n")); }),
             Contains("x.csv:3: column 'stage'"));
  CHECK_THAT(message([&] { std::ignore = read_stages(table(header + "A,0,0,0.5\n")); }),
             Contains("x.csv:2: column 'stage': value '0'"));
}
