// Reading of a problem file by ProblemOptions.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "io/csv.hpp"
#include "problem_options.hpp"

namespace examples {

namespace {

namespace fs = std::filesystem;

const std::string column_or_number = "COLUMN|FLOAT";
/// The one of these options that is given selects the model: a choice on the command line replaces
/// that of the file.
const std::vector<std::string> model_choices = {"--built-in", "--command", "--worker", "--um-bridge"};
bool contains(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The text of a value as the command line would give it; nothing for a value whose type differs
/// from that of the option.
std::optional<std::string> text_of(const problem::Node& node, bool is_number, const std::string& type) {
  if (const auto* boolean = std::get_if<bool>(&node.value)) {
    return type == "no|yes" ? std::optional<std::string>(*boolean ? "yes" : "no") : std::nullopt;
  }
  if (node.is_number()) {
    if (!is_number && type != column_or_number) {
      return std::nullopt;
    }
    const auto* integer = std::get_if<std::int64_t>(&node.value);
    return integer != nullptr ? std::to_string(*integer) : io::format_number(node.number());
  }
  const auto* text = std::get_if<std::string>(&node.value);
  return text == nullptr || is_number ? std::nullopt : std::optional(*text);
}

/// A path of the file, relative to the current directory.
std::string resolved(const std::string& file, const std::string& path) {
  return path.empty() || path == "-" ? path : (fs::path(file).parent_path() / path).string();
}

}  // namespace

void ProblemOptions::read() {
  if (path_.empty()) {
    return;
  }
  file_ = problem::read_file(path_);
  std::vector<std::string> tables = {"parameters", "correlation"};
  for (const Key& key : keys_) {
    if (!contains(tables, key.table)) {
      tables.push_back(key.table);
    }
  }
  for (const auto& [table, node] : file_->table(file_->root, "")) {
    if (!contains(tables, table)) {
      throw io::InputError(fmt::format("{}:{}: {}: unknown key: expected the tables {}",
                                       io::printable_path(path_), node.line, io::printable(table),
                                       fmt::join(tables, ", ")));
    }
    for (const auto& [name, value] : file_->table(node, table)) {
      if (table != "parameters" && table != "correlation") {
        take(table, name, value);
      }
    }
  }
  for (const char* table : {"parameters", "correlation"}) {
    const problem::Node* node = file_->root.find(table);
    if (node != nullptr && is_given("--prior") && key_of("--prior").option->count() == 0) {
      throw io::InputError(fmt::format("{}:{}: {}: expected no such table beside prior.file",
                                       io::printable_path(path_), node->line, table));
    }
  }
  const bool has_model = std::any_of(model_choices.begin(), model_choices.end(),
                                     [&](const std::string& option) { return is_given(option); });
  if (!has_model) {
    throw io::InputError(
        fmt::format("{}: no model: expected built_in, command, worker or um_bridge in the table [model]",
                    io::printable_path(path_)));
  }
}

/// Takes arrays of numbers, and the table with a model's configuration.
bool ProblemOptions::take_numbers(const std::string& table, const std::string& name,
                                  const problem::Node& node) {
  if (table == "model" && name == "config" && std::holds_alternative<problem::Table>(node.value)) {
    if (key_of("--config").option->count() == 0) {
      config = problem::to_json(node);
    }
    return true;
  }
  const bool is_array = std::holds_alternative<problem::Array>(node.value);
  if (!is_array || table != "data" || (name != "observation" && name != "standard_deviation")) {
    return false;
  }
  const auto key = std::find_if(keys_.begin(), keys_.end(),
                                [&](const Key& k) { return k.table == table && k.name == name; });
  if (key->option->count() == 0) {
    key->line = node.line;
    for (const problem::Node& element : std::get<problem::Array>(node.value)) {
      (name == "observation" ? observed : observed_sd).push_back(file_->number(element, table + "." + name));
    }
  }
  return true;
}

void ProblemOptions::take(const std::string& table, const std::string& name, const problem::Node& node) {
  const auto key = std::find_if(keys_.begin(), keys_.end(),
                                [&](const Key& k) { return k.table == table && k.name == name; });
  const std::string place = table + "." + name;
  if (key == keys_.end()) {
    std::vector<std::string> names;
    for (const Key& k : keys_) {
      if (k.table == table) {
        names.push_back(k.name);
      }
    }
    throw io::InputError(fmt::format("{}:{}: {}: unknown key: expected {}", io::printable_path(path_),
                                     node.line, io::printable(place), fmt::join(names, ", ")));
  }
  if (take_numbers(table, name, node)) {
    return;
  }
  std::optional<std::string> text = text_of(node, key->is_number, key->option->get_type_name());
  if (!text) {
    file_->fail(node, place, key->is_number ? "a number" : "a text in quotes");
  }
  if (const std::string wrong = key->check(*text); !wrong.empty()) {
    throw io::InputError(fmt::format("{}:{}: {}: {}", io::printable_path(path_), node.line, place, wrong));
  }
  const std::string type = key->option->get_type_name();
  if (type == "CSV" || type == "PROGRAM" || type == "FILE" || type == "DIRECTORY") {
    const std::string path = resolved(path_, *text);
    std::error_code ignored;
    if (type != "FILE" && type != "DIRECTORY" && !fs::exists(path, ignored)) {
      file_->fail(node, place, "a file that exists; a path begins where the problem file is");
    }
    text = path;
  }
  const bool is_replaced = contains(model_choices, key->option->get_name()) &&
                           std::any_of(keys_.begin(), keys_.end(), [&](const Key& k) {
                             return contains(model_choices, k.option->get_name()) && k.option->count() > 0;
                           });
  if (key->option->count() == 0 && !is_replaced) {
    key->set(*text);
    key->line = node.line;
    key->text = *text;
    key->option->default_str(*text);
  }
}

}  // namespace examples
