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

/// One way to state a distribution.
struct Distribution {
  std::string_view name;                    ///< such as "log_normal"
  std::vector<std::string_view> arguments;  ///< their names, in the order that `make` takes them in
  Marginal (*make)(
      std::span<const double> arguments);  ///< throws errors::InvalidValue as the functions of Marginal
};

/// Every way to state a distribution. A name that stands several times can be stated by different arguments.
[[nodiscard]] std::span<const Distribution> distributions();

/// The names, each once, as "uniform, log_uniform, ... or triangular".
[[nodiscard]] std::string distribution_names();

/// The arguments of a distribution as "mu, sigma; or mean, sd; or median, cov"; empty for an unknown name.
[[nodiscard]] std::string argument_names(std::string_view distribution);

/// The distribution of a name whose arguments have exactly the names given.
/// \throws errors::InvalidValue with the field "distribution" for an unknown name (with those that there are) or for names of
///         arguments that it does not go by (with those that it does); else as the functions of Marginal.
[[nodiscard]] Marginal make_marginal(std::string_view distribution,
                                     const std::map<std::string, double, std::less<>>& arguments);

}  // namespace tmcmc
