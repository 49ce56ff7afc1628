/// \file
/// Estimates from weighted independent draws: log-evidence with its error, effective size, tail of
/// the weights.
#pragma once

#include "tmcmc/result.hpp"

namespace tmcmc {

/// Estimates from log-weights log w_i = log(L p) - log q of independent draws from q.
struct ImportanceEstimate {
  /// log of the mean weight: the log-evidence.
  double log_mean = 0.0;
  /// Of log_mean: error of the mean weight over the mean weight.
  double standard_error = 0.0;
  /// (sum w)^2 / sum w^2; 0 if all weights are 0.
  double effective_sample_size = 0.0;
  /// See pareto_shape().
  double pareto_shape = 0.0;
};

/// Estimates from the log-weights of draws. The draws of a reference density come in the order of
/// its components, which get fixed shares of the draws. Such a stratified sample has a mean that
/// varies less than the mean of as many free draws: the error is computed from the deviations from
/// the means of runs of up to 64 consecutive draws (Cochran 1977, Section 5). For draws in any
/// other order this is the usual error.
/// \param log_weights  free of NaN and plus infinity; minus infinity is a weight of zero
[[nodiscard]] ImportanceEstimate importance_estimate(ConstDoubles log_weights);

/// Weights relative to their mean: they sum to n. All zero if every log-weight is minus infinity.
[[nodiscard]] Eigen::VectorXd normalised_weights(ConstDoubles log_weights);

/// k-hat, the shape of the generalised Pareto distribution of the largest min(n/5, 3 sqrt(n))
/// weights (Vehtari, Simpson, Gelman, Yao and Gabry 2024), fitted by the method of Zhang and
/// Stephens (2009) with the weakly informative prior of the former authors. The variance of the
/// weights is finite below 1/2; above 0.7 neither a mean nor its error is reliable. Minus infinity
/// for fewer than 25 draws, and if all weights are equal.
[[nodiscard]] double pareto_shape(ConstDoubles log_weights);

/// The largest power t in (0, 1] for which the weights w^t have an effective size of at least
/// `target`; 1 if the weights w have it, and 0 if there are fewer positive weights than `target`.
[[nodiscard]] double tempering_power(ConstDoubles log_weights, double target);

}  // namespace tmcmc
