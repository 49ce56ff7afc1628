#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "errors/invalid_value.hpp"
#include "io/errors.hpp"
#include "io/temporary_directory.hpp"
#include "storage/compare.hpp"
#include "storage/inference_data.hpp"

using namespace storage;
using Catch::Matchers::Contains;
using Catch::Matchers::WithinAbs;

namespace {

InferenceData data_with(double log_evidence, const std::vector<double>& observed) {
  InferenceData data{.parameter_names = {"x"},
                     .samples = Eigen::MatrixXd::Zero(2, 1),
                     .log_likelihood = Eigen::VectorXd::Zero(2)};
  if (!observed.empty()) {
    data.observed = {{"y", observed}};
  }
  data.numbers = {{"beta", 1.0}, {"log_evidence", log_evidence}, {"log_evidence_standard_error", 0.2}};
  return data;
}

std::filesystem::path written(const std::filesystem::path& path, const InferenceData& data) {
  io::OutputFile file(path);
  write_inference_data(file, data);
  file.commit();
  return path;
}

}  // namespace

TEST_CASE("posterior probabilities of models follow from their evidences and prior probabilities",
          "[compare]") {
  const std::vector<tmcmc::Evidence> evidences{{-10.0, 0.0}, {-10.0 + std::log(3.0), 0.0}};
  const auto equal = compare(evidences);
  CHECK_THAT(equal[0].probability, WithinAbs(0.25, 1e-12));
  CHECK_THAT(equal[1].probability, WithinAbs(0.75, 1e-12));
  CHECK_THAT(equal[0].log_bayes_factor, WithinAbs(-std::log(3.0), 1e-12));
  CHECK(equal[1].log_bayes_factor == 0.0);
  CHECK(equal[0].probability_error == 0.0);
  const auto unequal = compare(evidences, std::vector<double>{3.0, 1.0});
  CHECK_THAT(unequal[0].probability, WithinAbs(0.5, 1e-12));
}

TEST_CASE("evidences far from each other and far from 1 do not overflow", "[compare]") {
  const auto models = compare(std::vector<tmcmc::Evidence>{{-1e5, 0.1}, {1e5, 0.1}, {-2e5, 0.1}});
  CHECK(models[1].probability == 1.0);
  CHECK(models[0].probability == 0.0);
  CHECK_THAT(models[2].log_bayes_factor, WithinAbs(-3e5, 1e-6));
}

TEST_CASE("the error of a probability is that of finite differences", "[compare]") {
  const std::vector<tmcmc::Evidence> evidences{{-3.0, 0.3}, {-2.0, 0.1}, {-2.5, 0.2}};
  const auto models = compare(evidences);
  for (std::size_t i = 0; i < 3; ++i) {
    double variance = 0.0;
    for (std::size_t j = 0; j < 3; ++j) {
      constexpr double h = 1e-6;
      auto moved = evidences;
      moved[j].log_evidence += h;
      const double slope = (compare(moved)[i].probability - models[i].probability) / h;
      variance += slope * slope * evidences[j].standard_error * evidences[j].standard_error;
    }
    CHECK_THAT(models[i].probability_error, WithinAbs(std::sqrt(variance), 1e-6));
  }
  CHECK_THAT(models[0].log_bayes_factor_error, WithinAbs(std::hypot(0.3, 0.1), 1e-12));
}

TEST_CASE("evidences and probabilities that are invalid are refused", "[compare]") {
  const std::vector<tmcmc::Evidence> evidences{{-1.0, 0.1}, {-2.0, 0.1}};
  CHECK_THROWS_AS(compare({}), errors::InvalidValue);
  CHECK_THROWS_AS(compare(evidences, std::vector<double>{1.0}), errors::InvalidValue);
  CHECK_THROWS_AS(compare(evidences, std::vector<double>{1.0, 0.0}), errors::InvalidValue);
  CHECK_THROWS_AS(compare(std::vector<tmcmc::Evidence>{{NAN, 0.1}}), errors::InvalidValue);
  CHECK_THROWS_AS(compare(std::vector<tmcmc::Evidence>{{0.0, -0.1}}), errors::InvalidValue);
}

TEST_CASE("a file gives its evidence back, and data that differ are refused", "[compare]") {
  const TemporaryDirectory directory;
  const auto first = read_evidence(written(directory.path() / "a.nc", data_with(-1.5, {1.0, 2.0})));
  CHECK(first.evidence.log_evidence == -1.5);
  CHECK(first.evidence.standard_error == 0.2);
  const auto same = read_evidence(written(directory.path() / "b.nc", data_with(-2.5, {1.0, 2.0})));
  CHECK(first.data_checksum.size() == 16);
  CHECK(first.data_checksum == same.data_checksum);
  CHECK_NOTHROW(require_same_data(std::vector{first, same}));
  const auto other = read_evidence(written(directory.path() / "c.nc", data_with(-2.5, {1.0, 2.1})));
  CHECK_THROWS_WITH(require_same_data(std::vector{first, same, other}),
                    Contains("c.nc: attribute 'data_checksum'") && Contains("the same data as in"));
  const auto unknown = read_evidence(written(directory.path() / "d.nc", data_with(-2.5, {})));
  CHECK_THROWS_WITH(require_same_data(std::vector{first, unknown}),
                    Contains("d.nc") && Contains("--same-data"));
}

TEST_CASE("files without an evidence, of a run that stopped, or that are no NetCDF are refused",
          "[compare]") {
  const TemporaryDirectory directory;
  CHECK_THROWS_WITH(read_evidence(directory.path() / "none.nc"), Contains("none.nc"));
  std::ofstream(directory.path() / "text.nc") << "no NetCDF\n";
  CHECK_THROWS_AS(read_evidence(directory.path() / "text.nc"), io::InputError);
  auto data = data_with(0.0, {1.0});
  data.numbers[0].second = 0.5;
  CHECK_THROWS_WITH(read_evidence(written(directory.path() / "stopped.nc", data)),
                    Contains("attribute 'beta'"));
  data.numbers.clear();
  CHECK_THROWS_WITH(read_evidence(written(directory.path() / "bare.nc", data)),
                    Contains("attribute 'log_evidence'"));
}
