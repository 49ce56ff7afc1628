/// \file
/// The 20-node Gauss-Legendre rule with the coefficients for a Legendre series through its nodes.
#pragma once

#include <array>
#include <cstddef>

namespace estimation {

/// Rule on [-1, 1].
struct LegendreRule {
  /// Nodes; the interpolant has degree order - 1.
  static constexpr std::size_t order = 20;
  /// Nodes, ascending.
  std::array<double, order> node;
  /// Weights, which sum to 2.
  std::array<double, order> weight;
  /// Coefficient j of the interpolant's Legendre series is the sum over i of to_coefficient[j][i]
  /// times the value at node i.
  std::array<std::array<double, order>, order> to_coefficient;
  /// P_{j+1}(x) = up[j] x P_j(x) - down[j] P_{j-1}(x).
  std::array<double, order + 1> up;
  /// Second coefficient of that recurrence.
  std::array<double, order + 1> down;
};

/// Nodes and weights of boost::math::quadrature::gauss.
[[nodiscard]] LegendreRule make_legendre_rule();

}  // namespace estimation
