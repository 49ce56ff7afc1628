#include "command_line/sampler_options.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "command_line/checks.hpp"
#include "errors/invalid_value.hpp"

namespace command_line {

namespace {

[[noreturn]] void refuse(const OptionPlace& place, std::string_view name, std::string_view value,
                         const std::string& expected) {
  throw errors::InvalidValue(fmt::format("{}: value '{}'", place(name), value), "", expected);
}

}  // namespace

std::string option_of(std::string_view name) {
  std::string option = "--" + std::string(name);
  std::replace(option.begin(), option.end(), '_', '-');
  return option;
}

std::string type_of(const tmcmc::OptionText& option) {
  if (!option.values.empty()) {
    return fmt::format("{}", fmt::join(option.values, "|"));
  }
  return option.range.whole ? "INT" : "FLOAT";
}

CLI::Validator check_of(const tmcmc::OptionText& option) {
  return normalising(
      [name = option.name](const std::string& word) { return tmcmc::normalised_option(name, word); },
      option.expected);
}

void naming_options(const OptionPlace& place, const std::function<void()>& call) {
  try {
    call();
  } catch (const errors::InvalidValue& invalid) {
    constexpr std::string_view of_options = "options.";
    if (!invalid.field().starts_with(of_options)) {
      throw;
    }
    refuse(place, std::string_view(invalid.field()).substr(of_options.size()), invalid.value(),
           invalid.expected());
  }
}

void set_sampler_options(tmcmc::Options& options, const GivenOption& given, const OptionPlace& place) {
  naming_options(place, [&] {
    for (const tmcmc::OptionText& option : tmcmc::option_table()) {
      const auto value = given(option.name);
      if (value && !tmcmc::option_value(options, option.name)) {  // it would change nothing: a mistake
        refuse(place, option.name, *value,
               fmt::format("only with {}{}{}", option_of(option.needs_option),
                           option.needs_value.empty() ? "" : " ", option.needs_value));
      }
      if (value) {
        tmcmc::set_option(options, option.name, *value);
      }
    }
    options.validate();
  });
}

}  // namespace command_line
