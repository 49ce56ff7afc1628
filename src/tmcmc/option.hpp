/// \file
/// What is known of one option of the sampler: its name, the values that it takes, and what it is
/// for.
///
/// The headers that declare options hold a function `visit_options`, which calls a visitor with the
/// description of each option and a pointer to its value. The pointer is null where the option has
/// no meaning, such as the number of chains of waste-free under another move. option_table.hpp
/// makes text of all that.
#pragma once

#include <string_view>

namespace tmcmc {

/// The numbers that an option takes; for options with names instead, all of them.
struct OptionRange {
  /// The smallest number.
  double least = 0.0;
  /// The largest number.
  double most = 0.0;
  /// Whether `least` itself is excluded.
  bool above_least = false;
  /// Whether `most` itself is excluded.
  bool below_most = false;
  /// Whether only whole numbers are taken.
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

/// Where options are listed together.
enum class OptionGroup {
  /// The paper's sampler and the readings of it.
  paper,
  /// Better samplers.
  beyond_the_paper,
  /// How a run is carried out, and what the programs set themselves.
  computation
};

/// Description of one option.
struct OptionInfo {
  /// With underscores: --move-steps is move_steps.
  std::string_view name;
  /// Where it is listed.
  OptionGroup group;
  /// Of its values.
  OptionRange range;
  /// One line.
  std::string_view help;
  /// The option that gives it a meaning; empty: it always has one.
  std::string_view needs_option = {};
  /// The value which that option must have; empty: any but the default.
  std::string_view needs_value = {};
  /// Whether the samples of a run depend on it.
  bool changes_samples = true;
};

/// Pointer to a member of an alternative; null for a null pointer.
template <class Alternative, class Member>
constexpr auto* member_of(Alternative* alternative, Member member) {
  return alternative == nullptr ? nullptr : &(alternative->*member);
}

}  // namespace tmcmc
