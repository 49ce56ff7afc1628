/// \file
/// The options of the sampler as text: for command lines, checkpoints and documentation.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tmcmc/options.hpp"

namespace tmcmc {

/// An option with what its text can be.
struct OptionText : OptionInfo {
  /// Names of its values; empty for a number.
  std::vector<std::string> values;
  /// Completes "expected ...".
  std::string expected;
  /// The default.
  std::string preset;
};

/// All options of a run, in the order in which they can be set: one that gives others a meaning
/// comes before them.
[[nodiscard]] const std::vector<OptionText>& option_table();

/// The value of an option, in digits that read back as the same number; nothing where it has no
/// meaning under the others.
/// \throws errors::InvalidValue if there is no option of this name.
[[nodiscard]] std::optional<std::string> option_value(const Options& options, std::string_view name);

/// Name and value of each option that has a meaning under the others and on which a number of a run depends
/// (OptionInfo::changes_samples).
[[nodiscard]] std::vector<std::pair<std::string, std::string>> sample_settings(const Options& options);

/// The text of a value as option_value() would give it; nothing if the option does not take it.
/// \throws errors::InvalidValue if there is no option of this name.
[[nodiscard]] std::optional<std::string> normalised_option(std::string_view name, std::string_view value);

/// Sets an option. Another alternative of a variant, such as another move, begins with its
/// defaults.
/// \throws errors::InvalidValue for a value that the option does not take, for an option that has
///         no meaning under the others, and if there is no option of this name.
void set_option(Options& options, std::string_view name, std::string_view value);

}  // namespace tmcmc
