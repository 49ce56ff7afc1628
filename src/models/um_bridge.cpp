#include "models/um_bridge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"
#include "models/model_error.hpp"
#include "models/pool.hpp"
#include "portable_math/elementary.hpp"

namespace models {
namespace {

using nlohmann::json;
using Sizes = std::vector<std::size_t>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t longest_shown = 80;

std::string shown(const json& value) {
  return io::printable(value.dump(), longest_shown);
}

/// The value of a key of an answer, converted.
template <class Value>
Value member(const json& answer, const char* key, const char* expected) {
  try {
    return answer.at(key).get<Value>();
  } catch (const json::exception&) {
    throw ModelError(fmt::format("answered {}: expected {} in '{}'", shown(answer), expected, key));
  }
}

std::size_t total(const Sizes& sizes) {
  return std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
}

/// A number of a model; "-Infinity" as Python writes it.
double number_of(const json& value) {
  const double number = value.is_number()      ? value.get<double>()
                        : value == "-Infinity" ? -infinity
                                               : std::numeric_limits<double>::quiet_NaN();
  if (!(number < infinity)) {
    throw ModelError(fmt::format("gave the output {}: expected a number or -Infinity", shown(value)));
  }
  return number;
}

}  // namespace

void GaussianData::validate() const {
  if (observations.empty() || standard_deviations.size() != observations.size()) {
    throw errors::InvalidValue(
        "standard_deviations", standard_deviations.size(),
        fmt::format("one for each of {} observations, at least one", observations.size()));
  }
  for (std::size_t k = 0; k < observations.size(); ++k) {
    if (!std::isfinite(observations[k])) {
      throw errors::InvalidValue(fmt::format("observations[{}]", k), observations[k], "a finite number");
    }
    if (!(standard_deviations[k] > 0.0) || !std::isfinite(standard_deviations[k])) {
      throw errors::InvalidValue(fmt::format("standard_deviations[{}]", k), standard_deviations[k],
                                 "a positive, finite number");
    }
  }
}

double GaussianData::log_likelihood(const std::vector<double>& outputs) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < observations.size(); ++k) {
    const double residual = (observations[k] - outputs[k]) / standard_deviations[k];
    sum -= 0.5 * residual * residual + portable_math::log(standard_deviations[k]);
  }
  return sum - 0.5 * static_cast<double>(observations.size()) * portable_math::log(2.0 * std::numbers::pi);
}

struct UmBridge::State {
  UmBridgeOptions options;
  json config;
  Sizes input_sizes;
  Sizes output_sizes;
  Pool<JsonConnection> connections;
  std::atomic<long> repeated = 0;

  [[nodiscard]] std::string name() const {
    return fmt::format("{}, model {}", io::printable(options.server.url, longest_shown),
                       io::printable(options.model, longest_shown));
  }

  void ask_for_model() {
    auto connection = std::make_unique<JsonConnection>(options.server);
    const json info = connection->get("/Info");
    if (member<double>(info, "protocolVersion", "1.0") != 1.0) {
      throw ModelError(
          fmt::format("has the protocol version {}: expected 1.0", shown(info["protocolVersion"])));
    }
    const auto models = member<std::vector<std::string>>(info, "models", "names of models");
    if (std::find(models.begin(), models.end(), options.model) == models.end()) {
      throw ModelError(fmt::format("is not there: expected one of {}", shown(info["models"])));
    }
    const json model_info = connection->post("/ModelInfo", {{"name", options.model}});
    if (!member<json>(model_info, "support", "an object").value("Evaluate", false)) {
      throw ModelError("does not support Evaluate");
    }
    const json request = {{"name", options.model}, {"config", config}};
    input_sizes = member<Sizes>(connection->post("/InputSizes", request), "inputSizes", "sizes");
    output_sizes = member<Sizes>(connection->post("/OutputSizes", request), "outputSizes", "sizes");
    const std::size_t d = options.parameter_names.size();
    if (total(input_sizes) != d) {
      throw ModelError(fmt::format("has inputs of the sizes {}: expected {} in all, one for each parameter",
                                   input_sizes, d));
    }
    const std::size_t outputs = options.data ? options.data->observations.size() : 1;
    if (total(output_sizes) != outputs) {
      throw ModelError(fmt::format(
          "has outputs of the sizes {}: expected {} in all, {}", output_sizes, outputs,
          options.data ? "one for each observation" : "the log-likelihood, or data to compare them with"));
    }
    connections.give_back(std::move(connection));
  }

  double evaluate(JsonConnection& connection, const Eigen::VectorXd& point) const {
    json input = json::array();
    const double* next = point.data();
    for (const std::size_t size : input_sizes) {
      input.push_back(std::vector<double>(next, next + size));
      next += size;
    }
    const json answer = connection.post(
        "/Evaluate", {{"name", options.model}, {"input", std::move(input)}, {"config", config}});
    const auto vectors = member<std::vector<std::vector<json>>>(answer, "output", "vectors");
    Sizes sizes;
    std::vector<double> outputs;
    for (const auto& vector : vectors) {
      sizes.push_back(vector.size());
      std::transform(vector.begin(), vector.end(), std::back_inserter(outputs), number_of);
    }
    if (sizes != output_sizes) {
      throw ModelError(fmt::format("gave outputs of the sizes {}: expected {}", sizes, output_sizes));
    }
    return options.data ? options.data->log_likelihood(outputs) : outputs[0];
  }
};

UmBridge::UmBridge(UmBridgeOptions options) : state_(std::make_shared<State>()) {
  require_options(options.parameter_names, options.server.timeout_seconds);
  if (options.data) {
    options.data->validate();
  }
  state_->config = json::parse(options.config, nullptr, false);
  if (!state_->config.is_object()) {
    throw errors::InvalidValue("config", io::printable(options.config), "a JSON object");
  }
  state_->options = std::move(options);
  try {
    state_->ask_for_model();
  } catch (const ModelError& error) {
    throw ModelError(state_->name() + ": " + error.what());
  }
}

void UmBridge::operator()(const Eigen::Ref<const Eigen::MatrixXd>& points,
                          Eigen::Ref<Eigen::VectorXd> log_likelihood) const {
  const auto& names = state_->options.parameter_names;
  require_shape(points, log_likelihood, names.size());
  auto connection = state_->connections.take();
  if (!connection) {
    connection = std::make_unique<JsonConnection>(state_->options.server);
  }
  const long before = connection->repeated();
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    try {
      log_likelihood[i] = state_->evaluate(*connection, points.row(i).transpose());
    } catch (const ModelError& error) {
      throw ModelError(
          fmt::format("{}: {}; {}", state_->name(), error.what(), describe_point(names, points, i)));
    }
  }
  state_->repeated += connection->repeated() - before;
  state_->connections.give_back(std::move(connection));
}

long UmBridge::repeated_requests() const {
  return state_->repeated;
}

}  // namespace models
