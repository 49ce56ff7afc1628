#include "option_checks.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "io/csv.hpp"

namespace experiments {

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
      [option, accept, expected](const std::string& text) {
        double value = 0.0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || !accept(value)) {
          return fmt::format("{}: value '{}': expected {}", option, io::printable(text), expected);
        }
        return std::string();
      },
      "", option);
}

CLI::Validator positive(const std::string& option) {
  return number(
      option, [](double x) { return x > 0.0 && std::isfinite(x); }, "a positive number");
}

CLI::Validator count(const std::string& option, long least) {
  return number(
      option, [least](double x) { return x >= static_cast<double>(least) && x <= 1e9 && x == std::floor(x); },
      fmt::format("a whole number, at least {}", least));
}

}  // namespace experiments
