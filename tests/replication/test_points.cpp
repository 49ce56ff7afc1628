// Tables beside each other, claims, the model at points of a table, and exact draws.

#include <catch2/catch.hpp>
#include <cmath>

#include "errors/invalid_value.hpp"
#include "friction_study.hpp"
#include "io/csv_fixture.hpp"
#include "replication/claim_tables.hpp"
#include "replication/columns.hpp"
#include "replication/comparison.hpp"
#include "replication/exact_runs.hpp"
#include "replication/model_tables.hpp"
#include "replication/noise_priors.hpp"

using namespace replication;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;
using Catch::Matchers::WithinRel;

TEST_CASE_METHOD(CsvFixture, "cells are found by their key, and what one table lacks is missing",
                 "[points]") {
  const auto printed = table("k,x\na,1\nb,2\n");
  const auto ours = table("k,x\nc,5\nb,2.5\n");
  std::vector<ComparedCell> cells;
  compare(cells, "T", "k", {"x"}, printed, ours, 0.0);
  REQUIRE(cells.size() == 3);
  CHECK((cells[0].row == "a" && cells[0].printed == 1.0 && cells[0].ours == 0.0));
  CHECK((cells[1].row == "b" && cells[1].printed == 2.0 && cells[1].ours == 2.5));
  CHECK((cells[2].row == "c" && cells[2].printed == 0.0 && cells[2].ours == 5.0));
  CHECK(difference(cells[1]) == 0.5);
  const auto twice = table("k,x\na,1\na,2\n");
  CHECK_THAT(message([&] { compare(cells, "T", "k", {"x"}, printed, twice, 0.0); }),
             Contains("x.csv:3: column 'k'"));
}

TEST_CASE("phases differ the shortest way", "[points]") {
  ComparedCell cell;
  cell.column = "phase_deg";
  cell.printed = 350.0;
  cell.ours = 5.0;
  CHECK_THAT(difference(cell), WithinAbs(15.0, 1e-9));
}

TEST_CASE_METHOD(CsvFixture, "claims that have no judge, or that are missing, are refused", "[points]") {
  CHECK_THAT(message([&] { std::ignore = read_claims(put("id,place,claim\nX9,here,text\n")); }),
             Contains("x.csv:2: column 'id': value 'X9'"));
  CHECK_THAT(message([&] { std::ignore = read_claims(put("id,place,claim\nC1,here,text\n")); }),
             Contains("no row 'C2'"));
}

TEST_CASE_METHOD(CsvFixture, "the model at the points of a table is the model", "[points]") {
  const friction::Physics physics;
  const auto at = phases(table("friction_force_n,frequency_ratio\n0.5,0.8\n9,0.8\n"), physics);
  const auto constants = friction::response_constants(0.8, physics);
  CHECK(at.phase_deg[0] == friction::phase_deg(constants, 0.5 / physics.driving_force_n));
  CHECK(std::isnan(at.phase_deg[1]));  // no continuous motion
  CHECK(at.limit_force_ratio[1] == constants.limit_force_ratio);
  CHECK_THAT(
      message([&] { std::ignore = phases(table("friction_force_n,frequency_ratio\n0.5,1\n"), physics); }),
      Contains("x.csv:2: column 'frequency_ratio'"));

  const friction::Likelihood likelihood(test_data::table1(), physics);
  std::string points;
  for (const auto& name : parameter_columns) {
    points += (points.empty() ? "" : ",") + name;
  }
  const auto values = log_likelihoods(table(points + "\n1.0,3.0,2.0,0.02\n"), likelihood);
  Eigen::MatrixXd point(1, 4);
  point << 1.0, 3.0, 2.0, 0.02;
  Eigen::VectorXd expected(1);
  likelihood(point, expected);
  CHECK(values == std::vector<double>{expected[0]});
  CHECK_THAT(message([&] { std::ignore = log_likelihoods(table(points + "\n1,3,0,0.02\n"), likelihood); }),
             Contains("column 'phase_noise_deg'"));
}

TEST_CASE("exact runs are draws of the posterior, others in each run and study", "[points]") {
  const auto& posterior = test_data::paper_posterior();
  const auto runs = exact_runs(posterior, 1, 0, 2, 4000);
  const auto& force = posterior.marginal(friction::friction_force);
  REQUIRE(runs[0].size() == 2);
  double sum = 0.0;
  for (const double x : runs[0][0].sorted()) {
    sum += x;
  }
  const double standard_error = force.standard_deviation() / std::sqrt(4000.0);
  CHECK_THAT(sum / 4000.0, WithinAbs(force.mean(), 4.0 * standard_error));
  CHECK(runs[0][0].sorted()[0] != runs[0][1].sorted()[0]);
  CHECK(exact_runs(posterior, 1, 1, 1, 10)[0][0].sorted()[0] !=
        exact_runs(posterior, 1, 0, 1, 10)[0][0].sorted()[0]);
}

TEST_CASE("areas of exact runs are those of their distribution functions, with quantiles over studies",
          "[points]") {
  const auto& posterior = test_data::paper_posterior();
  const auto areas = exact_areas(posterior, 1, 0, 3, 50);
  const auto runs = exact_runs(posterior, 1, 0, 3, 50);
  for (std::size_t p = 0; p < areas.size(); ++p) {
    CHECK(areas[p] == pbox::area_metric(runs[p]));
  }
  const std::vector<replication::Areas> studies = {
      {3.0, 30.0, 0.0, 1.0}, {1.0, 20.0, 0.0, 1.0}, {2.0, 10.0, 0.0, 3.0}};
  CHECK(area_quantiles(studies, 0.5) == replication::Areas{2.0, 20.0, 0.0, 1.0});
  CHECK(area_quantiles(studies, 0.75) == replication::Areas{2.5, 25.0, 0.0, 2.0});
  CHECK_THROWS_AS(area_quantiles({}, 0.5), errors::InvalidValue);
}

TEST_CASE("priors of the noise levels, by their densities", "[points]") {
  const auto reading = test_data::small_reading(ReadingName::corrected, 100);
  const auto priors = noise_priors(test_data::table2(reading));
  REQUIRE(priors.size() == 3);
  const auto density = [&](std::size_t k, double noise) {
    Eigen::MatrixXd point(1, 4);
    point << 1.0, 3.0, noise, 0.5;
    Eigen::VectorXd value(1);
    value = priors[k].prior.log_density(point);
    return value[0];
  };
  CHECK(priors[1].name == "log_uniform");
  CHECK_THAT(density(0, 1.0) - density(0, 2.0), WithinAbs(0.0, 1e-12));
  CHECK_THAT(density(1, 1.0) - density(1, 2.0), WithinAbs(std::log(2.0), 1e-12));
  CHECK_THAT(density(2, 1.0) - density(2, 2.0), WithinAbs(3.0 / (2.0 * 25.0), 1e-12));
}
