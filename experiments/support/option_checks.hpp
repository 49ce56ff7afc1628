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

/// Numbers that `accept` takes. Like those below for Option::transform: CLI11 then converts what has been checked, and not
/// the word itself, in which it would take a leading 0 for octal.
CLI::Validator number(const std::string& option, const std::function<bool(double)>& accept,
                      const std::string& expected);
/// From 1e-100 to 1e100: squares and ratios neither vanish nor overflow.
CLI::Validator positive(const std::string& option);
/// 0, or as positive.
CLI::Validator non_negative(const std::string& option);
/// Whole numbers from `least` to `most`.
CLI::Validator count(const std::string& option, long least = 1, long most = 1000000000);

}  // namespace experiments
