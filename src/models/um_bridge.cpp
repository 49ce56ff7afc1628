#include "models/um_bridge.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <nlohmann/json.hpp>
#include <numeric>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"
#include "models/model_error.hpp"
#include "models/pool.hpp"

namespace models {
namespace {

using nlohmann::json;
using Sizes = std::vector<std::size_t>;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t longest_shown = 80;

std::string shown(const json& value) {
  return io::printable(value.dump(), longest_shown);
}

/// The value of a key in an answer, converted to Value.
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

/// A number returned by a model; infinities may be written as Python writes them.
double number_of(const json& value, std::size_t outputs) {
  const double number = value.is_number()      ? value.get<double>()
                        : value == "-Infinity" ? -infinity
                        : value == "Infinity"  ? infinity
                                               : std::numeric_limits<double>::quiet_NaN();
  if (!is_admitted(number, outputs)) {
    throw ModelError(fmt::format("gave the output {}: expected a number or {}-Infinity{}", shown(value),
                                 outputs > 0 ? "Infinity or " : "",
                                 value.is_null() ? " (JSON libraries write null for NaN and infinities: "
                                                   "where the model excludes a point, let it give -1e100)"
                                                 : ""));
  }
  return number;
}

}  // namespace

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
    if (total(output_sizes) != columns_of(options.outputs)) {
      throw ModelError(fmt::format("has outputs of the sizes {}: expected {} in all, {}", output_sizes,
                                   columns_of(options.outputs),
                                   options.outputs > 0 ? "one for each observation"
                                                       : "the log-likelihood, or data to compare them with"));
    }
    connections.give_back(std::move(connection));
  }

  template <class Values>
  void evaluate(JsonConnection& connection, const Eigen::VectorXd& point, Values values) const {
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
    std::transform(vectors.begin(), vectors.end(), std::back_inserter(sizes),
                   [](const auto& vector) { return vector.size(); });
    if (sizes != output_sizes) {
      throw ModelError(fmt::format("gave outputs of the sizes {}: expected {}", sizes, output_sizes));
    }
    Eigen::Index k = 0;
    for (const auto& vector : vectors) {
      for (const json& value : vector) {
        values[k++] = number_of(value, options.outputs);
      }
    }
  }
};

UmBridge::UmBridge(UmBridgeOptions options) : state_(std::make_shared<State>()) {
  require_options(options.parameter_names, options.server.timeout_seconds);
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
  evaluate(points, Eigen::Map<Eigen::MatrixXd>(log_likelihood.data(), log_likelihood.size(), 1));
}

void UmBridge::evaluate(const Eigen::Ref<const Eigen::MatrixXd>& points,
                        Eigen::Ref<Eigen::MatrixXd> values) const {
  const auto& names = state_->options.parameter_names;
  require_shape(points, values, names.size(), state_->options.outputs);
  auto connection = state_->connections.take();
  if (!connection) {
    connection = std::make_unique<JsonConnection>(state_->options.server);
  }
  const long before = connection->repeated();
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    try {
      state_->evaluate(*connection, points.row(i).transpose(), values.row(i));
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
