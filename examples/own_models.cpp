#include "own_models.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "errors/invalid_value.hpp"
#include "friction/likelihood.hpp"
#include "inputs.hpp"
#include "models/forward_model.hpp"
#include "models/parallel_batches.hpp"
#include "models/program.hpp"
#include "models/um_bridge.hpp"
#include "models/worker.hpp"
#include "problem/parameters.hpp"
#include "shear_frame.hpp"
#include "storage/checkpoint.hpp"

namespace examples {

namespace {

/// The prior of the problem file, or that of the files of the options.
tmcmc::Prior prior_of(const ProblemOptions& options, const problem::ParameterRules& rules) {
  return options.file() && !options.is_given("--prior")
             ? problem::read_parameters(*options.file(), rules)
             : experiments::read_prior(options.prior, {rules.names, rules.nonnegative, rules.require_name});
}

/// The file of the measurements, which a problem file has to name.
const std::string& measurements_file(const ProblemOptions& options) {
  if (options.file() && !options.is_given("--observations")) {
    throw io::InputError(fmt::format("{}: no data: expected file, the measurements, in the table [data]",
                                     io::printable_path(options.file()->path)));
  }
  return options.observations;
}

Model shear_frame(const ProblemOptions& options) {
  const FrameLikelihood frame(read_frame_observations(measurements_file(options)));
  const auto& measured = frame.observations();
  std::string description = "shear_frame";
  for (std::size_t i = 0; i < measured.mode.size(); ++i) {
    description += fmt::format(" {}:{}", measured.mode[i], io::format_number(measured.frequency_hz[i]));
  }
  Measurements measurements{.observed = {{"frequency_hz", measured.frequency_hz}},
                            .constant = {{"mode", {measured.mode.begin(), measured.mode.end()}}}};
  measurements.pointwise = [frame](const Eigen::MatrixXd& points) {
    return std::vector{std::pair{std::string("frequency_hz"), frame.pointwise(points)}};
  };
  return {prior_of(options, {.names = FrameLikelihood::parameter_names(), .nonnegative = true}), frame,
          description, measurements};
}

Model friction_rig(const ProblemOptions& options) {
  const auto measured = experiments::read_observations(measurements_file(options));
  const friction::Physics physics{.driving_force_n = options.driving_force_n};
  std::string description =
      fmt::format("friction, driving force {} N", io::format_number(options.driving_force_n));
  for (std::size_t i = 0; i < measured.size(); ++i) {
    description += fmt::format(" {}:{}:{}:{}", io::format_number(measured.nominal_ratio[i]),
                               io::format_number(measured.measured_ratio[i]),
                               io::format_number(measured.driving_frequency_hz[i]),
                               io::format_number(measured.phase_deg[i]));
  }
  return {prior_of(options,
                   {.names = {"friction_force", "natural_frequency", "phase_noise", "frequency_ratio_noise"},
                    .nonnegative = true}),
          friction::Likelihood(measured, physics),
          description,
          {.observed = {{"phase_deg", measured.phase_deg}, {"r_nominal", measured.nominal_ratio}},
           .constant = {{"r_measured", measured.measured_ratio},
                        {"driving_frequency_hz", measured.driving_frequency_hz}}}};
}

std::string description_of_file(const std::string& kind, const std::string& path) {
  return fmt::format("{} with checksum {}, {}", kind, storage::file_checksum(path),
                     io::printable_path(std::filesystem::canonical(path)));
}

/// The standard deviations of n observations, from a number, the file or the problem file.
std::vector<double> standard_deviations(const ProblemOptions& options, const io::CsvTable* table,
                                        std::size_t n) {
  const std::string& stated = options.standard_deviation;
  double number = 0.0;
  const auto [end, error] = std::from_chars(stated.data(), stated.data() + stated.size(), number);
  if (error == std::errc() && end == stated.data() + stated.size()) {
    if (!(number > 0.0) || !std::isfinite(number)) {
      options.refuse("--standard-deviation", "a positive number, or a column");
    }
    return std::vector<double>(n, number);
  }
  if (!options.observed_sd.empty()) {
    return options.observed_sd;
  }
  const std::string column = stated.empty() ? "standard_deviation" : stated;
  if (table == nullptr || (stated.empty() && !table->has(column) && !options.noise.empty())) {
    return std::vector<double>(n, 1.0);
  }
  auto values = table->numbers(column);
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!(values[row] > 0.0)) {
      table->fail(row, column, "a positive number");
    }
  }
  return values;
}

