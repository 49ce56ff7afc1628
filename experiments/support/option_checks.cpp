#include "option_checks.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "io/csv.hpp"

namespace experiments {

namespace {

constexpr double least_positive = 1e-100;
constexpr double most_positive = 1e100;

}  // namespace

void add_choice(CLI::App& app, const std::string& option, std::optional<std::string>& value,
                const std::vector<std::string>& names, const std::string& description,
                const std::string& group) {
  app.add_option(option, value, description)
      ->group(group)
      ->type_name(CLI::detail::join(names, "|"))
      ->check([names, option](const std::string& text) {
        for (const auto& name : names) {
          if (text == name) {
            return std::string();
          }
        }
        return fmt::format("{}: value '{}': expected {}", option, io::printable(text),
                           CLI::detail::join(names, " or "));
      });
}

CLI::Validator number(const std::string& option, const std::function<bool(double)>& accept,
                      const std::string& expected) {
  return CLI::Validator(
      [option, accept, expected](std::string& text) {
        double value = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || !accept(value)) {
          return fmt::format("{}: value '{}': expected {}", option, io::printable(text), expected);
        }
        text = io::format_number(value);
        return std::string();
      },
      "", option);
}

CLI::Validator positive(const std::string& option) {
  return number(
      option, [](double x) { return x >= least_positive && x <= most_positive; },
      "a positive number from 1e-100 to 1e100");
}

CLI::Validator non_negative(const std::string& option) {
  return number(
      option, [](double x) { return x == 0.0 || (x >= least_positive && x <= most_positive); },
      "0 or a positive number from 1e-100 to 1e100");
}

CLI::Validator count(const std::string& option, long least, long most) {
  CLI::Validator whole = number(
      option,
      [least, most](double x) {
        return x >= static_cast<double>(least) && x <= static_cast<double>(most) && x == std::floor(x);
      },
      fmt::format("a whole number from {} to {}", least, most));
  return CLI::Validator(
      [whole](std::string& text) {
        const std::string complaint = whole(text);
        if (complaint.empty()) {  // 1e+06 is no integer to CLI11
          text = fmt::format("{:.0f}", std::stod(text));
        }
        return complaint;
      },
      "", option);
}

}  // namespace experiments
