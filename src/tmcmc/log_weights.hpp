/// \file
/// Importance weights w_i = L_i^dbeta of a tempering step (Eq. 4), from log-likelihoods; always shifted by
/// the largest, so that a constant added to the log-likelihood changes nothing but the log-mean.
#pragma once

#include <vector>

#include "tmcmc/types.hpp"

namespace tmcmc {

/// Divisor of the variance of the weights in Eq. 6.
enum class Deviation {
  population,  ///< N; then N_eff = N / (1 + CoV^2) exactly
  sample       ///< N - 1, as the published scripts
};

/// Which samples a criterion counts.
enum class Counted {
  all,
  feasible  ///< those whose log-likelihood is not minus infinity
};

/// Number of log-likelihoods that are not minus infinity.
[[nodiscard]] Index count_feasible(ConstDoubles log_likelihood);

/// Effective sample size N_eff = (sum w)^2 / sum w^2 (Eqs. 7-8; Kish 1965, Kong 1992); 0 if no sample is
/// feasible.
/// \param step  dbeta > 0
[[nodiscard]] double effective_sample_size(ConstDoubles log_likelihood, double step);

/// Coefficient of variation std(w) / mean(w) (Eq. 6), computed from the deviations from the mean.
/// NaN if no sample is counted; with Deviation::sample it needs two.
[[nodiscard]] double coefficient_of_variation(ConstDoubles log_likelihood, double step,
                                              Deviation deviation = Deviation::population,
                                              Counted counted = Counted::all);

/// Both of the above from one evaluation of the weights, for a search over many steps.
class WeightStatistics {
 public:
  /// \param log_likelihood  stays referred to, as does
  /// \param weights  work space, resized to the same length
  WeightStatistics(ConstDoubles log_likelihood, std::vector<double>& weights);

  [[nodiscard]] Index feasible() const { return feasible_; }
  [[nodiscard]] double effective_sample_size(double step);
  [[nodiscard]] double coefficient_of_variation(double step, Deviation deviation, Counted counted);

 private:
  double evaluate(double step);

  ConstDoubles log_likelihood_;
  Index feasible_;
  double largest_;
  std::vector<double>& weights_;
};

/// log( (1/N) sum w ) over all samples: the increment of the log-evidence (Ching and Chen 2007); minus
/// infinity if no sample is feasible.
[[nodiscard]] double log_mean_weight(ConstDoubles log_likelihood, double step);

struct WeightSums {
  double sum;       ///< of the weights relative to the largest
  double log_mean;  ///< of the weights themselves, see log_mean_weight
};

/// Fills the weights relative to the largest.
/// \param weights  as long as log_likelihood
WeightSums relative_weights(ConstDoubles log_likelihood, double step, std::span<double> weights);

}  // namespace tmcmc
