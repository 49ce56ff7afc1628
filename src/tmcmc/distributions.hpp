/// \file
/// The distributions of a prior by name, for files, command lines and messages.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tmcmc/marginal.hpp"

namespace tmcmc {

/// One way to specify a distribution.
struct Distribution {
  /// Such as "log_normal".
  std::string_view name;
  /// Names, in the order in which `make` takes them.
  std::vector<std::string_view> arguments;
  Marginal (*make)(
      /// Throws errors::InvalidValue as the functions of Marginal.
      std::span<const double> arguments);
};

/// All ways to specify a distribution. A name that occurs several times can be specified by
/// different sets of arguments.
[[nodiscard]] std::span<const Distribution> distributions();

/// The distinct names, as "uniform, log_uniform, ... or triangular".
[[nodiscard]] std::string distribution_names();

/// The arguments of a distribution as "mu, sigma; or mean, sd; or median, cov"; empty for an
/// unknown name.
[[nodiscard]] std::string argument_names(std::string_view distribution);

/// The distribution with a given name whose arguments have exactly the given names.
/// \throws errors::InvalidValue with the field "distribution" for an unknown name (listing the
///         known names) or for argument names that the distribution does not have (listing those it
///         has); otherwise as the functions of Marginal.
[[nodiscard]] Marginal make_marginal(std::string_view distribution,
                                     const std::map<std::string, double, std::less<>>& arguments);

}  // namespace tmcmc
