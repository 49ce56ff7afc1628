/// \file
/// Weighted moments of blocks of points, for the fit of a mixture of Student t distributions.
#pragma once

#include "tmcmc/detail/mixture_terms.hpp"

namespace tmcmc::detail {

/// Sums of one component over points, with deviations from the component's mean before a step of
/// the fit. The pull of a point is the part of it that is assigned to the component, times (nu + d)
/// / (nu + distance).
struct Moments {
  /// Sum of the assigned parts of the points.
  double taken = 0.0;
  /// Sum of the pulls.
  double pull = 0.0;
  /// Sum of the pulls times the deviations.
  Eigen::VectorXd first;
  /// Lower triangle of the sum of the pulls times the products of two deviations.
  Eigen::MatrixXd second;

  explicit Moments(Index d) : first(Eigen::VectorXd::Zero(d)), second(Eigen::MatrixXd::Zero(d, d)) {}
};

/// Points of a block, as evaluated in MixtureTerms.
struct MomentPoints {
  /// First coordinate of the first point; coordinate j is j * stride further on.
  const double* points;
  Index stride;
  Index rows;
  /// For each point: the part unit * term is assigned to a component.
  const double* unit;
};

/// Adds the points to the moments of component k of a mixture without wider parts.
void add_moments(const MomentPoints& block, const MixtureTerms& terms, const StudentMixture& mixture, Index k,
                 Moments& moments);

}  // namespace tmcmc::detail