/// What the outputs of another program are compared with; nothing if they are log-likelihoods.
std::optional<models::GaussianData> data_of(const ProblemOptions& options,
                                            const std::vector<std::string>& names) {
  const bool is_asked = options.is_given("--observation") || options.is_given("--standard-deviation") ||
                        options.is_given("--noise");
  if (!is_asked && (options.um_bridge.empty() || !options.is_given("--observations"))) {
    return std::nullopt;
  }
  models::GaussianData data;
  std::optional<io::CsvTable> table;
  if (!options.observed.empty()) {
    data.observations = options.observed;
  } else if (options.is_given("--observations")) {
    table = io::CsvTable::read(options.observations);
    data.observations = table->numbers(options.observation.empty() ? "observation" : options.observation);
  } else {
    throw std::invalid_argument("--observation, --standard-deviation, --noise: expected --observations");
  }
  data.standard_deviations =
      standard_deviations(options, table ? &*table : nullptr, data.observations.size());
  if (!options.noise.empty()) {
    const auto found = std::find(names.begin(), names.end(), options.noise);
    if (found == names.end()) {
      options.refuse("--noise", fmt::format("one of the parameters {}", fmt::join(names, ", ")));
    }
    data.noise_column = found - names.begin();
  }
  try {
    data.validate();
  } catch (const errors::InvalidValue& error) {
    if (error.field() == "standard_deviations") {
      options.refuse("--standard-deviation", error.expected());
    }
    throw io::InputError(fmt::format("{}: data.{}", io::printable_path(options.file()->path), error.what()));
  }
  return data;
}

/// The same log-likelihood, whose rows are counted.
tmcmc::LogLikelihood counted(tmcmc::LogLikelihood model, const Listeners& listeners) {
  return [model = std::move(model), evaluated = listeners.evaluated](
             const Eigen::Ref<const Eigen::MatrixXd>& points, Eigen::Ref<Eigen::VectorXd> values) {
    model(points, values);
    evaluated(points.rows());
  };
}

/// Program, worker or server as a log-likelihood.
template <class External>
tmcmc::LogLikelihood compared(External model, const std::optional<models::GaussianData>& data) {
  if (!data) {
    return model;
  }
  return models::gaussian_likelihood(
      [model = std::move(model)](const Eigen::Ref<const Eigen::MatrixXd>& points,
                                 Eigen::Ref<Eigen::MatrixXd> outputs) { model.evaluate(points, outputs); },
      *data);
}

/// \param names  of the parameters that the model sees
/// \param description  what it depends on
tmcmc::LogLikelihood program_of(const ProblemOptions& options, const std::vector<std::string>& names,
                                const std::optional<models::GaussianData>& data, const Listeners& listeners,
                                std::string& description) {
  const std::size_t outputs = data ? data->observations.size() : 0;
  if (!options.command.empty()) {
    models::Program program({options.command, names, options.timeout_seconds, outputs});
    description = description_of_file("program", options.command);
    return compared(std::move(program), data);
  }
  if (!options.worker.empty()) {
    models::Worker worker({options.worker, names, options.timeout_seconds, listeners.note, outputs});
    description = description_of_file("worker", options.worker);
    return compared(std::move(worker), data);
  }
  models::UmBridgeOptions bridge;
  bridge.server.url = options.um_bridge;
  bridge.server.timeout_seconds = options.timeout_seconds;
  bridge.model = options.model;
  bridge.parameter_names = names;
  bridge.config = options.config;
  bridge.outputs = outputs;
  description = fmt::format("UM-Bridge model {} of {}", options.model, options.um_bridge);
  if (options.is_given("--config")) {
    description += " with " + options.config;
  }
  return compared(models::UmBridge(std::move(bridge)), data);
}

