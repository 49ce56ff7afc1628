/// \file
/// Options of the sampler (tmcmc::option_table()) as options of a command line.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "tmcmc/option_table.hpp"

namespace command_line {

/// The option of a command line for an option of the sampler: --move-steps for move_steps.
[[nodiscard]] std::string option_of(std::string_view name);
/// What stands for the value of an option of the sampler in --help.
[[nodiscard]] std::string type_of(const tmcmc::OptionText& option);
/// The check of its value.
[[nodiscard]] CLI::Validator check_of(const tmcmc::OptionText& option);

/// The text that an option of the sampler was given; nothing if it was not given.
using GivenOption = std::function<std::optional<std::string>(std::string_view name)>;
/// How a message names an option of the sampler, such as --move-steps.
using OptionPlace = std::function<std::string(std::string_view name)>;

/// Calls; an option of the sampler that is refused is named by its place.
/// \throws errors::InvalidValue naming the place; what the call throws otherwise.
void naming_options(const OptionPlace& place, const std::function<void()>& call);

/// Sets the options of the sampler that were given, in the order of tmcmc::option_table().
/// \throws errors::InvalidValue naming the place, for values that are incompatible and for an
///         option that would change nothing.
void set_sampler_options(tmcmc::Options& options, const GivenOption& given, const OptionPlace& place);

}  // namespace command_line
