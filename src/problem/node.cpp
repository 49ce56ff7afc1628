#include "problem/node.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/csv.hpp"
#include "io/csv_text.hpp"

namespace problem {

namespace {

constexpr std::size_t longest_shown = 80;

nlohmann::ordered_json json_of(const Node& node) {
  return std::visit(
      []<class Value>(const Value& value) {
        nlohmann::ordered_json json;
        if constexpr (std::is_same_v<Value, Array>) {
          json = nlohmann::ordered_json::array();
          for (const Node& element : value) {
            json.push_back(json_of(element));
          }
        } else if constexpr (std::is_same_v<Value, Table>) {
          json = nlohmann::ordered_json::object();
          for (const auto& [key, element] : value) {
            json[key] = json_of(element);
          }
        } else {
          json = value;
        }
        return json;
      },
      node.value);
}

/// The value as shown in a message.
std::string shown(const Node& node) {
  if (const auto* text = std::get_if<std::string>(&node.value)) {
    return io::printable(*text, longest_shown);
  }
  if (const auto* number = std::get_if<double>(&node.value)) {
    return io::format_number(*number);
  }
  return io::printable(to_json(node), longest_shown);
}

Node node_of(const toml::node& from, const std::string& path) {
  Node node{{}, from.source().begin.line};
  if (const auto* table = from.as_table()) {
    Table entries;
    for (const auto& [key, value] : *table) {
      entries.push_back({std::string(key.str()), node_of(value, path)});
    }
    const auto place = [&](const auto& entry) {  // toml++ sorts keys by their names
      const auto begin = table->get(entry.key)->source().begin;
      return std::pair(begin.line, begin.column);
    };
    std::stable_sort(entries.begin(), entries.end(),
                     [&](const auto& a, const auto& b) { return place(a) < place(b); });
    node.value = std::move(entries);
  } else if (const auto* array = from.as_array()) {
    Array values;
    for (const auto& value : *array) {
      values.push_back(node_of(value, path));
    }
    node.value = std::move(values);
  } else if (const auto* text = from.as_string()) {
    node.value = text->get();
  } else if (const auto* integer = from.as_integer()) {
    node.value = integer->get();
  } else if (const auto* number = from.as_floating_point()) {
    node.value = number->get();
  } else if (const auto* boolean = from.as_boolean()) {
    node.value = boolean->get();
  } else {
    throw io::InputError(fmt::format("{}:{}: a date or time: expected a number, a text or a table",
                                     io::printable_path(path), node.line));
  }
  return node;
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  const auto* table = std::get_if<Table>(&value);
  if (table == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(table->begin(), table->end(), [&](const auto& e) { return e.key == key; });
  return found == table->end() ? nullptr : &found->node;
}

bool Node::is_number() const {
  return std::holds_alternative<std::int64_t>(value) || std::holds_alternative<double>(value);
}

double Node::number() const {
  const auto* integer = std::get_if<std::int64_t>(&value);
  return integer != nullptr ? static_cast<double>(*integer) : std::get<double>(value);
}

void File::fail(const Node& node, std::string_view key, std::string_view expected) const {
  throw io::InputError(fmt::format("{}:{}: {}: value '{}': expected {}", io::printable_path(path), node.line,
                                   io::printable(key, longest_shown), shown(node), expected));
}

const std::string& File::text(const Node& node, std::string_view key) const {
  const auto* text = std::get_if<std::string>(&node.value);
  if (text == nullptr) {
    fail(node, key, "a text in quotes");
  }
  return *text;
}

double File::number(const Node& node, std::string_view key) const {
  if (!node.is_number() || std::isnan(node.number())) {
    fail(node, key, "a number");
  }
  return node.number();
}

const Array& File::array(const Node& node, std::string_view key) const {
  const auto* array = std::get_if<Array>(&node.value);
  if (array == nullptr) {
    fail(node, key, "an array in brackets");
  }
  return *array;
}

const Table& File::table(const Node& node, std::string_view key) const {
  const auto* table = std::get_if<Table>(&node.value);
  if (table == nullptr) {
    fail(node, key, "a table");
  }
  return *table;
}

File read_file(const std::string& path) {
  try {
    const toml::table root = toml::parse(io::csv_text::bytes_of(path), path);
    return {path, node_of(root, path)};
  } catch (const io::InputError& error) {
    io::InputFault fault = error.fault();
    if (fault.path.empty()) {
      throw;
    }
    fault.expected = "a problem file in TOML";
    throw io::InputError(fault);
  } catch (const toml::parse_error& error) {
    throw io::InputError(fmt::format("{}:{}: {}: expected valid TOML", io::printable_path(path),
                                     error.source().begin.line, io::printable(error.description(), 200)));
  }
}

std::string to_json(const Node& node) {
  return json_of(node).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace problem
