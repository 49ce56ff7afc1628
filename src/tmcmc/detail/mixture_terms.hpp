/// \file
/// Terms of a mixture of Student t distributions at blocks of points.
#pragma once

#include <vector>

#include "tmcmc/detail/mixture_component.hpp"

namespace tmcmc::detail {

/// Number of rows that are processed together: their intermediate results stay in the cache.
constexpr Index mixture_rows = 256;

/// Terms of a mixture at up to mixture_rows points: q(z_i) = exp(log_scale_i) sum_i, where
/// component k contributes term_ik to sum_i. Entry i of component k is stored at k * mixture_rows +
/// i.
class MixtureTerms {
 public:
  /// \param mixture  non-owning view, which must outlive this object
  explicit MixtureTerms(const StudentMixture& mixture);
  /// \param points,stride  first coordinate of the first point; coordinate j is stored j * stride
  ///        further on
  void evaluate(const double* points, Index stride, Index rows);

  /// Squared distances |L_k^-1 (z_i - m_k)|^2.
  [[nodiscard]] const double* distances() const { return distances_.data(); }
  /// Terms of the components, including their wider parts.
  [[nodiscard]] const double* terms() const { return terms_.data(); }
  [[nodiscard]] const double* sum() const { return sum_.data(); }
  [[nodiscard]] const double* log_scale() const { return log_scale_.data(); }

 private:
  /// Whether there is a version for this small number of coordinates.
  [[nodiscard]] bool is_usual() const;
  void evaluate_by_logarithms(Index i);

  std::vector<Component> components_;
  Index d_;
  Index degrees_of_freedom_;
  double wide_share_;
  // 1 / c^2
  double inverse_square_;
  // constant of a component
  double log_largest_ = 0.0;
  Eigen::ArrayXXd white_, distances_, terms_;
  Eigen::ArrayXd sum_, log_scale_;
};

}  // namespace tmcmc::detail
