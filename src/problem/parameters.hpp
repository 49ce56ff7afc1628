/// \file
/// The prior of a problem file.
#pragma once

#include "problem/node.hpp"
#include "problem/parameter_rules.hpp"
#include "tmcmc/prior.hpp"

namespace problem {

/// Reads the table `parameters`, with one table per parameter under its name, and the table
/// `correlation`:
///
///     [parameters]
///     stiffness = {distribution = "log_normal", mean = 0.9, sd = 0.3, unit = "N/m"}
///     noise     = {lower = 0.001, upper = 0.1}                  # uniform
///
///     [correlation]
///     of = "normal_score"                                       # or "parameter"
///     pairs = [["stiffness", "noise", 0.5]]                     # the others are 0
///
/// Distributions and their arguments are listed in tmcmc::distributions(). An argument that is the
/// name of a preceding parameter makes the prior hierarchical: theta = {distribution = "normal",
/// mean = "mu", sd = "tau"}. A bound of truncated_normal may be missing.
/// \throws io::InputError naming file, line, key, value and what was expected.
[[nodiscard]] tmcmc::Prior read_parameters(const File& file, const ParameterRules& rules);

}  // namespace problem
