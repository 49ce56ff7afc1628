// Tables of studies: what is written is read back, and what is wrong with a file is said with its
// place.

#include <catch2/catch.hpp>
#include <cmath>

#include "friction_study.hpp"
#include "io/csv_fixture.hpp"
#include "replication/columns.hpp"
#include "replication/posterior_tables.hpp"
#include "replication/study_tables.hpp"

using namespace replication;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;
using test_data::paper_posterior;

namespace {

/// Four runs of two samplers with the same estimates in each column: 1, 2, 3, 6.
std::string runs_file() {
  std::string text = "sampler,run";
  for (const auto& name : estimated_quantities()) {
    text += ',' + name;
  }
  for (const char* sampler : {"A", "B"}) {
    int run = 0;
    for (const char* estimate : {"1", "2", "3", "6"}) {
      text += std::string(1, '\n').append(sampler).append(",").append(std::to_string(run++));
      for (std::size_t q = 0; q < estimated_quantities().size(); ++q) {
        text += ',' + std::string(estimate);
      }
    }
  }
  return text + '\n';
}

}  // namespace

TEST_CASE_METHOD(CsvFixture, "a study that is written is read back, to the last bit", "[tables]") {
  StudySummary summary;
  summary.study = 7;
  summary.sampler = "A";
  summary.areas = summary.means = summary.smallest = summary.largest = {0.1, 1.0 / 3.0, 2e-9, 4.0};
  summary.standard_errors = {0.0, 1e-3, 2.0, 3.0};
  summary.log_evidence_mean = -47.0 / 3.0;
  summary.log_evidence_sd = 0.25;
  summary.iterations = {{9, 1}, {10, 2}};
  const std::string line = study_line(summary);
  const auto path = put(study_header() + '\n' + line + '\n');
  CHECK(read_studies(path) == std::vector{summary});
  CHECK(study_column({line}, "A", 3) == std::vector{1.0 / 3.0});
  CHECK(study_column({line}, "B", 3).empty());
  CHECK_THAT(message([&] { std::ignore = read_studies(put(study_header() + '\n' + line + '\n' + line)); }),
             Contains("x.csv:3: column 'sampler'"));
}

TEST_CASE_METHOD(CsvFixture, "samples are grouped by sampler and run, in the columns asked for", "[tables]") {
  const auto all = table("sampler,run,x,y\nB,3,1,2\nA,0,3,4\nB,3,5,6\nB,1,7,8\n");
  const auto samples = read_samples(all, {"y"}, "samples");
  CHECK(samples.samplers == std::vector<std::string>{"B", "A"});
  CHECK(samples.columns == std::vector<std::string>{"y"});
  CHECK(samples.values[0][0] == std::vector<std::vector<double>>{{2.0, 6.0}, {8.0}});
  CHECK(samples.values[1][0] == std::vector<std::vector<double>>{{4.0}});
  CHECK(message([&] { std::ignore = read_samples(all, {"z"}, "samples of a study"); }) ==
        "x.csv: no column 'z': expected samples of a study");
}

TEST_CASE_METHOD(CsvFixture, "a column weight weighs the samples of each run", "[tables]") {
  const auto samples = read_samples(table("sampler,run,x,weight\nA,0,1,3\nA,0,2,1\nA,1,5,2\nA,1,7,0\n"));
  CHECK(samples.columns == std::vector<std::string>{"x"});
  CHECK(samples.weights[0] == std::vector<std::vector<double>>{{3.0, 1.0}, {2.0, 0.0}});
  CHECK(samples.moments_of(0, 0, 0).mean == 1.25);
  CHECK(samples.moments_of(0, 0, 1).mean == 5.0);
  CHECK(samples.ecdfs(0, 0)[0](1.0) == 0.75);
  CHECK(samples.ecdfs(0, 0)[1](5.0) == 1.0);
  CHECK(message([&] { std::ignore = read_samples(table("sampler,run,x,weight\nA,0,1,-3\n")); }) ==
        "x.csv:2: column 'weight': value '-3': expected a number from 0 to 1e100");
  CHECK(message([&] { std::ignore = read_samples(table("sampler,run,x,weight\nA,0,1,0\n")); }) ==
        "x.csv: column 'weight': expected a positive weight in each run");
}

TEST_CASE_METHOD(CsvFixture, "estimates are one a run, without negative deviations", "[tables]") {
  CHECK(read_estimates(put(runs_file())).values[1][8].size() == 4);
  std::string negative = runs_file();
  negative.replace(negative.find("\nA,0,1,1"), 8, "\nA,0,1,-1");
  CHECK_THAT(message([&] { std::ignore = read_estimates(put(negative)); }),
             Contains("x.csv:2: column 'sd_friction_force_n': value '-1'"));
  std::string twice = runs_file();
  twice.replace(twice.find("\nA,1"), 4, "\nA,0");
  CHECK_THAT(message([&] { std::ignore = read_estimates(put(twice)); }), Contains("x.csv:3: column 'run'"));
}

