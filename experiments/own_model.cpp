// A model of one's own, from measurements to a posterior: the storey stiffnesses of a two-storey shear frame from measured
// natural frequencies (docs/own_model.md says how to put another in its place). The model is the C++ of support/shear_frame.hpp,
// or with --command any other program with the parameters of the file of the prior, called once a batch of points.
//
// Data: data/examples/, made by data/examples/simulate_frame.py; or the reader's own measurements.

#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "errors/invalid_value.hpp"
#include "inputs.hpp"
#include "kept_run.hpp"
#include "models/program.hpp"
#include "models/ranks.hpp"
#include "shear_frame.hpp"
#include "storage/checkpoint.hpp"
#include "storage/inference_data.hpp"
#include "tmcmc/diagnostics.hpp"

using namespace experiments;

namespace {

/// The recommended sampler with chains enough that a batch is worth the start of a program.
tmcmc::Options sampler_options(long evaluations, int threads) {
  constexpr long chains = 100;
  tmcmc::Options options = tmcmc::recommended_options(evaluations, chains);
  options.threads = threads;
  return options;
}

/// The shear frame, or another program.
struct Model {
  std::vector<std::string> parameter_names;
  tmcmc::BoxPrior prior;
  tmcmc::LogLikelihood log_likelihood;
  std::string description;               // one line, for the checkpoint
  std::optional<FrameLikelihood> frame;  // none of another program
};

struct ModelOptions {
  std::string observations = example("frame_observations.csv");
  std::string prior = example("frame_prior.csv");
  std::string command;
  double timeout_seconds = 0.0;
};

Model shear_frame(const ModelOptions& options) {
  const FrameLikelihood frame(read_frame_observations(options.observations));
  std::string description = "shear_frame";
  for (std::size_t i = 0; i < frame.observations().mode.size(); ++i) {
    description += fmt::format(" {}:{}", frame.observations().mode[i],
                               io::format_number(frame.observations().frequency_hz[i]));
  }
  const auto& names = FrameLikelihood::parameter_names();
  return {names, read_prior(options.prior, names), frame, description, frame};
}

/// \param for_netcdf  whether the names have to be those of variables in a NetCDF file
Model other_program(const ModelOptions& options, bool for_netcdf) {
  const auto require_name = [&](const std::string& name) {
    if (name.empty() || io::printable(name, std::string::npos) != name || name == "log_likelihood") {
      throw errors::InvalidValue("parameter", name, "a printable name other than log_likelihood");
    }
    if (for_netcdf) {
      storage::require_parameter_name(name);
    }
  };
  auto [names, prior] = read_named_prior(options.prior, require_name);
  models::Program program({options.command, names, options.timeout_seconds});
  std::string description = "program with checksum " + storage::file_checksum(options.command);
  if (options.observations != ModelOptions().observations) {
    description += ", observations with checksum " + storage::file_checksum(options.observations);
  }
  description +=
      fmt::format(", {}, parameters {}", io::printable_path(std::filesystem::canonical(options.command)),
                  fmt::join(names, ","));
  return {std::move(names), std::move(prior), std::move(program), description, std::nullopt};
}

storage::InferenceData inference_data(const tmcmc::Result& result, const Model& model, std::uint64_t seed) {
  storage::InferenceData data{.parameter_names = model.parameter_names,
                              .samples = result.final.points,
                              .log_likelihood = result.final.log_likelihood};
  const auto stages = [&](const std::string& name, auto member) {
    storage::Column column{name, {}};
    for (const auto& stage : result.stages) {
      column.second.push_back(static_cast<double>(stage.*member));
    }
    data.stages.push_back(std::move(column));
  };
  stages("beta", &tmcmc::StageRecord::beta);
  stages("effective_sample_size", &tmcmc::StageRecord::effective_sample_size);
  stages("acceptance_rate", &tmcmc::StageRecord::acceptance_rate);
  stages("log_evidence_increment", &tmcmc::StageRecord::log_evidence_increment);
  stages("evaluations", &tmcmc::StageRecord::evaluations);
  if (model.frame) {
    const auto& observations = model.frame->observations();
    data.observed = {{"frequency_hz", observations.frequency_hz}};
    data.constant = {{"mode", {observations.mode.begin(), observations.mode.end()}}};
    data.pointwise_log_likelihood = {{"frequency_hz", model.frame->pointwise(result.final.points)}};
  }
  data.texts = {{"inference_library", "tmcmc_companion"},
                {"inference_library_version", COMPANION_VERSION},
                {"seed", std::to_string(seed)}};
  data.numbers = {{"beta", result.final.beta},
                  {"log_evidence", result.evidence.log_evidence},
                  {"log_evidence_standard_error", result.evidence.standard_error}};
  for (std::size_t j = 0; j < data.parameter_names.size(); ++j) {
    data.numbers.emplace_back("effective_sample_size_" + data.parameter_names[j],
                              result.diagnostics.effective_sample_size[static_cast<Eigen::Index>(j)]);
  }
  return data;
}

void report(const Program& program, const Model& model, const tmcmc::Result& result) {
  const auto n = static_cast<double>(result.final.points.rows());
  for (Eigen::Index j = 0; j < result.final.points.cols(); ++j) {
    const auto column = result.final.points.col(j).array();
    const double mean = column.mean();
    const double sd = std::sqrt((column - mean).square().sum() / (n - 1.0));
    program.report("{} = {:.5g} +- {:.2g} (effective sample size {:.0f})\n",
                   model.parameter_names[static_cast<std::size_t>(j)], mean, sd,
                   result.diagnostics.effective_sample_size[j]);
  }
  program.report("log-evidence {:.3f} +- {:.3f}; {} stages, {} evaluations\n", result.evidence.log_evidence,
                 result.evidence.standard_error, result.stages.size(), result.final.evaluations);
  for (const auto& warning : result.diagnostics.warnings) {
    program.report("warning: {}\n", warning.message);
  }
}

const char* advice(tmcmc::StopReason stop) {
  switch (stop) {
    case tmcmc::StopReason::budget:
      return ": expected more --evaluations";
    case tmcmc::StopReason::step_too_small:
      return ": expected log-likelihoods on a smaller scale; -inf excludes a point";
    default:
      return "";
  }
}

}  // namespace

