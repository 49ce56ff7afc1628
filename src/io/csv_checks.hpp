/// \file
/// Checks of the contents of a table's columns.
#pragma once

#include <set>
#include <string_view>
#include <vector>

#include "io/csv.hpp"

namespace io {

/// The values of a column, each of which must satisfy the rule; `expected` completes the sentence
/// "expected ...".
/// \throws InputError naming file, line, column and value.
template <class Value, class Rule>
[[nodiscard]] std::vector<Value> checked(const CsvTable& table, std::string_view column,
                                         std::vector<Value> values, Rule rule, std::string_view expected) {
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!rule(values[row])) {
      table.fail(row, column, expected);
    }
  }
  return values;
}

/// Refuses the first row whose key occurs in an earlier row; the message names its cell of the
/// column.
/// \throws as checked.
template <class Key>
void require_once(const CsvTable& table, const std::vector<Key>& keys, std::string_view column,
                  std::string_view expected) {
  std::set<Key> seen;
  for (std::size_t row = 0; row < keys.size(); ++row) {
    if (!seen.insert(keys[row]).second) {
      table.fail(row, column, expected);
    }
  }
}

}  // namespace io
