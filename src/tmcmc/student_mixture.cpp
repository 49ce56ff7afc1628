#include "tmcmc/student_mixture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "portable_math/multiversion.hpp"
#include "tmcmc/parallel.hpp"

namespace tmcmc {

namespace {

constexpr Index block_rows = detail::mixture_rows;
constexpr double minus_infinity = -std::numeric_limits<double>::infinity();

/// log Gamma(twice / 2), by the recurrence from Gamma(1) = 1 or Gamma(1/2) = sqrt(pi).
double log_gamma_of_half(Index twice) {
  double value = twice % 2 == 0 ? 0.0 : 0.5 * portable_math::log(std::numbers::pi);
  for (Index k = twice % 2 == 0 ? 2 : 1; k < twice; k += 2) {
    value += portable_math::log(0.5 * static_cast<double>(k));
  }
  return value;
}

/// white = L^-1 (z - m) by forward substitution, distances = |white|^2.
PORTABLE_MATH_MULTIVERSION
void whiten(const double* points, Index stride, Index rows, Index d, const double* mean, const double* factor,
            double* white, double* distances) {
  for (Index i = 0; i < rows; ++i) {
    distances[i] = 0.0;
  }
  for (Index j = 0; j < d; ++j) {
    double* y = white + j * block_rows;
    const double* z = points + j * stride;
    const double centre = mean[j];
    for (Index i = 0; i < rows; ++i) {
      y[i] = z[i] - centre;
    }
    for (Index l = 0; l < j; ++l) {
      const double entry = factor[j + l * d];
      const double* before = white + l * block_rows;
      for (Index i = 0; i < rows; ++i) {
        y[i] -= entry * before[i];
      }
    }
    const double inverse = 1.0 / factor[j + j * d];
    for (Index i = 0; i < rows; ++i) {
      y[i] *= inverse;
      distances[i] += y[i] * y[i];
    }
  }
}

PORTABLE_MATH_MULTIVERSION
void log_student(Index rows, double log_constant, double exponent, double inverse_nu, const double* distances,
                 double* result) {
  for (Index i = 0; i < rows; ++i) {
    result[i] = log_constant - exponent * portable_math::log_positive(1.0 + distances[i] * inverse_nu);
  }
}

PORTABLE_MATH_MULTIVERSION
void log_sum_of(Index components, Index rows, const double* terms, double* result, double* shares) {
  for (Index i = 0; i < rows; ++i) {
    result[i] = terms[i];
  }
  for (Index k = 1; k < components; ++k) {
    const double* term = terms + k * block_rows;
    for (Index i = 0; i < rows; ++i) {
      result[i] = term[i] > result[i] ? term[i] : result[i];
    }
  }
  double sums[block_rows];
  for (Index i = 0; i < rows; ++i) {
    sums[i] = 0.0;
    result[i] = result[i] == minus_infinity ? 0.0 : result[i];
  }
  for (Index k = 0; k < components; ++k) {
    const double* term = terms + k * block_rows;
    double* share = shares + k * block_rows;
    for (Index i = 0; i < rows; ++i) {
      share[i] = portable_math::exp(term[i] - result[i]);
      sums[i] += share[i];
    }
  }
  for (Index i = 0; i < rows; ++i) {
    result[i] += portable_math::log(sums[i]);
    sums[i] = sums[i] > 0.0 ? 1.0 / sums[i] : 0.0;
  }
  for (Index k = 0; k < components; ++k) {
    double* share = shares + k * block_rows;
    for (Index i = 0; i < rows; ++i) {
      share[i] *= sums[i];
    }
  }
}

constexpr std::size_t lanes = 64;
using WordLanes = std::uint64_t[lanes];

PORTABLE_MATH_MULTIVERSION
void normals(const WordLanes& radius_a, const WordLanes& radius_b, const WordLanes& angles, double* z) {
  for (std::size_t i = 0; i < lanes; ++i) {
    const NormalPair a = normal_pair(radius_a[i], angles[i] >> 32U);
    const NormalPair b = normal_pair(radius_b[i], angles[i]);
    z[i] = a.first;
    z[lanes + i] = a.second;
    z[2 * lanes + i] = b.first;
    z[3 * lanes + i] = b.second;
  }
}

PORTABLE_MATH_MULTIVERSION
void add_logarithms(const WordLanes& words, double* sum) {
  for (std::size_t i = 0; i < lanes; ++i) {
    sum[i] += portable_math::log_positive(uniform_open(words[i]));
  }
}

PORTABLE_MATH_MULTIVERSION
void stretches(double nu, const double* sum_of_logarithms, double* result) {
  for (std::size_t i = 0; i < lanes; ++i) {
    result[i] = std::sqrt(nu / (-2.0 * sum_of_logarithms[i]));
  }
}

PORTABLE_MATH_MULTIVERSION
void add_stretched(double entry, const double* normal, const double* stretch, double* x, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    x[i] += entry * (normal[i] * stretch[i]);
  }
}

/// Normals and stretches sqrt(nu / chi^2) of the draws first ... first + lanes - 1.
class Draws {
 public:
  Draws(Index d, int degrees_of_freedom)
      : d_(d), nu_(degrees_of_freedom), normals_(static_cast<std::size_t>((d + 3) / 4 * 4) * lanes) {}

