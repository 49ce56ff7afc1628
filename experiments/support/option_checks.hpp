/// \file
/// Checks of option values. What they refuse is said in the one form that all errors have: option, value, what was expected.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace experiments {

/// What the value of an option has to be.
struct Check {
  /// Whether the word is accepted; it is then replaced by one that the options' parser reads as meant: that would take a
  /// leading 0 for octal, and does not know 1e+06 for an integer.
  std::function<bool(std::string& word)> accept;
  std::string expected;  ///< completes "expected ..."
};

/// Numbers that `accept` takes.
[[nodiscard]] Check number(const std::function<bool(double)>& accept, const std::string& expected);
/// From 1e-100 to 1e100: squares and ratios neither vanish nor overflow.
[[nodiscard]] Check positive();
/// 0, or as positive.
[[nodiscard]] Check non_negative();
/// Whole numbers from `least` to `most`.
[[nodiscard]] Check count(long least = 1, long most = 1000000000);
/// Whole numbers of 64 bits.
[[nodiscard]] Check seed();
/// One of the words.
[[nodiscard]] Check one_of(const std::vector<std::string>& words);

}  // namespace experiments
