/// \file
/// Priors from files: one row per parameter, and optionally a matrix of correlations.
#pragma once

#include <string>
#include <vector>

#include "problem/parameter_rules.hpp"
#include "tmcmc/prior.hpp"

namespace problem {

/// The files in which the user gives the prior.
struct PriorFiles {
  /// Path of the file with a row for each parameter.
  std::string marginals;
  /// Path of the matrix; empty for independence.
  std::string correlations;
};

/// A file with the columns `parameter`, `distribution`, a column for each argument of the
/// distributions that are used, and perhaps `unit`. A cell of an argument that the row's
/// distribution does not have stays empty. Without the column `distribution`, or where its cell is
/// empty, the row is uniform from `lower` to `upper`, as in table2_prior.csv.
///
/// The matrix of correlations has a first column with the names of parameters, and a column for
/// each in any order. The name of the first column says what is correlated: `parameter`, the
/// parameters themselves (Nataf's model), or `normal_score`, their normal scores (the Gaussian
/// copula).
/// \throws io::InputError naming file, line, column, value and what was expected.
[[nodiscard]] tmcmc::Prior read_prior(const PriorFiles& files, const ParameterRules& rules);

/// Names of the columns that an argument can stand in, each once.
[[nodiscard]] std::vector<std::string> argument_columns();

}  // namespace problem
