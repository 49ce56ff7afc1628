#include "problem/parameters.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"
#include "problem/hierarchy.hpp"

namespace problem {

namespace {

const std::string of_parameters = "parameter", of_normal_scores = "normal_score";

/// A parameter and its position in the file.
struct Stated {
  ConditionalParameter parameter;
  const Node* node;
};

std::size_t place_of(const std::vector<Stated>& parameters, std::string_view name) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Stated& s) { return s.parameter.name == name; });
  return static_cast<std::size_t>(found - parameters.begin());
}

Argument argument_of(const File& file, const Node& node, const std::string& key,
                     const std::vector<Stated>& before, bool may_be_infinite) {
  if (const auto* name = std::get_if<std::string>(&node.value)) {
    const std::size_t place = place_of(before, *name);
    if (place == before.size()) {
      file.fail(node, key, "a number, or the name of a parameter above");
    }
    return place;
  }
  const double number = file.number(node, key);
  if (!(std::abs(number) <= largest_number) && !(std::isinf(number) && may_be_infinite)) {
    file.fail(node, key, "a number from -1e100 to 1e100");
  }
  return number;
}

/// The form of the distribution whose arguments have the given names, in any order.
const tmcmc::Distribution* find_form(std::string_view distribution, const std::vector<std::string>& given) {
  for (const auto& form : tmcmc::distributions()) {
    if (form.name == distribution &&
        std::is_permutation(form.arguments.begin(), form.arguments.end(), given.begin(), given.end())) {
      return &form;
    }
  }
  return nullptr;
}

Stated stated(const File& file, const std::string& name, const Node& node,
              const std::vector<Stated>& before) {
  const std::string place = "parameters." + name;
  std::string distribution = "uniform", unit;
  std::vector<std::pair<std::string, Argument>> arguments;
  if (const Node* named = node.find("distribution")) {
    distribution = file.text(*named, place + ".distribution");
    if (tmcmc::argument_names(distribution).empty()) {
      file.fail(*named, place + ".distribution", tmcmc::distribution_names());
    }
  }
  const bool is_cut = distribution == "truncated_normal";
  for (const auto& [key, value] : file.table(node, place)) {
    if (key == "unit") {
      unit = file.text(value, place + ".unit");
    } else if (key != "distribution") {
      const bool is_bound = key == "lower" || key == "upper";
      arguments.emplace_back(key, argument_of(file, value, place + "." + key, before, is_cut && is_bound));
    }
  }
  std::vector<std::string> keys;
  std::transform(arguments.begin(), arguments.end(), std::back_inserter(keys),
                 [](const auto& a) { return a.first; });
  constexpr double unbounded = std::numeric_limits<double>::infinity();
  for (const char* bound : {"lower", "upper"}) {
    if (is_cut && std::find(keys.begin(), keys.end(), bound) == keys.end()) {
      keys.emplace_back(bound);
      arguments.emplace_back(bound, *bound == 'l' ? -unbounded : unbounded);
    }
  }
  const tmcmc::Distribution* form = find_form(distribution, keys);
  if (form == nullptr) {
    throw io::InputError(fmt::format(
        "{}:{}: {}: {} with '{}': expected {}, and perhaps unit", io::printable_path(file.path), node.line,
        io::printable(place), distribution, io::printable(fmt::format("{}", fmt::join(keys, ", ")), 200),
        tmcmc::argument_names(distribution)));
  }
  ConditionalParameter parameter{name, unit, *form, {}};
  for (const auto key : form->arguments) {
    const auto found =
        std::find_if(arguments.begin(), arguments.end(), [&](const auto& a) { return a.first == key; });
    parameter.arguments.push_back(found->second);
  }
  if (!parameter.depends_on_others()) {
    try {
      static_cast<void>(parameter.given());
    } catch (const errors::InvalidValue& error) {
      const Node* at = node.find(error.field());
      file.fail(at != nullptr ? *at : node, at != nullptr ? place + "." + error.field() : place,
                error.expected());
    }
  }
  return {std::move(parameter), &node};
}

void require_names(const File& file, const std::vector<Stated>& parameters, const ParameterRules& rules) {
  for (const auto& [parameter, node] : parameters) {
    if (!rules.names.empty() &&
        std::find(rules.names.begin(), rules.names.end(), parameter.name) == rules.names.end()) {
      throw io::InputError(fmt::format("{}:{}: parameters.{}: expected the parameters {}",
                                       io::printable_path(file.path), node->line,
                                       io::printable(parameter.name), fmt::join(rules.names, ", ")));
    }
    try {
      if (rules.require_name) {
        rules.require_name(parameter.name);
      }
    } catch (const errors::InvalidValue& error) {
      throw io::InputError(fmt::format("{}:{}: parameters: name '{}': expected {}",
                                       io::printable_path(file.path), node->line,
                                       io::printable(parameter.name), error.expected()));
    }
    if (rules.nonnegative && !parameter.depends_on_others() && !(parameter.given().support().lower >= 0.0)) {
      file.fail(*node, "parameters." + parameter.name, "a distribution of numbers of at least 0");
    }
  }
  for (const std::string& name : rules.names) {
    if (place_of(parameters, name) == parameters.size()) {
      throw io::InputError(fmt::format("{}:{}: parameters: no {}: expected the parameters {}",
                                       io::printable_path(file.path), file.root.find("parameters")->line,
                                       name, fmt::join(rules.names, ", ")));
    }
  }
}

