/// \file
/// Description of one option of the sampler: its name, the values that it accepts, and its purpose.
///
/// The headers that declare options define a function `visit_options`, which calls a visitor with
/// the description of each option and a pointer to its value. The pointer is null where the option
/// has no meaning, such as the number of chains of waste-free under another move. option_table.hpp
/// converts these descriptions to text.
#pragma once

#include <string_view>

namespace tmcmc {

/// The numbers that an option accepts; for options with named values, all numbers.
struct OptionRange {
  /// The smallest number.
  double least = 0.0;
  /// The largest number.
  double most = 0.0;
  /// Whether `least` itself is excluded.
  bool above_least = false;
  /// Whether `most` itself is excluded.
  bool below_most = false;
  /// Whether only whole numbers are accepted.
  bool whole = false;

  /// Whether a number is in the range; NaN never is.
  [[nodiscard]] constexpr bool admits(double x) const {
    return (above_least ? x > least : x >= least) && (below_most ? x < most : x <= most);
  }
};

/// Whole numbers from `least`.
constexpr OptionRange whole_from(double least, double most = 1e9) {
  return {.least = least, .most = most, .whole = true};
}
/// Positive numbers whose squares and ratios neither vanish nor overflow.
constexpr OptionRange positive_number() {
  return {.least = 1e-100, .most = 1e100};
}
/// Options whose values have names.
constexpr OptionRange named() {
  return {};
}

/// Groups in which options are listed together.
enum class OptionGroup {
  /// The paper's sampler and its readings.
  paper,
  /// Improved samplers.
  beyond_the_paper,
  /// Execution of a run, and settings that the programs make themselves.
  computation
};

/// Description of one option.
struct OptionInfo {
  /// Name with underscores: --move-steps is move_steps.
  std::string_view name;
  /// Group in which the option is listed.
  OptionGroup group;
  /// Range of its values.
  OptionRange range;
  /// Help text of one line.
  std::string_view help;
  /// The option that gives this option a meaning; empty if it always has one.
  std::string_view needs_option = {};
  /// The value that needs_option must have; empty: any value but the default.
  std::string_view needs_value = {};
  /// Whether the samples of a run depend on this option.
  bool changes_samples = true;
};

/// Pointer to a member of an alternative; null for a null pointer.
template <class Alternative, class Member>
constexpr auto* member_of(Alternative* alternative, Member member) {
  return alternative == nullptr ? nullptr : &(alternative->*member);
}

}  // namespace tmcmc