int main(int argc, char** argv) {
  models::Ranks ranks(argc, argv);
  Program program("own_model", "Updates a model of one's own: a two-storey shear frame, or another program.");
  if (ranks.rank() > 0) {
    program.be_silent();
  }
  ModelOptions model_options;
  std::string netcdf_path, checkpoint_path;
  long evaluations = 31000;
  RunOptions run_options;
  program.add_output("CSV: a row a sample, with its log-likelihood");
  program.add_file_output("--netcdf", netcdf_path, "Samples, stages and observations in the layout of ArviZ");
  program.add_file_output(
      "--checkpoint", checkpoint_path,
      "Progress after each stage; the same command goes on from it. Without it: the name of --output with "
      ".checkpoint, if --output is a file");
  program.add_input(
      "--observations", model_options.observations,
      "CSV with columns mode (1 or 2), frequency_hz. With --command: a file that the program reads; the "
      "checkpoint of a run with other contents is refused");
  program.add_input("--prior", model_options.prior,
                    "CSV with columns parameter, lower, upper. With --command: the parameters, of any names");
  program.add_number("--evaluations", evaluations, count(2600), "Budget of log-likelihoods");
  program.add_text("--command", model_options.command, "PROGRAM",
                   "Program that computes the log-likelihoods: PROGRAM points.csv log_likelihoods.csv");
  program.add_number("--timeout", model_options.timeout_seconds,
                     number([](double x) { return x >= 0.0 && std::isfinite(x); }, "a number of at least 0"),
                     "Most seconds of one call of the program; 0: no limit");
  run_options.add_seed_to(program);
  run_options.add_threads_to(program);

  return program.run(argc, argv, [&] {
    const Model model = model_options.command.empty() ? shear_frame(model_options)
                                                      : other_program(model_options, !netcdf_path.empty());
    const auto shared = ranks.share(model.log_likelihood);
    if (!shared) {
      return;  // this rank has evaluated for rank 0
    }
    auto columns = model.parameter_names;
    columns.emplace_back("log_likelihood");
    auto csv = open_csv(program.output(), columns);
    std::optional<io::OutputFile> netcdf_file;
    if (!netcdf_path.empty()) {
      netcdf_file.emplace(netcdf_path);
    }
    const std::string checkpoint = checkpoint_path.empty() && csv && !csv->in_place()
                                       ? program.output() + ".checkpoint"
                                       : checkpoint_path;
    if (checkpoint == "-") {
      throw std::invalid_argument("--checkpoint: value '-': expected a file");
    }
    if (!checkpoint.empty() && netcdf_file && io::is_same_output(checkpoint, netcdf_path)) {
      throw std::invalid_argument(
          fmt::format("--netcdf: value '{}': expected another file than the checkpoint",
                      io::printable_path(netcdf_path)));
    }

    storage::RunDescription run{sampler_options(evaluations, run_options.study_options().threads),
                                {.seed = run_options.seed},
                                model.prior,
                                model.description};
    if (ranks.size() > 1) {  // a call for each batch, which the ranks share
      run.options.threads = 1;
      run.options.batch_rows = 0;
    }
    const auto result = run_kept(run, *shared, checkpoint);
    if (result.stop != tmcmc::StopReason::completed) {  // not the posterior: nothing that looks like it
      storage::remove_checkpoint(checkpoint);
      throw std::runtime_error(fmt::format("ended at beta = {:.4g} after {} stages: {}{}", result.final.beta,
                                           result.stages.size(), tmcmc::describe(result.stop),
                                           advice(result.stop)));
    }
    report(program, model, result);
    if (csv) {
      for (Eigen::Index i = 0; i < result.final.points.rows(); ++i) {
        const Eigen::VectorXd point = result.final.points.row(i);
        csv->row(std::span<const double>(point.data(), model.parameter_names.size()),
                 result.final.log_likelihood[i]);
      }
    }
    if (netcdf_file) {
      storage::write_inference_data(*netcdf_file, inference_data(result, model, run_options.seed));
    }
    io::commit_all(csv, netcdf_file);
    storage::remove_checkpoint(checkpoint);
  });
}
