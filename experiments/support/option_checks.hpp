/// \file
/// Checks of option values, with messages of the one form that all errors have: option, value, what was expected.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace experiments {

/// A choice among names that stand in the order of an enum; the value is checked when it is parsed.
void add_choice(CLI::App& app, const std::string& option, std::optional<std::string>& value,
                const std::vector<std::string>& names, const std::string& description,
                const std::string& group = "Reading, option by option");

/// Sets the target to the choice, if one was made.
template <class Enum>
void choose(const std::optional<std::string>& value, const std::vector<std::string>& names, Enum& target) {
  for (std::size_t i = 0; value && i < names.size(); ++i) {
    if (names[i] == *value) {
      target = static_cast<Enum>(i);
    }
  }
}

/// Numbers that `accept` takes.
CLI::Validator number(const std::string& option, const std::function<bool(double)>& accept,
                      const std::string& expected);
CLI::Validator positive(const std::string& option);
/// Whole numbers from `least` to 10^9.
CLI::Validator count(const std::string& option, long least = 1);

}  // namespace experiments