Model other_program(const ProblemOptions& options, const Listeners& listeners) {
  const auto require_name = [&](const std::string& name) {
    if (name.empty() || io::printable(name, std::string::npos) != name || name == "log_likelihood" ||
        (name == "run" && options.runs > 1)) {
      throw errors::InvalidValue("parameter", name,
                                 name == "run" ? "another name, which a column of the samples has"
                                               : "a printable name other than log_likelihood");
    }
    if (!options.netcdf.empty()) {
      storage::require_parameter_name(name);
    }
  };
  Model result{prior_of(options, {.require_name = require_name}), {}, {}};
  auto seen = result.prior.names();
  const auto data = data_of(options, seen);
  if (data && data->noise_column) {
    seen.erase(seen.begin() + *data->noise_column);
  }
  auto model = program_of(options, seen, data, listeners, result.description);
  if (data) {
    result.measurements.observed = {{"observation", data->observations}};
    result.measurements.constant = {{"standard_deviation", data->standard_deviations}};
  }
  if (options.is_given("--observations")) {
    result.description += ", observations with checksum " + storage::file_checksum(options.observations);
  } else if (data) {
    std::vector<std::string> numbers;
    for (std::size_t k = 0; k < data->observations.size(); ++k) {
      numbers.push_back(fmt::format("{}:{}", io::format_number(data->observations[k]),
                                    io::format_number(data->standard_deviations[k])));
    }
    result.description += fmt::format(", observations {}", fmt::join(numbers, " "));
  }
  if (data && !options.noise.empty()) {
    result.description += ", noise " + options.noise;
  }
  result.description += fmt::format(", parameters {}", fmt::join(result.prior.names(), ","));
  const tmcmc::Index batch = options.um_bridge.empty() ? options.batch : 1;
  const int calls = options.parallel ? static_cast<int>(*options.parallel) : options.thread_count();
  result.log_likelihood =
      models::parallel_batches(counted(std::move(model), listeners), {.calls = calls, .batch_rows = batch});
  return result;
}

/// The models in C++ by the names that built_in takes. One of your own is a function like these, and a row here.
const std::vector<std::pair<std::string, Model (*)(const ProblemOptions&)>> built_in_models = {
    {"shear_frame", shear_frame}, {"friction", friction_rig}};

}  // namespace

std::vector<std::string> built_in_names() {
  std::vector<std::string> names;
  for (const auto& [name, make] : built_in_models) {
    names.push_back(name);
  }
  return names;
}

Model make_model(const ProblemOptions& options, const Listeners& listeners) {
  const bool is_command = !options.command.empty(), is_worker = !options.worker.empty();
  if ((is_command && is_worker) || ((is_command || is_worker) && !options.um_bridge.empty()) ||
      (options.is_other_program() && options.is_given("--built-in"))) {
    throw std::invalid_argument("--built-in, --command, --worker, --um-bridge: expected one of them");
  }
  if (options.um_bridge.empty() != options.model.empty()) {
    throw std::invalid_argument("--um-bridge, --model: expected both of them");
  }
  if (options.is_other_program()) {
    return other_program(options, listeners);
  }
  const auto built_in = std::find_if(built_in_models.begin(), built_in_models.end(),
                                     [&](const auto& row) { return row.first == options.built_in; });
  Model model = built_in->second(options);
  model.log_likelihood = counted(std::move(model.log_likelihood), listeners);
  return model;
}

}  // namespace examples
