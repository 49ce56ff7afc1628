/// \file
/// Sums of vectors in a fixed order, for each instruction set.
#pragma once

#include "tmcmc/types.hpp"

namespace tmcmc::detail {

/// sum_i x_i
/// \param n  entries of x
[[nodiscard]] double sum(const double* x, Index n);
/// sum_i x_i y_i
[[nodiscard]] double sum_of_products(const double* x, const double* y, Index n);

}  // namespace tmcmc::detail
