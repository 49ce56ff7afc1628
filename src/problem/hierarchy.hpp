/// \file
/// Hierarchical priors: distributions whose arguments are other parameters.
#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "tmcmc/distributions.hpp"
#include "tmcmc/prior.hpp"

namespace problem {

/// An argument of a distribution: a number, or the index of an earlier parameter.
using Argument = std::variant<double, std::size_t>;

/// A parameter and its distribution given the parameters that precede it.
struct ConditionalParameter {
  /// Name, as in tmcmc::Parameter.
  std::string name;
  /// Unit, as in tmcmc::Parameter.
  std::string unit;
  /// A row of tmcmc::distributions().
  tmcmc::Distribution distribution;
  /// Arguments in the order in which the distribution takes them.
  std::vector<Argument> arguments;

  /// Whether an argument is another parameter.
  [[nodiscard]] bool depends_on_others() const;
  /// The distribution at a point in which the preceding parameters are set; the point may be empty
  /// if the distribution does not depend on them.
  /// \throws errors::InvalidValue as tmcmc::Marginal, for arguments that the distribution does not
  ///         accept.
  [[nodiscard]] tmcmc::Marginal given(
      const Eigen::Ref<const Eigen::VectorXd>& point = Eigen::VectorXd()) const;
};

/// The joint prior: the product of the conditional densities, zero where an argument is outside the
/// range that its distribution accepts. A bound that is another parameter truncates the density,
/// and the coordinate counts as unbounded on that side.
/// \throws errors::InvalidValue with the name of a parameter, if the prior draws values of the
///         preceding parameters that are not valid arguments of its distribution (checked in 1000
///         draws), and as tmcmc::Prior(OwnPrior).
[[nodiscard]] tmcmc::Prior hierarchical_prior(std::vector<ConditionalParameter> parameters);

}  // namespace problem
