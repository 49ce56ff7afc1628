/// \file
/// Correlated parameters: Nataf's model, which is equivalent to the Gaussian copula.
#pragma once

#include <Eigen/Core>
#include <span>

#include "tmcmc/marginal.hpp"

namespace tmcmc {

/// The variables to which the entries of a correlation matrix refer.
enum class CorrelationOf {
  /// z_j = Phi^-1(F_j(x_j)): the matrix of the Gaussian copula itself.
  normal_scores,
  /// The parameters x_j; the normal-score matrix is computed from theirs (Nataf 1962; Liu and Der
  /// Kiureghian 1986).
  parameters
};

/// A correlation matrix over parameters, d x d; an empty one means independence.
struct Correlation {
  /// Symmetric and positive definite, ones on the diagonal.
  Eigen::MatrixXd matrix = {};
  /// Variables that are correlated.
  CorrelationOf of = CorrelationOf::normal_scores;
};

/// \throws errors::InvalidValue with the field "correlation" unless the matrix is d x d, symmetric
///         and positive definite, with ones on the diagonal and off-diagonal entries in (-1, 1).
void require_correlation(const Eigen::MatrixXd& matrix, Eigen::Index d);

/// Correlation of two parameters whose normal scores have the correlation rho: the sum over k >= 1
/// of a_k b_k rho^k, divided by the standard deviations, where a_k and b_k are the coefficients of
/// F^-1(Phi(z)) in normalised Hermite polynomials (Mehler's formula).
/// \throws errors::InvalidValue if a variance is infinite.
[[nodiscard]] double parameter_correlation(const Marginal& a, const Marginal& b, double rho);

/// Correlation matrix of the normal scores that corresponds to the given one, d x d; it is the
/// given one for CorrelationOf::normal_scores.
/// \throws errors::InvalidValue as require_correlation(), for a correlation that the two marginals
///         cannot have (naming the range that they can have), and if no Gaussian copula gives all
///         correlations at once.
[[nodiscard]] Eigen::MatrixXd normal_score_correlation(const Correlation& correlation,
                                                       std::span<const Marginal> marginals);

}  // namespace tmcmc
