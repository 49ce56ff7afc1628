/// \file
/// A TOML file (https://toml.io, version 1.0) as a tree of values that record their lines.
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
  /// The value itself.
  std::variant<bool, std::int64_t, double, std::string, Array, Table> value;
  /// Line of the file on which the value begins, from 1; 0 if the value is not in the file.
  std::size_t line = 0;

  /// The value of a key; null if this node is not a table or has no such key.
  [[nodiscard]] const Node* find(std::string_view key) const;
  /// Whether the value is an integer or a float.
  [[nodiscard]] bool is_number() const;
  /// The value of an integer or float as a double.
  /// \throws std::bad_variant_access for a value of another type.
  [[nodiscard]] double number() const;
};

/// A key of a table.
struct Entry {
  /// Name of the entry.
  std::string key;
  /// Value of the entry.
  Node node;
};

/// A file and its root, which is a table.
struct File {
  /// Path as given.
  std::string path;
  /// Tables and values of the file.
  Node root;

  /// \throws io::InputError always, with the text "path:line: key: value '...': expected ...".
  [[noreturn]] void fail(const Node& node, std::string_view key, std::string_view expected) const;
  /// The text of a string node.
  /// \throws io::InputError, naming the key, for a value of another type.
  [[nodiscard]] const std::string& text(const Node& node, std::string_view key) const;
  /// The number in an integer or float node.
  /// \throws io::InputError, naming the key, for a value of another type, and for NaN.
  [[nodiscard]] double number(const Node& node, std::string_view key) const;
  /// The values of an array node.
  /// \throws io::InputError, naming the key, for a value of another type.
  [[nodiscard]] const Array& array(const Node& node, std::string_view key) const;
  /// The entries of a table node.
  /// \throws io::InputError, naming the key, for a value of another type.
  [[nodiscard]] const Table& table(const Node& node, std::string_view key) const;
};

/// Reads a file.
/// \throws io::InputError, naming file and line, if the file cannot be read or is not TOML, and for
///         dates and times.
[[nodiscard]] File read_file(const std::string& path);

/// The value as JSON: the form in which a table of the file is passed to a model as its
/// configuration.
[[nodiscard]] std::string to_json(const Node& node);

}  // namespace problem
