#include "tmcmc/detail/mixture_component.hpp"

#include <cmath>
#include <numbers>

#include "portable_math/elementary.hpp"

namespace tmcmc::detail {

namespace {

/// Logarithm of a product, computed with few logarithms.
class LogProduct {
 public:
  void multiply(double factor) {
    product_ *= factor;
    if (!(product_ > 1e-150 && product_ < 1e150)) {
      log_ += portable_math::log(product_);
      product_ = 1.0;
    }
  }
  [[nodiscard]] double log() const { return log_ + portable_math::log(product_); }

 private:
  double product_ = 1.0;
  double log_ = 0.0;
};

/// log Gamma(twice / 2), by the recurrence from Gamma(1) = 1 or Gamma(1/2) = sqrt(pi).
double log_gamma_of_half(Index twice) {
  LogProduct product;
  if (twice % 2 != 0) {
    product.multiply(std::sqrt(std::numbers::pi));
  }
  for (Index k = twice % 2 == 0 ? 2 : 1; k < twice; k += 2) {
    product.multiply(0.5 * static_cast<double>(k));
  }
  return product.log();
}

}  // namespace

double wider_volume(Index d) {
  return d < 4 ? static_cast<double>(Index{1} << d) : 16.0;
}

std::vector<Component> components_of(const StudentMixture& mixture) {
  const Index d = mixture.dimension();
  const Index nu = mixture.degrees_of_freedom;
  const double common =
      log_gamma_of_half(nu + d) - log_gamma_of_half(nu) -
      0.5 * static_cast<double>(d) * portable_math::log(static_cast<double>(nu) * std::numbers::pi);
  std::vector<Component> components;
  components.reserve(static_cast<std::size_t>(mixture.size()));
  for (Index k = 0; k < mixture.size(); ++k) {
    const Eigen::MatrixXd& factor = mixture.factors[static_cast<std::size_t>(k)];
    LogProduct determinant;
    for (Index j = 0; j < d; ++j) {
      determinant.multiply(factor(j, j));
    }
    const double constant = common + portable_math::log(mixture.weights[k]) - determinant.log();
    components.push_back(
        {.mean = mixture.means.col(k).data(), .factor = factor.data(), .log_constant = constant});
  }
  return components;
}

}  // namespace tmcmc::detail
