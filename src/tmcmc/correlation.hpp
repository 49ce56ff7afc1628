/// \file
/// Correlated parameters: Nataf's model, which is the Gaussian copula.
#pragma once

#include <Eigen/Core>
#include <span>

#include "tmcmc/marginal.hpp"

namespace tmcmc {

/// What the entries of a correlation matrix are correlations of.
enum class CorrelationOf {
  normal_scores,  ///< z_j = Phi^-1(F_j(x_j)): the matrix of the Gaussian copula itself
  parameters  ///< the parameters x_j; the matrix of the normal scores is found from it (Nataf 1962; Liu and Der Kiureghian 1986)
};

/// A correlation matrix over parameters, d x d; an empty one means independence.
struct Correlation {
  Eigen::MatrixXd matrix = {};                      ///< symmetric and positive definite, ones on the diagonal
  CorrelationOf of = CorrelationOf::normal_scores;  ///< what it is about
};

/// \throws errors::InvalidValue with the field "correlation" unless the matrix is d x d, symmetric, with ones on the diagonal,
///         numbers in (-1, 1) beside it, and positive definite.
void require_correlation(const Eigen::MatrixXd& matrix, Eigen::Index d);

/// Correlation of two parameters whose normal scores have the correlation rho: the sum over k >= 1 of a_k b_k rho^k, with
/// a_k and b_k the coefficients of F^-1(Phi(z)) in normalised Hermite polynomials (Mehler's formula), over the standard
/// deviations.
/// \throws errors::InvalidValue if a variance is infinite.
[[nodiscard]] double parameter_correlation(const Marginal& a, const Marginal& b, double rho);

/// Correlation matrix of the normal scores for the one that is given, d x d; the same for CorrelationOf::normal_scores.
/// \throws errors::InvalidValue as require_correlation(), for a correlation that the two marginals cannot have (with the range
///         that they can), and where no Gaussian copula gives all of them at once.
[[nodiscard]] Eigen::MatrixXd normal_score_correlation(const Correlation& correlation,
                                                       std::span<const Marginal> marginals);

}  // namespace tmcmc
