// Components as installed: a run that is kept in a checkpoint, its samples in NetCDF, and a program
// as the model.
#include <cstdio>
#include <filesystem>

#include "models/program.hpp"
#include "storage/checkpoint.hpp"
#include "storage/compare.hpp"
#include "storage/inference_data.hpp"
#include "tmcmc/sampler.hpp"

int main() {
  const tmcmc::Problem problem{
      [](const auto& points, auto values) { values = -0.5 * points.col(0).array().square(); },
      {Eigen::VectorXd::Constant(1, -5.0), Eigen::VectorXd::Constant(1, 5.0)}};
  const storage::RunDescription run{tmcmc::recommended_options(4000), {.seed = 1}, problem.prior, "a normal"};
  const auto result = storage::run_with_checkpoint("components.checkpoint", run, problem.log_likelihood);
  storage::remove_checkpoint("components.checkpoint");
  io::OutputFile file("components.nc");
  storage::InferenceData data;
  data.parameter_names = {"x"};
  data.samples = result.final.points;
  data.log_likelihood = result.final.log_likelihood;
  data.numbers = {{"log_evidence", result.evidence.log_evidence},
                  {"log_evidence_standard_error", result.evidence.standard_error}};
  storage::write_inference_data(file, data);
  file.commit();
  const double log_evidence = storage::read_evidence("components.nc").evidence.log_evidence;
  std::filesystem::remove("components.nc");
  std::printf("log-evidence %.3f\n", log_evidence);
  return log_evidence == result.evidence.log_evidence ? 0 : 1;
}
