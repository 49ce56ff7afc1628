/// \file
/// The options of the sampler as text: for command lines, checkpoints and documentation.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tmcmc/options.hpp"

namespace tmcmc {

/// An option with the texts that it accepts.
struct OptionText : OptionInfo {
  /// Names of its values; empty for a number.
  std::vector<std::string> values;
  /// Completes "expected ...".
  std::string expected;
  /// Text of the default.
  std::string preset;
};

/// All options of a run, in the order in which they can be set: an option that gives others a
/// meaning comes before them.
[[nodiscard]] const std::vector<OptionText>& option_table();

/// The value of an option, with enough digits to read back the same number; nothing if the option
/// has no meaning under the other options.
/// \throws errors::InvalidValue if there is no option with this name.
[[nodiscard]] std::optional<std::string> option_value(const Options& options, std::string_view name);

/// Name and value of each option that has a meaning under the other options and on which the
/// results of a run depend (OptionInfo::changes_samples).
[[nodiscard]] std::vector<std::pair<std::string, std::string>> sample_settings(const Options& options);

/// The text of a value as option_value() would return it; nothing if the option does not accept the
/// value.
/// \throws errors::InvalidValue if there is no option with this name.
[[nodiscard]] std::optional<std::string> normalised_option(std::string_view name, std::string_view value);

/// Sets an option. When another alternative of a variant is chosen, such as another move, its
/// options start from their defaults.
/// \throws errors::InvalidValue for a value that the option does not accept, for an option that has
///         no meaning under the other options, and if there is no option with this name.
void set_option(Options& options, std::string_view name, std::string_view value);

}  // namespace tmcmc
