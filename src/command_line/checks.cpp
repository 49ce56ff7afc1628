#include "command_line/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "io/csv.hpp"

namespace command_line {

namespace {

template <class Number>
std::optional<Number> parsed(const std::string& word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() ? std::optional(value) : std::nullopt;
}

bool is_moderate(double x) {
  return x >= 1e-100 && x <= 1e100;
}

}  // namespace

CLI::Validator normalising(const std::function<std::optional<std::string>(const std::string&)>& normalised,
                           const std::string& expected) {
  return {[normalised, expected](std::string& word) {
            const auto accepted = normalised(word);
            const std::string found = io::printable(word);
            word = accepted.value_or(word);
            return accepted ? std::string() : fmt::format("value '{}': expected {}", found, expected);
          },
          ""};
}

CLI::Validator number(const std::function<bool(double)>& accept, const std::string& expected) {
  return normalising(
      [accept](const std::string& word) {
        const auto value = parsed<double>(word);
        return value && accept(*value) ? std::optional(io::format_number(*value)) : std::nullopt;
      },
      expected);
}

CLI::Validator positive() {
  return number(is_moderate, "a positive number from 1e-100 to 1e100");
}

CLI::Validator non_negative() {
  return number([](double x) { return x == 0.0 || is_moderate(x); },
                "0 or a positive number from 1e-100 to 1e100");
}

CLI::Validator count(long least, long most) {
  return normalising(
      [least, most](const std::string& word) {
        const auto x = parsed<double>(word);
        const bool fits = x && *x >= static_cast<double>(least) && *x <= static_cast<double>(most);
        return fits && *x == std::floor(*x) ? std::optional(fmt::format("{:.0f}", *x)) : std::nullopt;
      },
      fmt::format("a whole number from {} to {}", least, most));
}

CLI::Validator seed() {
  return normalising(
      [](const std::string& word) {
        const auto value = parsed<std::uint64_t>(word);
        return value ? std::optional(std::to_string(*value)) : std::nullopt;
      },
      "a whole number from 0 to 2^64 - 1");
}

CLI::Validator one_of(const std::vector<std::string>& words) {
  return normalising(
      [words](const std::string& word) {
        const bool is_known = std::find(words.begin(), words.end(), word) != words.end();
        return is_known ? std::optional(word) : std::nullopt;
      },
      words.size() < 2
          ? fmt::format("{}", fmt::join(words, ""))
          : fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back()));
}

}  // namespace command_line
