/// \file
/// The 20-node Gauss-Legendre rule with the coefficients for a Legendre series through its nodes.
#pragma once

#include <array>
#include <cstddef>

namespace estimation {

/// Rule on [-1, 1].
struct LegendreRule {
  static constexpr std::size_t order = 20;  ///< nodes; the interpolant has degree order - 1
  std::array<double, order> node;           ///< ascending
  std::array<double, order> weight;         ///< weights, which sum to 2
  /// Coefficient j of the interpolant's Legendre series is the sum over i of to_coefficient[j][i] times the
  /// value at node i.
  std::array<std::array<double, order>, order> to_coefficient;
  std::array<double, order + 1> up;    ///< P_{j+1}(x) = up[j] x P_j(x) - down[j] P_{j-1}(x)
  std::array<double, order + 1> down;  ///< second coefficient of that recurrence
};

/// Nodes and weights of boost::math::quadrature::gauss.
[[nodiscard]] LegendreRule make_legendre_rule();

}  // namespace estimation
