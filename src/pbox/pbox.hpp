#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// Probability boxes of empirical distributions and the area metric between their bounds. S. Ferson
/// et al., "Constructing probability boxes and Dempster-Shafer structures", SAND2002-4015 (2003);
/// A. Lye, L. Marino, ESREL 2023, Eq. 25.
namespace pbox {

/// Empirical cumulative distribution function of one sample, in the unit of the sample.
class Ecdf {
 public:
  /// Sorts the samples, O(n log n).
  /// \throws errors::InvalidValue if there is no sample or a sample is not finite.
  explicit Ecdf(std::vector<double> samples);

  /// ECDF of weighted samples: the fraction of the weight at samples <= x. Samples of weight 0 are
  /// left out; equal weights give the function of the unweighted samples, bit for bit.
  /// \throws errors::InvalidValue unless there is a finite weight of at least 0 for each sample,
  ///         and at least one weight is positive.
  Ecdf(std::vector<double> samples, std::span<const double> weights);

  /// The fraction of the samples (or of their weight) that is <= x: a step function, continuous
  /// from the right; NaN if x is NaN. O(log n).
  double operator()(double x) const;

  /// The samples in ascending order, duplicates kept.
  std::span<const double> sorted() const noexcept { return sorted_; }
  /// Number of samples.
  std::size_t size() const noexcept { return sorted_.size(); }
  /// Whether the samples have different weights.
  bool is_weighted() const noexcept { return !levels_.empty(); }
  /// The value of the ECDF at and to the right of the first k sorted samples; 0 for k = 0.
  double level(std::size_t k) const {
    return k > 0 && is_weighted() ? levels_[k - 1] : static_cast<double>(k) / static_cast<double>(size());
  }

 private:
  std::vector<double> sorted_;
  // value after each sorted sample; empty for equal weights
  std::vector<double> levels_;
};

/// Right-continuous step bounds of a set of distribution functions: on [x[i], x[i+1]) all of the
/// functions lie in [lower[i], upper[i]]. Below x.front() both bounds are 0, at and above x.back()
/// both are 1. x is strictly increasing, in the unit of the samples; the three vectors have the
/// same length, at least 1.
struct PBox {
  /// Breakpoints, strictly increasing.
  std::vector<double> x;
  /// Smallest fraction on [x[i], x[i+1]).
  std::vector<double> lower;
  /// Largest fraction on [x[i], x[i+1]).
  std::vector<double> upper;
};

/// The bounds of a p-box at one point, 0 <= lower <= upper <= 1.
struct Bounds {
  /// Smallest value of any of the distribution functions.
  double lower = 0.0;
  /// Largest value of any of the distribution functions.
  double upper = 0.0;
};

/// The tightest p-box around the ECDFs, whose sample sizes may differ. x holds every distinct
/// sample. O(M log M) for M samples in total.
/// \throws errors::InvalidValue for an empty set.
PBox envelope(std::span<const Ecdf> ecdfs);

/// The bounds at x; NaN if x is NaN. O(log n).
/// \throws errors::InvalidValue if the vectors are empty or differ in length.
Bounds evaluate(const PBox& box, double x);

/// The exact integral of (upper - lower) dx (Eq. 25), in the unit of x, summed in index order;
/// finite if the integral is.
/// \throws errors::InvalidValue if the vectors are empty or differ in length.
double area(const PBox& box);

/// area(envelope(ecdfs)), in the unit of the samples; for two ECDFs it is their 1-Wasserstein
/// distance. If all samples have the same size n and none is weighted, it is computed without
/// building the p-box, in O(M), as
///
///     (1/n) * sum over ranks k of (max over r of x_r(k) - min over r of x_r(k)),
///
/// where x_r(k) is the k-th smallest sample of ECDF r, because the bounds of equal-size ECDFs are
/// the ECDFs of the rank-wise extremes. The two methods agree up to rounding, not bit for bit. The
/// result is finite if the area is, even where a width or the sum over the ranks exceeds the
/// largest double.
/// \throws errors::InvalidValue for an empty set.
double area_metric(std::span<const Ecdf> ecdfs);

}  // namespace pbox
