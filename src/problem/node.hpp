/// \file
/// A TOML file (https://toml.io, version 1.0) as a tree of values that know their lines.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/errors.hpp"

namespace problem {

struct Node;
struct Entry;
/// The values of an array.
using Array = std::vector<Node>;
/// Keys with their values, in the order of the file.
using Table = std::vector<Entry>;

/// One value of a file.
struct Node {
  /// What it is.
  std::variant<bool, std::int64_t, double, std::string, Array, Table> value;
  /// Where it begins, from 1; 0 if the file does not have it.
  std::size_t line = 0;

  /// The value of a key; null if this is no table or has no such key.
  [[nodiscard]] const Node* find(std::string_view key) const;
  /// Whether it is an integer or a float.
  [[nodiscard]] bool is_number() const;
  /// An integer or float as a double. \throws std::bad_variant_access for another value.
  [[nodiscard]] double number() const;
};

/// A key of a table.
struct Entry {
  std::string key;  ///< its name
  Node node;        ///< its value
};

/// A file and its root, which is a table.
struct File {
  std::string path;  ///< as it was given
  Node root;         ///< its tables and values

  /// Throws the io::InputError "path:line: key: value '...': expected ...".
  [[noreturn]] void fail(const Node& node, std::string_view key, std::string_view expected) const;
  /// The text of a string.
  /// \throws io::InputError with the key for another value.
  [[nodiscard]] const std::string& text(const Node& node, std::string_view key) const;
  /// An integer or a float.
  /// \throws io::InputError with the key for another value, and for NaN.
  [[nodiscard]] double number(const Node& node, std::string_view key) const;
  /// The values of an array.
  /// \throws io::InputError with the key for another value.
  [[nodiscard]] const Array& array(const Node& node, std::string_view key) const;
  /// The keys of a table.
  /// \throws io::InputError with the key for another value.
  [[nodiscard]] const Table& table(const Node& node, std::string_view key) const;
};

/// Reads a file.
/// \throws io::InputError naming file and line, if it cannot be read or is no TOML, and for dates and times.
[[nodiscard]] File read_file(const std::string& path);

/// The value as JSON: what a table of the file is as the configuration of a model.
[[nodiscard]] std::string to_json(const Node& node);

}  // namespace problem
