#include "option_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "io/csv.hpp"

namespace experiments {

namespace {

constexpr double least_positive = 1e-100;
constexpr double most_positive = 1e100;

template <class Number>
std::optional<Number> parsed(const std::string& word) {
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() ? std::optional(value) : std::nullopt;
}

}  // namespace

Check number(const std::function<bool(double)>& accept, const std::string& expected) {
  return {[accept](std::string& word) {
            const auto value = parsed<double>(word);
            const bool accepted = value && accept(*value);
            word = accepted ? io::format_number(*value) : word;
            return accepted;
          },
          expected};
}

Check positive() {
  return number([](double x) { return x >= least_positive && x <= most_positive; },
                "a positive number from 1e-100 to 1e100");
}

Check non_negative() {
  return number([](double x) { return x == 0.0 || (x >= least_positive && x <= most_positive); },
                "0 or a positive number from 1e-100 to 1e100");
}

Check count(long least, long most) {
  return {[least, most](std::string& word) {
            const auto value = parsed<double>(word);
            const bool accepted = value && *value >= static_cast<double>(least) &&
                                  *value <= static_cast<double>(most) && *value == std::floor(*value);
            word = accepted ? fmt::format("{:.0f}", *value) : word;
            return accepted;
          },
          fmt::format("a whole number from {} to {}", least, most)};
}

Check seed() {
  return {[](std::string& word) {
            const auto value = parsed<std::uint64_t>(word);
            word = value ? fmt::format("{}", *value) : word;
            return value.has_value();
          },
          "a whole number from 0 to 2^64 - 1"};
}

Check one_of(const std::vector<std::string>& words) {
  return {
      [words](const std::string& word) { return std::find(words.begin(), words.end(), word) != words.end(); },
      words.size() < 2
          ? fmt::format("{}", fmt::join(words, ""))
          : fmt::format("{} or {}", fmt::join(words.begin(), words.end() - 1, ", "), words.back())};
}

}  // namespace experiments