/// The correlations given in the table, and their line.
tmcmc::Correlation correlation_of(const File& file, const Node& node, const std::vector<std::string>& names,
                                  const std::vector<tmcmc::Marginal>& marginals) {
  const auto d = static_cast<Eigen::Index>(names.size());
  tmcmc::Correlation result{Eigen::MatrixXd::Identity(d, d), tmcmc::CorrelationOf::normal_scores};
  const Node* of = nullptr;
  const Node* pairs = nullptr;
  for (const auto& [key, value] : file.table(node, "correlation")) {
    if (key != "of" && key != "pairs") {
      file.fail(value, "correlation." + key, "the keys of and pairs");
    }
    (key == "of" ? of : pairs) = &value;
  }
  if (of == nullptr || pairs == nullptr) {
    throw io::InputError(fmt::format("{}:{}: correlation: expected the keys of and pairs",
                                     io::printable_path(file.path), node.line));
  }
  const std::string& what = file.text(*of, "correlation.of");
  if (what != of_parameters && what != of_normal_scores) {
    file.fail(*of, "correlation.of", of_parameters + " or " + of_normal_scores);
  }
  result.of = what == of_parameters ? tmcmc::CorrelationOf::parameters : tmcmc::CorrelationOf::normal_scores;
  const std::string key = "correlation.pairs";
  for (const Node& pair : file.array(*pairs, key)) {
    const Array& cells = file.array(pair, key);
    std::array<std::size_t, 2> place{};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto found = cells.size() == 3 && std::holds_alternative<std::string>(cells[k].value)
                             ? std::find(names.begin(), names.end(), std::get<std::string>(cells[k].value))
                             : names.end();
      place[k] = static_cast<std::size_t>(found - names.begin());
    }
    if (place[0] == names.size() || place[1] == names.size() || place[0] == place[1] ||
        !cells[2].is_number() || !(std::abs(cells[2].number()) < 1.0)) {
      file.fail(pair, key, "two parameters and a number between -1 and 1");
    }
    const auto i = static_cast<Eigen::Index>(place[0]), j = static_cast<Eigen::Index>(place[1]);
    if (result.matrix(i, j) != 0.0) {
      file.fail(pair, key, "each pair once");
    }
    result.matrix(i, j) = result.matrix(j, i) = cells[2].number();
    const Eigen::Matrix2d alone =
        (Eigen::Matrix2d() << 1.0, cells[2].number(), cells[2].number(), 1.0).finished();
    try {  // each pair alone, to name its line
      static_cast<void>(tmcmc::normal_score_correlation(
          {alone, result.of}, std::array{marginals[place[0]], marginals[place[1]]}));
    } catch (const errors::InvalidValue& error) {
      file.fail(pair, key, error.expected());
    }
  }
  return result;
}

}  // namespace

tmcmc::Prior read_parameters(const File& file, const ParameterRules& rules) {
  const Node* const parameters = file.root.find("parameters");
  if (parameters == nullptr || file.table(*parameters, "parameters").empty()) {
    throw io::InputError(fmt::format("{}: no parameters: expected a table [parameters] with at least one",
                                     io::printable_path(file.path)));
  }
  std::vector<Stated> all;
  for (const auto& [name, node] : file.table(*parameters, "parameters")) {
    all.push_back(stated(file, name, node, all));
  }
  require_names(file, all, rules);
  const Node* const correlation = file.root.find("correlation");
  const auto dependent =
      std::find_if(all.begin(), all.end(), [](const Stated& s) { return s.parameter.depends_on_others(); });
  if (dependent != all.end()) {
    if (correlation != nullptr) {
      throw io::InputError(fmt::format(
          "{}:{}: correlation: expected none where the distribution of {} has other parameters",
          io::printable_path(file.path), correlation->line, io::printable(dependent->parameter.name)));
    }
    if (!rules.names.empty()) {
      file.fail(*dependent->node, "parameters." + dependent->parameter.name,
                "numbers as arguments, for a model that is built in");
    }
    std::vector<ConditionalParameter> joint;
    std::transform(all.begin(), all.end(), std::back_inserter(joint),
                   [](const Stated& s) { return s.parameter; });
    try {
      return hierarchical_prior(std::move(joint));
    } catch (const errors::InvalidValue& error) {
      const std::size_t place = place_of(all, error.field());
      throw io::InputError(fmt::format("{}:{}: parameters.{}: draws from the prior give it {}: expected {}",
                                       io::printable_path(file.path), all.at(place).node->line,
                                       io::printable(error.field()), error.value(), error.expected()));
    }
  }
  std::vector<tmcmc::Parameter> independent;
  std::vector<std::string> names;
  std::vector<tmcmc::Marginal> marginals;
  const auto take = [&](const ConditionalParameter& p) {
    names.push_back(p.name);
    marginals.push_back(p.given());
    independent.push_back({p.name, p.unit, marginals.back()});
  };
  for (std::size_t j = 0; j < all.size(); ++j) {
    take(rules.names.empty() ? all[j].parameter : all[place_of(all, rules.names[j])].parameter);
  }
  if (correlation == nullptr) {
    return tmcmc::Prior(std::move(independent));
  }
  const auto matrix = correlation_of(file, *correlation, names, marginals);
  try {
    return tmcmc::Prior(std::move(independent), matrix);
  } catch (const errors::InvalidValue& error) {
    throw io::InputError(fmt::format("{}:{}: correlation: expected {}", io::printable_path(file.path),
                                     correlation->line, error.expected()));
  }
}

}  // namespace problem