  void draw(const StreamKey& key, std::uint32_t stage, std::uint64_t first) {
    DrawId id{.purpose = Purpose::reference, .stage = stage};
    for (Index group = 0; 4 * group < d_; ++group) {
      fill(key, id, first);
      normals(words_[0], words_[1], words_[2], &normals_[static_cast<std::size_t>(4 * group) * lanes]);
      ++id.block;
    }
    double logarithms[lanes] = {};
    for (int k = 0; k < nu_ / 2; ++k) {
      if (k % 4 == 0) {
        fill(key, id, first);
        ++id.block;
      }
      add_logarithms(words_[k % 4], logarithms);
    }
    stretches(nu_, logarithms, stretch_);
  }
  [[nodiscard]] const double* normal(Index j) const { return &normals_[static_cast<std::size_t>(j) * lanes]; }
  [[nodiscard]] const double* stretch() const { return stretch_; }

 private:
  void fill(const StreamKey& key, DrawId id, std::uint64_t first) {
    for (std::size_t i = 0; i < lanes; ++i) {
      id.row = first + i;
      const Words w = random_words(key, id);
      for (std::size_t word = 0; word < 4; ++word) {
        words_[word][i] = w[word];
      }
    }
  }

  Index d_;
  int nu_;
  std::vector<double> normals_;
  double stretch_[lanes] = {};
  WordLanes words_[4] = {};
};

constexpr std::uint32_t counts_block = 1U << 24U;  // of the random words: beyond those of the draws

}  // namespace

namespace detail {

std::vector<Component> components_of(const StudentMixture& mixture) {
  const Index d = mixture.dimension();
  const Index nu = mixture.degrees_of_freedom;
  const double common =
      log_gamma_of_half(nu + d) - log_gamma_of_half(nu) -
      0.5 * static_cast<double>(d) * portable_math::log(static_cast<double>(nu) * std::numbers::pi);
  std::vector<Component> components;
  for (Index k = 0; k < mixture.size(); ++k) {
    const Eigen::MatrixXd& factor = mixture.factors[static_cast<std::size_t>(k)];
    double constant = common + portable_math::log(mixture.weights[k]);
    for (Index j = 0; j < d; ++j) {
      constant -= portable_math::log(factor(j, j));
    }
    components.push_back({mixture.means.col(k).data(), factor.data(), constant});
  }
  return components;
}

void component_densities(const std::vector<Component>& components, Index d, int degrees_of_freedom,
                         const double* points, Index stride, Index rows, double* white, double* distances,
                         double* log_densities) {
  const double nu = degrees_of_freedom;
  for (std::size_t k = 0; k < components.size(); ++k) {
    double* distance = distances + static_cast<Index>(k) * block_rows;
    whiten(points, stride, rows, d, components[k].mean, components[k].factor, white, distance);
    log_student(rows, components[k].log_constant, 0.5 * (nu + static_cast<double>(d)), 1.0 / nu, distance,
                log_densities + static_cast<Index>(k) * block_rows);
  }
}

void log_sum(Index components, Index rows, const double* log_densities, double* result, double* shares) {
  log_sum_of(components, rows, log_densities, result, shares);
}

}  // namespace detail

