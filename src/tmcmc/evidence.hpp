/// \file
/// Log-evidence by bridge sampling between neighbouring stages, with a standard error from one run.
#pragma once

#include <utility>
#include <vector>

#include "tmcmc/genealogy.hpp"

namespace tmcmc {

/// The accumulated sums of BridgeEvidence; each vector has one entry per population, starting with
/// the prior.
struct BridgeSums {
  /// Log-evidence at the last beta.
  double log_evidence = 0.0;
  /// Variance that independent samples would have.
  double least_variance = 0.0;
  /// Influence of each chain on the sum of the logarithms; empty before the first step.
  std::vector<std::vector<double>> influence;
};

/// The ratio Z_{t+1} / Z_t of the tempered evidences from the populations on both sides of a step
/// (Bennett 1976; Meng and Wong 1996): the root r of
///
///     mean_t[ w / (s w + (1-s) r) ] = mean_{t+1}[ r / (s w + (1-s) r) ],
///     w = L^step,  s = n_{t+1} / (n_t + n_{t+1}),
///
/// solved in log(r), where both sides are sums of logistic functions and nothing overflows. The
/// estimate needs no further evaluation, and unlike the mean weight of population t alone it also
/// uses regions first reached by population t+1. The standard error adds up the influence of each
/// chain on the sum of the logarithms, and counts chains with a common ancestor as one: the chains
/// of each stage are grouped by their ancestors in the earliest stage from which an effective
/// number of fewest_groups is left, at the latest the preceding stage, and the covariances with the
/// stages in between are added (Olsson and Douc 2019, with a lag that follows the genealogy). It is
/// at least the standard error of independent samples, the sum of 1/S - 1/n_t - 1/n_{t+1} with
/// S = n_t mean_t[s w / (s w + (1-s) r)] (Bennett 1976), which is large where the populations
/// hardly overlap. The estimate and its error do not include regions that no chain has reached.
class BridgeEvidence {
 public:
  BridgeEvidence() = default;
  /// Continues from sums that are consistent with each other (Progress::require_valid checks that).
  explicit BridgeEvidence(BridgeSums sums) : sums_(std::move(sums)) {}

  /// Adds a step. Sample i of a population belongs to chain i modulo the number of chains.
  /// \param before,after  log-likelihoods of the populations before and after the step
  /// \param chains  number of chains of `after`
  /// \param step  dbeta, not negative
  void add(ConstDoubles before, ConstDoubles after, Index chains, double step);

  /// Sum of the logarithms of the ratios added so far: log Z at the last beta, for a normalised
  /// prior.
  [[nodiscard]] double log_evidence() const { return sums_.log_evidence; }

  /// Standard error of log_evidence(). 0 before the first step. If all chains of a stage started
  /// from one chain, each of them is a group of its own. Infinity for a single chain.
  /// \param genealogy  genealogy of the last population; one entry for each step that was added
  [[nodiscard]] double standard_error(const Genealogy& genealogy) const;

  /// The sums from which another BridgeEvidence can continue.
  [[nodiscard]] const BridgeSums& sums() const { return sums_; }

 private:
  /// Variance of the contribution of the chains of a stage, plus twice its covariance with the
  /// contributions of earlier stages.
  [[nodiscard]] double variance_up_to(std::size_t stage, const Genealogy& genealogy) const;

  BridgeSums sums_;
  // work space
  std::vector<double> log_weights_before_;
  std::vector<double> log_weights_after_;
};

/// Sum over groups g of (sum of the values in g)^2, times G / (G - 1) where G = n^2 / sum_g n_g^2
/// is the effective number of groups: an estimate of the variance of a sum of n values of mean zero
/// that are independent between groups. Infinity for a single group.
/// \param groups  group of each value, numbered from 0
[[nodiscard]] double grouped_variance(ConstDoubles values, std::span<const Index> groups);

/// The smallest effective number of groups from which a variance is estimated, unless fewer groups
/// exist.
constexpr double fewest_groups = 6.0;

/// The effective number of groups n^2 / sum_g n_g^2.
[[nodiscard]] double effective_groups(std::span<const Index> groups);

}  // namespace tmcmc
