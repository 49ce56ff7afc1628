/// \file
/// What a model asks of its parameters, whatever their prior is read from.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace problem {

/// Of the arguments of a distribution: its square is a double.
constexpr double largest_number = 1e100;

/// What a model asks of its parameters.
struct ParameterRules {
  /// Those that there have to be, in the order of the model; empty: any, in the order of the file.
  std::vector<std::string> names = {};
  /// Whether no parameter may be negative.
  bool nonnegative = false;
  /// Throws errors::InvalidValue for a name that a parameter must not have; may be empty.
  std::function<void(const std::string& name)> require_name = {};
};

}  // namespace problem
