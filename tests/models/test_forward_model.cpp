#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "errors/invalid_value.hpp"
#include "io/temporary_directory.hpp"
#include "models/forward_model.hpp"
#include "models/model_error.hpp"
#include "models/program.hpp"
#include "models/worker.hpp"

using Catch::Matchers::Contains;
using models::GaussianData;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Eigen::VectorXd vector(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

/// An executable script.
std::string script(const TemporaryDirectory& directory, const std::string& text) {
  const auto path = directory.path() / "model";
  std::ofstream(path) << text;
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path.string();
}

const Eigen::MatrixXd points = (Eigen::MatrixXd(2, 2) << 1.0, 2.0, 3.0, 4.0).finished();

/// Values of a model with two outputs, or what it says.
template <class Model>
std::string outputs_or_message(const Model& model) {
  Eigen::MatrixXd outputs(2, 2);
  try {
    model.evaluate(points, outputs);
  } catch (const models::ModelError& error) {
    return error.what();
  }
  return outputs == 10.0 * points ? "ten times the points" : "others";
}

}  // namespace

TEST_CASE("Gaussian data give the normal density of the residuals", "[models]") {
  const GaussianData data{{0.0, 2.5, 3.0}, {1.0, 0.5, 2.0}};
  const Eigen::Vector3d outputs(0.3, 2.0, -1.0);
  double expected = 0.0;
  for (int k = 0; k < 3; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double sigma = 1.5 * data.standard_deviations[at];
    const double z = (data.observations[at] - outputs[k]) / sigma;
    expected -= 0.5 * z * z + std::log(sigma * std::sqrt(2.0 * M_PI));
  }
  CHECK(data.log_likelihood(outputs, 1.5) == Approx(expected).epsilon(1e-14));
  CHECK(data.log_likelihood(vector({0.3, infinity, 1.0})) == -infinity);
  CHECK(data.log_likelihood(vector({0.3, -infinity, 1.0})) == -infinity);
  CHECK(data.log_likelihood(outputs, 0.0) == -infinity);
  CHECK(data.log_likelihood(outputs, -1.0) == -infinity);
}

TEST_CASE("the noise is a parameter that the model does not see", "[models]") {
  const auto sum_and_difference = [](const auto& p, auto outputs) {
    REQUIRE(p.cols() == 2);
    outputs.col(0) = p.col(0) + p.col(1);
    outputs.col(1) = p.col(0) - p.col(1);
  };
  const GaussianData data{{1.0, 2.0}, {0.5, 1.0}, 1};
  const auto model = models::gaussian_likelihood(sum_and_difference, data);
  const Eigen::MatrixXd with_noise = (Eigen::MatrixXd(2, 3) << 1.0, 0.2, 2.0, 3.0, 7.0, 4.0).finished();
  Eigen::VectorXd values(2);
  model(with_noise, values);
  CHECK(values[0] == data.log_likelihood(vector({3.0, -1.0}), 0.2));
  CHECK(values[1] == data.log_likelihood(vector({7.0, -1.0}), 7.0));
}

TEST_CASE("Gaussian data that make no sense are refused", "[models]") {
  const auto nothing = [](const auto&, auto) {};
  for (const GaussianData& data : {GaussianData{{}, {}}, GaussianData{{1.0}, {}}, GaussianData{{1.0}, {0.0}},
                                   GaussianData{{1.0}, {infinity}}, GaussianData{{infinity}, {1.0}}}) {
    CHECK_THROWS_AS(models::gaussian_likelihood(nothing, data), errors::InvalidValue);
  }
}

TEST_CASE("a program writes a column for each output", "[models][program]") {
  const TemporaryDirectory directory;
  const auto program = [&](const std::string& header, const std::string& row) {
    return outputs_or_message(
        models::Program({script(directory, "#!/bin/sh\nawk -F, 'NR == 1 { print \"" + header +
                                               "\"; next } { print " + row + " }' \"$1\" >\"$2\"\n"),
                         {"a", "b"},
                         0.0,
                         2}));
  };
  CHECK(program("x,y", "10 * $1 \",\" 10 * $2") == "ten times the points");
  CHECK(program("x,b,y", "10 * $1 \",\" $2 \",\" 10 * $2") == "ten times the points");
  CHECK_THAT(program("x,b,y", "10 * $1 \",\" 7 \",\" 10 * $2"),
             Contains("wrote b = 7 where the point has 2"));
  CHECK_THAT(program("x", "$1"), Contains("1 columns of outputs: expected 2, one for each observation"));
  CHECK_THAT(program("x,y", "$1 \",nan\""),
             Contains("wrote the y 'nan': expected a number, inf or -inf; point 1 of 2 (a = 1, b = 2)"));
}

TEST_CASE("a worker writes a line of outputs for each point", "[models][worker]") {
  const TemporaryDirectory directory;
  const auto worker = [&](const std::string& answer) {
    const models::Worker model(
        {.program = script(directory, "#!/bin/sh\nread -r n\nfor i in 1 2; do IFS=, read -r a b\n" + answer +
                                          "\ndone\nread -r n\n"),
         .parameter_names = {"a", "b"},
         .outputs = 2});
    return outputs_or_message(model);
  };
  CHECK(worker("echo ${a}0,${b}0") == "ten times the points");
  CHECK(worker("printf '%s0,%s0\\r\\n' $a $b") == "ten times the points");
  for (const std::string line : {"echo 1", "echo 1,2,3", "echo 1,nan", "echo ,2", "echo", "echo 1,"}) {
    CHECK_THAT(worker(line), Contains("expected 2 outputs with commas between them, each a number, inf or "
                                      "-inf; the first of 2 points (a = 1, b = 2)"));
  }
}

TEST_CASE("a worker may write a long line of outputs", "[models][worker]") {
  constexpr Eigen::Index m = 1000;
  const TemporaryDirectory directory;
  const models::Worker model(
      {.program =
           script(directory,
                  "#!/bin/sh\nread -r n\nfor i in 1 2; do read -r a; awk 'BEGIN { for (k = 1; k < 1000; k++) "
                  "printf \"%d.12345678901234567,\", k; print 1000.5 }'\ndone\nread -r n\n"),
       .parameter_names = {"a", "b"},
       .outputs = m});
  Eigen::MatrixXd outputs(2, m);
  model.evaluate(points, outputs);
  CHECK(outputs(0, 0) == 1.12345678901234567);
  CHECK(outputs(1, m - 2) == 999.12345678901234567);
  CHECK(outputs(1, m - 1) == 1000.5);
}

TEST_CASE("a model without the noise gets the other columns", "[models]") {
  const models::ForwardModel columns = [](const auto& p, auto outputs) { outputs = p; };
  const Eigen::MatrixXd all = (Eigen::MatrixXd(2, 3) << 1.0, 0.2, 2.0, 3.0, 7.0, 4.0).finished();
  Eigen::MatrixXd two(2, 2), three(2, 3);
  for (const Eigen::Index noise : {0, 1, 2}) {
    models::without_noise(columns, noise)(all, two);
    CHECK(two.col(0) == all.col(noise == 0 ? 1 : 0));
    CHECK(two.col(1) == all.col(noise == 2 ? 1 : 2));
  }
  models::without_noise(columns, std::nullopt)(all, three);
  CHECK(three == all);
}
