#include <algorithm>
#include <cmath>

#include "portable_math/multiversion.hpp"
#include "tmcmc/detail/random_rows.hpp"
#include "tmcmc/parallel.hpp"
#include "tmcmc/student_mixture.hpp"

namespace tmcmc {

namespace {

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

/// Normals and stretch factors sqrt(nu / chi^2) of the draws first ... first + lanes - 1.
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
  void fill(const StreamKey& key, const DrawId& id, std::uint64_t first) {
    std::uint64_t rows[lanes];
    for (std::size_t i = 0; i < lanes; ++i) {
      rows[i] = first + i;
    }
    detail::random_words_of_rows(key, id, rows, {&words_[0][0], 4 * lanes});
  }

  Index d_;
  int nu_;
  std::vector<double> normals_;
  double stretch_[lanes] = {};
  WordLanes words_[4] = {};
};

constexpr std::uint32_t counts_block = 1U << 24U;  // of the random words: beyond those of the draws

}  // namespace

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
  const double wider = mixture.wider();
  std::vector<double> shares;  // of each component, and of its wider part
  for (const double weight : mixture.weights) {
    shares.push_back((1.0 - mixture.wide_share) * weight);
    shares.push_back(mixture.wide_share * weight);
  }
  const auto counts = systematic_counts(shares, n, uniform_open(words[0]));
  Population points(n, d);
  std::vector<Index> ends(counts.size());
  Index end_of_component = 0;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    ends[k] = end_of_component += counts[k];
  }
  static_assert(reduction_rows % lanes == 0, "a block starts with new lanes");
  for_each_block(n, reduction_rows, threads, [&](Index, Index begin, Index end) {
    Draws draws(d, mixture.degrees_of_freedom);
    std::size_t part = 0;
    for (Index first = begin; first < end; first += static_cast<Index>(lanes)) {
      draws.draw(key, stage, static_cast<std::uint64_t>(first));
      const Index last = std::min(end, first + static_cast<Index>(lanes));
      for (Index i = first; i < last;) {  // runs of one component
        while (ends[part] <= i) {
          ++part;
        }
        const Index stop = std::min(last, ends[part]);
        const Index offset = i - first;
        const std::size_t k = part / 2;
        const double scale = part % 2 == 0 ? 1.0 : wider;
        const Eigen::MatrixXd& factor = mixture.factors[k];
        for (Index j = 0; j < d; ++j) {
          double* x = points.col(j).data() + i;
          std::fill(x, x + (stop - i), mixture.means(j, static_cast<Index>(k)));
          for (Index l = 0; l <= j; ++l) {
            add_stretched(scale * factor(j, l), draws.normal(l) + offset, draws.stretch() + offset, x,
                          static_cast<std::size_t>(stop - i));
          }
        }
        i = stop;
      }
    }
  });
  return points;
}

}  // namespace tmcmc
