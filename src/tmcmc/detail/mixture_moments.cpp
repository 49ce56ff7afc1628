#include "tmcmc/detail/mixture_moments.hpp"

#include <array>

#include "portable_math/multiversion.hpp"
#include "portable_math/sums.hpp"
#include "tmcmc/detail/few_coordinates.hpp"

namespace tmcmc::detail {

namespace {

constexpr auto lanes = static_cast<Index>(portable_math::sum_lanes);
constexpr Index most_sums = 2 + most_of_few + most_of_few * (most_of_few + 1) / 2;

/// What one component is moved by.
struct Pulled {
  const double* terms;
  const double* distances;
  const double* mean;
  double degrees_of_freedom;
};

/// All sums at once, for so few coordinates that they stay in registers: taken, pull, and for each
/// j the first moment and the second moments with each l <= j. The sums are in eight interleaved
/// partial sums, as in portable_math::sum_of.
template <int d>
PORTABLE_MATH_INLINE void sums_of_few(const MomentPoints& block, const Pulled& component, double* sums) {
  constexpr int count = 2 + d + d * (d + 1) / 2;
  const double* __restrict points = block.points;
  const double* __restrict unit = block.unit;
  const double* __restrict terms = component.terms;
  const double* __restrict distances = component.distances;
  const double* __restrict mean = component.mean;
  const Index stride = block.stride;
  const double nu = component.degrees_of_freedom;
  double partial[count][lanes] = {};
  const auto add = [&](Index begin, Index n) __attribute__((always_inline)) {
    for (Index lane = 0; lane < n; ++lane) {
      const Index i = begin + lane;
      const double taken = unit[i] * terms[i];
      const double pull = taken * ((nu + d) / (nu + distances[i]));
      partial[0][lane] += taken;
      partial[1][lane] += pull;
      double deviation[d];
      int k = 2;
#pragma GCC unroll 8
      for (int j = 0; j < d; ++j) {
        deviation[j] = points[i + j * stride] - mean[j];
        const double pulled = pull * deviation[j];
        partial[k++][lane] += pulled;
#pragma GCC unroll 8
        for (int l = 0; l <= j; ++l) {
          partial[k++][lane] += pulled * deviation[l];
        }
      }
    }
  };
  Index begin = 0;
  for (; begin + lanes <= block.rows; begin += lanes) {
    add(begin, lanes);
  }
  add(begin, block.rows - begin);
  for (int k = 0; k < count; ++k) {
    sums[k] = portable_math::pairwise(partial[k]);
  }
}

/// As above for any number of coordinates, one sum after another.
PORTABLE_MATH_INLINE void sums_of_many(const MomentPoints& block, const Pulled& component, Index d,
                                       double* sums) {
  const auto n = static_cast<std::size_t>(block.rows);
  const double* unit = block.unit;
  const double* terms = component.terms;
  const double nu = component.degrees_of_freedom;
  double pull[mixture_rows];
  double pulled[mixture_rows];
  for (std::size_t i = 0; i < n; ++i) {
    pull[i] = unit[i] * terms[i] * ((nu + static_cast<double>(d)) / (nu + component.distances[i]));
  }
  *sums++ = portable_math::sum_of(n, [&](std::size_t i) { return unit[i] * terms[i]; });
  *sums++ = portable_math::sum_of(n, [&](std::size_t i) { return pull[i]; });
  for (Index j = 0; j < d; ++j) {
    const double* z = block.points + j * block.stride;
    const double centre = component.mean[j];
    for (std::size_t i = 0; i < n; ++i) {
      pulled[i] = pull[i] * (z[i] - centre);
    }
    *sums++ = portable_math::sum_of(n, [&](std::size_t i) { return pulled[i]; });
    for (Index l = 0; l <= j; ++l) {
      const double* other = block.points + l * block.stride;
      const double other_centre = component.mean[l];
      *sums++ =
          portable_math::sum_of(n, [&](std::size_t i) { return pulled[i] * (other[i] - other_centre); });
    }
  }
}

PORTABLE_MATH_MULTIVERSION
void sums_of(const MomentPoints& block, const Pulled& component, Index d, double* sums) {
  if (!for_few_coordinates(
          d, [&](auto few) __attribute__((always_inline)) { sums_of_few<few>(block, component, sums); })) {
    sums_of_many(block, component, d, sums);
  }
}

}  // namespace

void add_moments(const MomentPoints& block, const MixtureTerms& terms, const StudentMixture& mixture, Index k,
                 Moments& moments) {
  const Index d = mixture.dimension();
  const Pulled component{terms.terms() + k * mixture_rows, terms.distances() + k * mixture_rows,
                         mixture.means.col(k).data(), static_cast<double>(mixture.degrees_of_freedom)};
  std::array<double, most_sums> few{};
  std::vector<double> many;
  double* sums = few.data();
  if (d > most_of_few) {
    many.resize(static_cast<std::size_t>(2 + d + d * (d + 1) / 2));
    sums = many.data();
  }
  sums_of(block, component, d, sums);
  moments.taken += *sums++;
  moments.pull += *sums++;
  for (Index j = 0; j < d; ++j) {
    moments.first[j] += *sums++;
    for (Index l = 0; l <= j; ++l) {
      moments.second(j, l) += *sums++;
    }
  }
}

}  // namespace tmcmc::detail
