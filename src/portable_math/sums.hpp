/// \file
/// Sums in an order that depends only on the length: eight interleaved partial sums, added pairwise
/// at the end. Any compiler may vectorise the inner loop, and none may change the result.
#pragma once

#include <cstddef>

#include "portable_math/elementary.hpp"

namespace portable_math {

/// Number of interleaved partial sums.
constexpr std::size_t sum_lanes = 8;

/// The total of eight partial sums.
PORTABLE_MATH_INLINE double pairwise(const double (&partial)[sum_lanes]) {
  return ((partial[0] + partial[4]) + (partial[2] + partial[6])) +
         ((partial[1] + partial[5]) + (partial[3] + partial[7]));
}

/// Sum over i in [0, n) of term(i). The terms are evaluated in groups of eight.
template <class Term>
PORTABLE_MATH_INLINE double sum_of(std::size_t n, Term term) {
  constexpr std::size_t lanes = sum_lanes;
  double partial[lanes] = {};
  std::size_t i = 0;
  for (; i + lanes <= n; i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      partial[lane] += term(i + lane);
    }
  }
  for (std::size_t lane = 0; i + lane < n; ++lane) {
    partial[lane] += term(i + lane);
  }
  return pairwise(partial);
}

}  // namespace portable_math
