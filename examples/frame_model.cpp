#include "frame_model.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>
#include <utility>

#include "build_info.hpp"
#include "errors/invalid_value.hpp"
#include "inputs.hpp"
#include "models/parallel_batches.hpp"
#include "models/program.hpp"
#include "models/um_bridge.hpp"
#include "models/worker.hpp"
#include "storage/checkpoint.hpp"

namespace examples {

namespace {

Model shear_frame(const ModelOptions& options) {
  const FrameLikelihood frame(read_frame_observations(options.observations));
  std::string description = "shear_frame";
  for (std::size_t i = 0; i < frame.observations().mode.size(); ++i) {
    description += fmt::format(" {}:{}", frame.observations().mode[i],
                               io::format_number(frame.observations().frequency_hz[i]));
  }
  const auto& names = FrameLikelihood::parameter_names();
  return {names, experiments::read_prior(options.prior, {.names = names, .nonnegative = true}), frame,
          description, frame};
}

std::string description_of_file(const std::string& kind, const std::string& path) {
  return fmt::format("{} with checksum {}, {}", kind, storage::file_checksum(path),
                     io::printable_path(std::filesystem::canonical(path)));
}

/// \param description  what it depends on
tmcmc::LogLikelihood program_of(const ModelOptions& options, const std::vector<std::string>& names,
                                std::string& description) {
  if (!options.command.empty()) {
    models::Program program({options.command, names, options.timeout_seconds});
    description = description_of_file("program", options.command);
    return program;
  }
  if (!options.worker.empty()) {
    models::Worker worker({options.worker, names, options.timeout_seconds, options.note});
    description = description_of_file("worker", options.worker);
    return worker;
  }
  models::UmBridgeOptions bridge;
  bridge.server.url = options.um_bridge;
  bridge.server.timeout_seconds = options.timeout_seconds;
  bridge.model = options.model;
  bridge.parameter_names = names;
  if (options.has_own_observations) {
    const auto table = io::CsvTable::read(options.observations);
    bridge.data = {table.numbers("observation"), table.numbers("standard_deviation")};
  }
  description = fmt::format("UM-Bridge model {} of {}", options.model, options.um_bridge);
  return models::UmBridge(std::move(bridge));
}

Model other_program(const ModelOptions& options) {
  const auto require_name = [&](const std::string& name) {
    if (name.empty() || io::printable(name, std::string::npos) != name || name == "log_likelihood") {
      throw errors::InvalidValue("parameter", name, "a printable name other than log_likelihood");
    }
    if (options.for_netcdf) {
      storage::require_parameter_name(name);
    }
  };
  tmcmc::Prior prior = experiments::read_prior(options.prior, {.names = {}, .require_name = require_name});
  auto names = prior.names();
  std::string description;
  auto model = program_of(options, names, description);
  if (options.has_own_observations) {
    description += ", observations with checksum " + storage::file_checksum(options.observations);
  }
  description += fmt::format(", parameters {}", fmt::join(names, ","));
  const tmcmc::Index batch = options.um_bridge.empty() ? options.batch : 1;
  return {std::move(names), std::move(prior),
          models::parallel_batches(std::move(model), {.calls = options.parallel, .batch_rows = batch}),
          std::move(description), std::nullopt};
}

}  // namespace

bool is_other_program(const ModelOptions& options) {
  return !options.command.empty() || !options.worker.empty() || !options.um_bridge.empty();
}

Model make_model(const ModelOptions& options) {
  const bool is_command = !options.command.empty(), is_worker = !options.worker.empty();
  if ((is_command && is_worker) || ((is_command || is_worker) && !options.um_bridge.empty())) {
    throw std::invalid_argument("--command, --worker, --um-bridge: expected one of them");
  }
  if (options.um_bridge.empty() != options.model.empty()) {
    throw std::invalid_argument("--um-bridge, --model: expected both of them");
  }
  return is_other_program(options) ? other_program(options) : shear_frame(options);
}

storage::InferenceData inference_data(const tmcmc::Result& result, const Model& model, std::uint64_t seed) {
  storage::InferenceData data{.parameter_names = model.parameter_names,
                              .parameter_units = model.prior.units(),
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
                {"inference_library_version", experiments::version()},
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

}  // namespace examples