TEST_CASE_METHOD(CsvFixture, "errors against the exact posterior, by hand", "[tables]") {
  const auto errors = errors_of(read_estimates(put(runs_file())), paper_posterior());
  REQUIRE(errors.size() == 18);
  const auto& force = paper_posterior().marginal(friction::friction_force);
  CHECK(errors[0].quantity == "mean_friction_force_n");
  CHECK(errors[0].exact == force.mean());
  CHECK_THAT(errors[0].error.bias, WithinRel(3.0 - force.mean(), 1e-12));
  CHECK_THAT(errors[0].effective_size,
             WithinRel(std::pow(force.standard_deviation(), 2) / (14.0 / 3.0), 1e-12));
  CHECK(errors[1].exact == force.standard_deviation());
  CHECK(std::isnan(errors[1].effective_size));
  CHECK(errors[17].sampler == "B");
  CHECK(errors[17].exact == paper_posterior().log_evidence());
  CHECK(std::isnan(errors[17].effective_size));
}

TEST_CASE("estimates of the parameters: exact, Laplace and least squares", "[tables]") {
  const auto fit = estimation::fit_least_squares(test_data::table1(), {});
  const auto rows = parameter_estimates(paper_posterior(), {}, fit);
  REQUIRE(rows.size() == 4);
  for (std::size_t p = 0; p < rows.size(); ++p) {
    const auto& exact = paper_posterior().marginal(static_cast<friction::Parameter>(p));
    CHECK(rows[p].mean == exact.mean());
    CHECK(rows[p].standard_deviation == exact.standard_deviation());
    CHECK(rows[p].quantiles[0] == exact.quantile(0.025));
    CHECK(rows[p].quantiles[4] == exact.quantile(0.975));
    CHECK(std::isnan(rows[p].laplace_mode));  // none was made
    CHECK(std::isnan(rows[p].laplace_standard_deviation));
  }
  CHECK(rows[1].least_squares == fit.natural_frequency.estimate);
  CHECK(rows[2].least_squares == fit.friction_force.noise_ml);
}

TEST_CASE("marginals and histograms are densities", "[tables]") {
  estimation::LaplaceApproximation laplace;
  laplace.mode = {1.0, 3.0, 2.0, 0.02};
  laplace.standard_deviation = {0.1, 0.1, 0.5, 0.01};
  const auto points = marginal_points(paper_posterior(), laplace, 1001);
  REQUIRE(points.size() == 4004);
  double mass = 0.0;
  for (std::size_t i = 1; i < 1001; ++i) {
    mass += 0.5 * (points[i].density + points[i - 1].density) * (points[i].x - points[i - 1].x);
  }
  CHECK_THAT(mass, WithinAbs(1.0 - 2e-4, 1e-4));
  CHECK_THAT(laplace.marginal_density(0, 1.1),
             WithinRel(std::exp(-0.5) / (0.1 * std::sqrt(2.0 * M_PI)), 1e-12));

  const double middle = paper_posterior().marginal(friction::friction_force).quantile(0.5);
  GroupedColumns samples{{"A"}, parameter_columns, {{{{middle, 1e9}}, {{3.0}}, {{2.0}}, {{0.02}}}}};
  const auto bins = sample_histograms(samples, paper_posterior(), 10);
  REQUIRE(bins.size() == 40);
  double inside = 0.0;
  for (std::size_t b = 0; b < 10; ++b) {
    inside += bins[b].density * (bins[b].high - bins[b].low);
  }
  CHECK_THAT(inside, WithinRel(0.5, 1e-9));  // the other sample is outside
}

TEST_CASE("runs of a study have a column for each cell", "[tables]") {
  auto reading = test_data::small_reading(ReadingName::corrected, 100);
  reading.sampler.diagnose = true;
  const auto runs = run_arm(test_data::paper_problem(reading), paper_arms(reading)[0], 0, {.runs = 2});
  CHECK(run_columns(false).size() == 13);
  CHECK(run_columns(true).size() == 13 + diagnosed_cells(runs[0]).size());
  const auto all = diagnoses_of(runs);
  const double a = runs[0].result.evidence.log_evidence, b = runs[1].result.evidence.log_evidence;
  CHECK_THAT(all.log_evidence.mean, WithinRel(0.5 * (a + b), 1e-12));
  CHECK(all.smallest_effective_size <= runs[0].result.diagnostics.effective_sample_size.minCoeff());
}
