#include "tmcmc/detail/vector_sums.hpp"

#include "portable_math/multiversion.hpp"
#include "portable_math/sums.hpp"

namespace tmcmc::detail {

PORTABLE_MATH_MULTIVERSION
double sum(const double* x, Index n) {
  return portable_math::sum_of(static_cast<std::size_t>(n), [=](std::size_t i) { return x[i]; });
}

PORTABLE_MATH_MULTIVERSION
double sum_of_products(const double* x, const double* y, Index n) {
  return portable_math::sum_of(static_cast<std::size_t>(n), [=](std::size_t i) { return x[i] * y[i]; });
}

}  // namespace tmcmc::detail
