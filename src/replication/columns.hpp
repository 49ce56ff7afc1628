/// \file
/// Columns of the tables of the replication: their names, and checks of what stands in them.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "io/csv.hpp"

namespace replication {

/// Names of the four parameters in columns of generated files, in the order of friction::Parameter,
/// with units.
inline const std::vector<std::string> parameter_columns = {"friction_force_n", "natural_frequency_hz",
                                                           "phase_noise_deg", "frequency_ratio_noise"};

/// The values of a column, each of which the rule has to allow; `expected` completes the sentence
/// "expected ...".
/// \throws io::InputError naming file, line, column and value.
template <class Value, class Rule>
[[nodiscard]] std::vector<Value> checked(const io::CsvTable& table, std::string_view column,
                                         std::vector<Value> values, Rule rule, std::string_view expected) {
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (!rule(values[row])) {
      table.fail(row, column, expected);
    }
  }
  return values;
}

/// The numbers of a column, which have to be positive.
/// \throws as checked.
[[nodiscard]] std::vector<double> positive_numbers(const io::CsvTable& table, std::string_view column);

/// The numbers of a column, of which none may be negative.
/// \throws as checked.
[[nodiscard]] std::vector<double> nonnegative_numbers(const io::CsvTable& table, std::string_view column);

/// The integers of a column, from 1.
/// \throws as checked.
[[nodiscard]] std::vector<long> positive_integers(const io::CsvTable& table, std::string_view column);

/// Refuses the first row whose key another row had before, by its cell of the column.
/// \throws as checked.
template <class Key>
void require_once(const io::CsvTable& table, const std::vector<Key>& keys, std::string_view column,
                  std::string_view expected) {
  std::set<Key> seen;
  for (std::size_t row = 0; row < keys.size(); ++row) {
    if (!seen.insert(keys[row]).second) {
      table.fail(row, column, expected);
    }
  }
}

/// Refuses a second row of a run; columns sampler and run.
/// \throws as checked.
void require_runs_once(const io::CsvTable& table);

}  // namespace replication