Eigen::VectorXd log_density(const StudentMixture& mixture, const Population& points, int threads) {
  const Index d = mixture.dimension();
  const auto components = detail::components_of(mixture);
  Eigen::VectorXd result(points.rows());
  for_each_block(points.rows(), reduction_rows, threads, [&](Index, Index begin, Index end) {
    const auto entries = static_cast<std::size_t>(mixture.size() * block_rows);
    std::vector<double> white(static_cast<std::size_t>(d * block_rows));
    std::vector<double> distances(entries);
    std::vector<double> densities(entries);
    for (Index i = begin; i < end; i += block_rows) {
      const Index rows = std::min(block_rows, end - i);
      detail::component_densities(components, d, mixture.degrees_of_freedom, points.data() + i, points.rows(),
                                  rows, white.data(), distances.data(), densities.data());
      detail::log_sum(mixture.size(), rows, densities.data(), result.data() + i, distances.data());
    }
  });
  return result;
}

std::vector<Index> systematic_counts(ConstDoubles shares, Index n, double uniform) {
  double total = 0.0;
  for (const double share : shares) {
    total += share;
  }
  std::vector<Index> counts(shares.size());
  double cumulative = 0.0;
  Index before = 0;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    cumulative += shares[k] / total;
    const auto reached = static_cast<Index>(std::floor(cumulative * static_cast<double>(n) + uniform));
    const Index up_to = k + 1 == shares.size() ? n : std::clamp(reached, before, n);
    counts[k] = up_to - before;
    before = up_to;
  }
  return counts;
}

Population sample(const StudentMixture& mixture, Index n, const StreamKey& key, std::uint32_t stage,
                  int threads) {
  const Index d = mixture.dimension();
  const Words words =
      random_words(key, {.purpose = Purpose::reference, .stage = stage, .block = counts_block});
  const auto counts = systematic_counts(as_span(mixture.weights), n, uniform_open(words[0]));
  Population points(n, d);
  std::vector<Index> ends(counts.size());
  Index end_of_component = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    ends[k] = end_of_component += counts[k];
  }
  static_assert(reduction_rows % lanes == 0, "a block starts with new lanes");
  for_each_block(n, reduction_rows, threads, [&](Index, Index begin, Index end) {
    Draws draws(d, mixture.degrees_of_freedom);
    std::size_t k = 0;
    for (Index first = begin; first < end; first += static_cast<Index>(lanes)) {
      draws.draw(key, stage, static_cast<std::uint64_t>(first));
      const Index last = std::min(end, first + static_cast<Index>(lanes));
      for (Index i = first; i < last;) {  // runs of one component
        while (ends[k] <= i) {
          ++k;
        }
        const Index stop = std::min(last, ends[k]);
        const Index offset = i - first;
        const Eigen::MatrixXd& factor = mixture.factors[k];
        for (Index j = 0; j < d; ++j) {
          double* x = points.col(j).data() + i;
          std::fill(x, x + (stop - i), mixture.means(j, static_cast<Index>(k)));
          for (Index l = 0; l <= j; ++l) {
            add_stretched(factor(j, l), draws.normal(l) + offset, draws.stretch() + offset, x,
                          static_cast<std::size_t>(stop - i));
          }
        }
        i = stop;
      }
    }
  });
  return points;
}

StudentMixture blend(const StudentMixture& a, double share, const StudentMixture& b) {
  StudentMixture result = a;
  result.weights.resize(a.size() + b.size());
  result.weights << share * a.weights, (1.0 - share) * b.weights;
  result.means.resize(a.dimension(), a.size() + b.size());
  result.means << a.means, b.means;
  result.factors.insert(result.factors.end(), b.factors.begin(), b.factors.end());
  return result;
}

}  // namespace tmcmc
