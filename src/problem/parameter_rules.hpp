/// \file
/// Requirements of a model on its parameters, independent of the source of their prior.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace problem {

/// Largest magnitude of an argument of a distribution; its square is still a double.
constexpr double largest_number = 1e100;

/// Requirements of a model on its parameters.
struct ParameterRules {
  /// Names of the required parameters, in the order of the model; empty: any names, in the order of
  /// the file.
  std::vector<std::string> names = {};
  /// Whether no parameter may be negative.
  bool nonnegative = false;
  /// Throws errors::InvalidValue for a name that a parameter must not have; the function may be
  /// empty.
  std::function<void(const std::string& name)> require_name = {};
};

}  // namespace problem
