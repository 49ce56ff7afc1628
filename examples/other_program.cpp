#include "other_program.hpp"

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
#include "io/csv.hpp"
#include "models/forward_model.hpp"
#include "models/parallel_batches.hpp"
#include "models/program.hpp"
#include "models/um_bridge.hpp"
#include "models/worker.hpp"
#include "storage/checkpoint.hpp"

namespace examples {

namespace {

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

/// The data with which the outputs of another program are compared; nothing if the program returns
/// log-likelihoods.
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

/// Gives the model the log-likelihood of a program, worker or server, and its outputs if there are
/// data to compare them with.
template <class External>
void set_functions(Model& model, External external, const std::optional<models::GaussianData>& data) {
  if (!data) {
    model.log_likelihood = std::move(external);
    return;
  }
  const models::ForwardModel forward = [external = std::move(external)](
                                           const Eigen::Ref<const Eigen::MatrixXd>& points,
                                           Eigen::Ref<Eigen::MatrixXd> outputs) {
    external.evaluate(points, outputs);
  };
  model.log_likelihood = models::gaussian_likelihood(forward, *data);
  model.compared.outputs = models::without_noise(forward, data->noise_column);
  model.compared.noise = [data = *data](const auto& point, const auto&) {
    const Eigen::Map<const Eigen::RowVectorXd> stated(
        data.standard_deviations.data(), static_cast<Eigen::Index>(data.standard_deviations.size()));
    return Eigen::RowVectorXd((data.noise_column ? point[*data.noise_column] : 1.0) * stated);
  };
}

/// Sets the functions and the description of the model.
/// \param names  names of the parameters that the program sees
void set_program(Model& model, const ProblemOptions& options, const std::vector<std::string>& names,
                 const std::optional<models::GaussianData>& data, const Listeners& listeners) {
  const std::size_t outputs = data ? data->observations.size() : 0;
  if (!options.command.empty()) {
    models::Program program({options.command, names, options.timeout_seconds, outputs});
    model.description = description_of_file("program", options.command);
    return set_functions(model, std::move(program), data);
  }
  if (!options.worker.empty()) {
    models::Worker worker({options.worker, names, options.timeout_seconds, listeners.note, outputs});
    model.description = description_of_file("worker", options.worker);
    return set_functions(model, std::move(worker), data);
  }
  models::UmBridgeOptions bridge;
  bridge.server.url = options.um_bridge;
  bridge.server.timeout_seconds = options.timeout_seconds;
  bridge.model = options.model;
  bridge.parameter_names = names;
  bridge.config = options.config;
  bridge.outputs = outputs;
  model.description = fmt::format("UM-Bridge model {} of {}", options.model, options.um_bridge);
  if (options.is_given("--config")) {
    model.description += " with " + options.config;
  }
  set_functions(model, models::UmBridge(std::move(bridge)), data);
}

}  // namespace

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
  set_program(result, options, seen, data, listeners);
  if (data) {
    result.measurements.observed = {{"measured", data->observations}};
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
  const models::ParallelOptions parallel{.calls = calls, .batch_rows = batch};
  result.log_likelihood = models::parallel_batches(counted(result.log_likelihood, listeners), parallel);
  if (data) {
    result.compared.outputs = models::parallel_outputs(counted(result.compared.outputs, listeners), parallel);
  }
  return result;
}

}  // namespace examples
