/// \file
/// Importance weights w_i = L_i^dbeta of a tempering step (Eq. 4), computed from log-likelihoods.
/// The log-weights are always shifted by the largest, so that a constant added to the
/// log-likelihood changes only the log-mean. Sums run over blocks of a fixed size; `threads`
/// changes no result.
#pragma once

#include <array>
#include <string_view>
#include <type_traits>

#include "tmcmc/types.hpp"

namespace tmcmc {

/// Divisor of the variance of the weights in Eq. 6.
enum class Deviation {
  /// Divisor N; then N_eff = N / (1 + CoV^2) exactly.
  population,
  /// Divisor N - 1, as in the published scripts.
  sample
};
constexpr std::array<std::string_view, 2> enumerator_names(std::type_identity<Deviation>) {
  return {"population", "sample"};
}

/// The samples that a criterion counts.
enum class Counted {
  all,
  /// Samples whose log-likelihood is not minus infinity.
  feasible
};
constexpr std::array<std::string_view, 2> enumerator_names(std::type_identity<Counted>) {
  return {"all", "feasible"};
}

/// Number of log-likelihoods that are not minus infinity.
[[nodiscard]] Index count_feasible(ConstDoubles log_likelihood);

/// Effective sample size N_eff = (sum w)^2 / sum w^2 (Eqs. 7-8; Kish 1965, Kong 1992); 0 if no
/// sample is feasible.
/// \param step  dbeta > 0
[[nodiscard]] double effective_sample_size(ConstDoubles log_likelihood, double step);

/// Coefficient of variation std(w) / mean(w) (Eq. 6), computed from the deviations from the mean.
/// NaN if no sample is counted, and with Deviation::sample if only one is.
[[nodiscard]] double coefficient_of_variation(ConstDoubles log_likelihood, double step,
                                              Deviation deviation = Deviation::population,
                                              Counted counted = Counted::all);

/// Both of the above for a search over many steps; each call evaluates the weights once and does
/// not store them.
class WeightStatistics {
 public:
  /// \param log_likelihood  non-owning view, which must outlive this object
  explicit WeightStatistics(ConstDoubles log_likelihood, int threads = 1);

  /// Number of log-likelihoods that are not minus infinity.
  [[nodiscard]] Index feasible() const { return feasible_; }
  /// As the free function of this name.
  [[nodiscard]] double effective_sample_size(double step) const;
  /// As the free function of this name.
  [[nodiscard]] double coefficient_of_variation(double step, Deviation deviation, Counted counted) const;
  /// Standard deviation of the feasible log-likelihoods; 0 if it is not a positive number.
  [[nodiscard]] double log_likelihood_spread() const;

 private:
  template <class Body, class Combine>
  auto reduce(Body body, Combine combine) const;

  ConstDoubles log_likelihood_;
  int threads_;
  Index feasible_;
  double largest_;
};

/// log( (1/N) sum w ) over all samples: the increment of the log-evidence (Ching and Chen 2007);
/// minus infinity if no sample is feasible.
[[nodiscard]] double log_mean_weight(ConstDoubles log_likelihood, double step);

/// Sums of the weights of a step.
struct WeightSums {
  /// Sum of the weights relative to the largest weight.
  double sum;
  /// Log-mean of the weights themselves, see log_mean_weight.
  double log_mean;
};

/// Fills in the weights relative to the largest weight.
/// \param weights  as long as log_likelihood
WeightSums relative_weights(ConstDoubles log_likelihood, double step, std::span<double> weights,
                            int threads = 1);

}  // namespace tmcmc
