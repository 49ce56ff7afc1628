// Measurements and priors from files: what is read, and what is refused by file, line, column and
// value.

#include <catch2/catch.hpp>
#include <cmath>

#include "data/columns.hpp"
#include "io/csv_fixture.hpp"
#include "replication/inputs.hpp"

using namespace replication;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

const std::string header = "r_nominal,r_measured,driving_frequency_hz,phase_deg\n";

ProblemFiles paper_files() {
  const std::string directory = test_data::source_directory() + "/data/published/";
  return {.observations = directory + "table1_observations.csv",
          .prior = {},
          .prior_correlation = {},
          .table2 = directory + "table2_prior.csv"};
}

std::string box(const std::string& force) {
  return "parameter,lower,upper\nfriction_force," + force +
         "\nnatural_frequency,0.01,10\nphase_noise,0.001,10\nfrequency_ratio_noise,0.001,1\n";
}

}  // namespace

TEST_CASE_METHOD(CsvFixture, "measurements are read, and impossible ones refused with their place",
                 "[inputs]") {
  std::vector<std::string> warnings;
  const auto read = [&](const std::string& path) {
    return read_observations(path, [&](const std::string& warning) { warnings.push_back(warning); });
  };
  const auto measured = read(paper_files().observations);
  CHECK(warnings.empty());
  CHECK(measured.phase_deg == test_data::table1().phase_deg);
  CHECK(measured.measured_ratio == test_data::table1().measured_ratio);
  std::ignore = read(put(header + "0.7,0.7,2,0.3\n0.8,0.8,2,0.4\n0.9,0.9,2,0.5\n"));
  REQUIRE(warnings.size() == 1);
  CHECK_THAT(warnings[0], Contains("x.csv: column 'phase_deg': no phase exceeds 2 pi"));
  const auto refused = [&](const std::string& row) {
    return message([&] { std::ignore = read(put(header + "0.7,0.7,2,30\n" + row)); });
  };
  CHECK_THAT(refused("0.7,1,2,30\n"), Contains("x.csv:3: column 'r_measured': value '1'"));
  CHECK_THAT(refused("0.7,0.7,0,30\n"), Contains("x.csv:3: column 'driving_frequency_hz': value '0'"));
  CHECK_THAT(refused("0.7,0.7,2,361\n"), Contains("x.csv:3: column 'phase_deg': value '361'"));
  CHECK_THAT(refused("0,0.7,2,30\n"), Contains("x.csv:3: column 'r_nominal': value '0'"));
  CHECK_THAT(message([&] { std::ignore = read(put("r_nominal\n1\n")); }),
             Contains("expected a column 'r_measured'"));
}

TEST_CASE_METHOD(CsvFixture, "Table 2 follows the reading, and a prior of the user's stands as it is",
                 "[inputs]") {
  auto files = paper_files();
  const auto published = reading(ReadingName::as_published);
  const auto corrected = reading(ReadingName::corrected);
  REQUIRE(published.natural_frequency_lower_hz.has_value());
  CHECK(prior_for(files, published).lower()[1] == *published.natural_frequency_lower_hz);
  CHECK(prior_for(files, corrected).lower()[1] == corrected.natural_frequency_lower_hz.value_or(0.01));
  files.prior = put(box("0.5,2"));
  CHECK(prior_for(files, published).lower()[0] == 0.5);
  CHECK(prior_for(files, published).lower()[1] == 0.01);
  CHECK_THAT(message([&] { std::ignore = read_prior(put(box("-1,2"))); }), Contains("x.csv:2"));
}

TEST_CASE_METHOD(CsvFixture, "what needs uniform or independent parameters refuses others", "[inputs]") {
  const auto uniform = read_prior(put(box("0.5,2")));
  const auto bounds = bounds_of(uniform, "the test");
  CHECK(bounds[0].lower == 0.5);
  CHECK(bounds[0].upper == 2.0);
  const auto other =
      read_prior(put("parameter,distribution,lower,upper,mean,standard_deviation\n"
                     "friction_force,uniform,0.5,2,,\nnatural_frequency,uniform,0.01,10,,\n"
                     "phase_noise,log_uniform,0.001,10,,\nfrequency_ratio_noise,uniform,0.001,1,,\n"));
  CHECK_THAT(message([&] { std::ignore = bounds_of(other, "the test"); }),
             Contains("the test needs uniform priors"));
  const auto priors = quadrature_priors(other);
  CHECK_THAT(priors[0].log_density(1.0), WithinAbs(-std::log(1.5), 1e-12));
  CHECK_THAT(priors[2].log_density(2.0), WithinAbs(-std::log(2.0 * std::log(1e4)), 1e-12));
  CHECK(std::is_sorted(priors[2].breaks.begin(), priors[2].breaks.end()));
}

TEST_CASE_METHOD(CsvFixture, "uniform priors give the exact posterior as bounds and as densities",
                 "[inputs]") {
  auto files = paper_files();
  const friction::Likelihood likelihood(test_data::table1(), {});
  const auto prior = prior_for(files, reading(ReadingName::corrected));
  const auto by_bounds = exact_posterior_for(files, likelihood, prior);
  const estimation::ExactPosterior by_densities(likelihood, quadrature_priors(prior));
  CHECK_THAT(by_bounds.log_evidence(), WithinAbs(by_densities.log_evidence(), 1e-7));
}

TEST_CASE_METHOD(CsvFixture, "a prior without continuous motion is refused at its place", "[inputs]") {
  auto files = paper_files();
  const friction::Likelihood likelihood(test_data::table1(), {});
  files.prior = put(box("9,10"));
  CHECK_THAT(message([&] { std::ignore = exact_posterior_for(files, likelihood, read_prior(files.prior)); }),
             Contains("x.csv:2: column 'lower': value '9'"));
}
