#include "estimation/legendre_rule.hpp"

#include <boost/math/quadrature/gauss.hpp>

namespace estimation {

LegendreRule make_legendre_rule() {
  constexpr std::size_t order = LegendreRule::order;
  using Gauss = boost::math::quadrature::gauss<double, order>;
  LegendreRule rule{};
  for (std::size_t i = 0; i < order / 2; ++i) {
    rule.node[order / 2 + i] = Gauss::abscissa()[i];
    rule.node[order / 2 - 1 - i] = -Gauss::abscissa()[i];
    rule.weight[order / 2 + i] = rule.weight[order / 2 - 1 - i] = Gauss::weights()[i];
  }
  for (std::size_t j = 0; j <= order; ++j) {
    const auto degree = static_cast<double>(j);
    rule.up[j] = (2.0 * degree + 1.0) / (degree + 1.0);
    rule.down[j] = degree / (degree + 1.0);
  }
  for (std::size_t i = 0; i < order; ++i) {
    double previous = 0.0;
    double legendre = 1.0;
    for (std::size_t j = 0; j < order; ++j) {
      rule.to_coefficient[j][i] = (static_cast<double>(j) + 0.5) * rule.weight[i] * legendre;
      const double next = rule.up[j] * rule.node[i] * legendre - rule.down[j] * previous;
      previous = legendre;
      legendre = next;
    }
  }
  return rule;
}

}  // namespace estimation
