/// \file
/// Covariance of the Normal proposal (Eq. 5).
#pragma once

#include "tmcmc/proposal_options.hpp"
#include "tmcmc/types.hpp"

namespace tmcmc::detail {

/// Sigma = scale^2 sum_i w_i (theta_i - m)(theta_i - m)^T / sum_i w_i, d x d.
/// \param points   n x d
/// \param weights  n, non-negative, with the sum weight_sum > 0
/// \param threads  number of threads; the result does not depend on it
[[nodiscard]] Eigen::MatrixXd proposal_covariance(const Population& points, ConstDoubles weights,
                                                  double weight_sum, double scale, Centre centre,
                                                  int threads = 1);

/// sum_i w_i theta_i / sum_i w_i, d.
[[nodiscard]] Eigen::VectorXd weighted_mean(const Population& points, ConstDoubles weights, double weight_sum,
                                            int threads = 1);

/// Lower triangular factor of a positive semidefinite matrix: a direction of zero variance gets a
/// zero column. Plain loops, since the order of Eigen's sums depends on the instruction set.
/// \throws SamplingError if an entry is not finite or a pivot is negative beyond rounding. Without
///         pivoting, rounding can reach 1e-2 of the variance after a direction of almost zero
///         variance.
[[nodiscard]] Eigen::MatrixXd cholesky_factor(const Eigen::MatrixXd& covariance);

}  // namespace tmcmc::detail
