/// \file
/// Checks of option values, for CLI::Option::transform. What they refuse is
/// said in the one form that all errors have: option, value, what was expected.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace command_line {

/// Words that `normalised` takes; `expected` completes "expected ...".
/// \param normalised  the word as CLI11 parses it, which would take a leading 0 for octal and does
///        not know 1e+06 for an integer; nothing if it is refused
[[nodiscard]] CLI::Validator normalising(
    const std::function<std::optional<std::string>(const std::string&)>& normalised,
    const std::string& expected);
/// Numbers that `accept` takes; `expected` completes "expected ...".
[[nodiscard]] CLI::Validator number(const std::function<bool(double)>& accept, const std::string& expected);
/// From 1e-100 to 1e100: squares and ratios neither vanish nor overflow.
[[nodiscard]] CLI::Validator positive();
/// 0, or as positive.
[[nodiscard]] CLI::Validator non_negative();
/// Whole numbers from `least` to `most`, also as 1e6.
[[nodiscard]] CLI::Validator count(long least = 1, long most = 1000000000);
/// Whole numbers of 64 bits.
[[nodiscard]] CLI::Validator seed();
/// One of the words.
[[nodiscard]] CLI::Validator one_of(const std::vector<std::string>& words);

/// Adds an option for one of the names, a std::string or an optional one.
template <class Text>
CLI::Option* add_choice(CLI::App& app, const std::string& option, Text& value,
                        const std::vector<std::string>& names, const std::string& description) {
  return app.add_option(option, value, description)
      ->type_name(CLI::detail::join(names, "|"))
      ->transform(one_of(names));
}

}  // namespace command_line
