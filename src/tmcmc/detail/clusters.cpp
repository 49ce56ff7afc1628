#include "tmcmc/detail/clusters.hpp"

#include "portable_math/multiversion.hpp"
#include "portable_math/sums.hpp"

namespace tmcmc::detail {

namespace {

double sum_of(const Eigen::VectorXd& x) {
  return portable_math::sum_of(static_cast<std::size_t>(x.size()),
                               [&](std::size_t i) { return x[static_cast<Index>(i)]; });
}

PORTABLE_MATH_MULTIVERSION
void lower_distances(Index n, Index d, const double* points, const double* centre, double* work,
                     double* least) {
  for (Index i = 0; i < n; ++i) {
    work[i] = 0.0;
  }
  for (Index j = 0; j < d; ++j) {
    for (Index i = 0; i < n; ++i) {
      const double distance = points[i + j * n] - centre[j];
      work[i] += distance * distance;
    }
  }
  for (Index i = 0; i < n; ++i) {
    least[i] = work[i] < least[i] ? work[i] : least[i];
  }
}

/// Sets nearest = k where the distance has become smaller.
PORTABLE_MATH_MULTIVERSION
void take_nearer(Index n, Index k, const double* least, const double* before, Index* nearest) {
  for (Index i = 0; i < n; ++i) {
    nearest[i] = least[i] < before[i] ? k : nearest[i];
  }
}

/// Weighted k-means++: rows, each drawn with probability proportional to weight times squared
/// distance from the previous rows.
std::vector<Index> first_centres(const Population& white, const Eigen::VectorXd& weights, Index components,
                                 const StreamKey& key, std::uint32_t stage) {
  const Index n = white.rows();
  const Index d = white.cols();
  Eigen::VectorXd least = Eigen::VectorXd::Constant(n, 1e300);
  Eigen::VectorXd work(n);
  Eigen::VectorXd chance = weights;
  std::vector<Index> centres;
  for (Index k = 0; k < components; ++k) {
    const Words words = random_words(
        key,
        {.purpose = Purpose::reference, .stage = stage, .row = static_cast<std::uint64_t>(k), .draw = 1});
    const double level = uniform_open(words[0]) * sum_of(chance);
    Index chosen = 0;
    double cumulative = 0.0;
    for (Index i = 0; i < n; ++i) {
      cumulative += chance[i];
      chosen = chance[i] > 0.0 ? i : chosen;
      if (cumulative >= level) {
        break;
      }
    }
    centres.push_back(chosen);
    const Eigen::VectorXd centre = white.row(chosen).transpose();
    lower_distances(n, d, white.data(), centre.data(), work.data(), least.data());
    for (Index i = 0; i < n; ++i) {
      chance[i] = weights[i] * least[i];
    }
  }
  return centres;
}

}  // namespace

std::vector<Index> clusters(const Population& white, const Eigen::VectorXd& weights, Index components,
                            const StreamKey& key, std::uint32_t stage) {
  const Index n = white.rows();
  const Index d = white.cols();
  const std::vector<Index> first = first_centres(white, weights, components, key, stage);
  constexpr int iterations = 4;
  const auto count = static_cast<Index>(first.size());
  Eigen::MatrixXd centres(d, count);
  for (Index k = 0; k < count; ++k) {
    centres.col(k) = white.row(first[static_cast<std::size_t>(k)]).transpose();
  }
  std::vector<Index> nearest(static_cast<std::size_t>(n), 0);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    Eigen::VectorXd least = Eigen::VectorXd::Constant(n, 1e300);
    Eigen::VectorXd distance(n);
    for (Index k = 0; k < count; ++k) {
      const Eigen::VectorXd before = least;
      lower_distances(n, d, white.data(), centres.col(k).data(), distance.data(), least.data());
      take_nearer(n, k, least.data(), before.data(), nearest.data());
    }
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(d, count);
    Eigen::VectorXd taken = Eigen::VectorXd::Zero(count);
    for (Index i = 0; i < n; ++i) {
      taken[nearest[static_cast<std::size_t>(i)]] += weights[i];
    }
    for (Index j = 0; j < d; ++j) {
      for (Index i = 0; i < n; ++i) {
        sums(j, nearest[static_cast<std::size_t>(i)]) += weights[i] * white(i, j);
      }
    }
    for (Index k = 0; k < count; ++k) {
      if (taken[k] > 0.0) {
        centres.col(k) = sums.col(k) / taken[k];
      }
    }
  }
  return nearest;
}

}  // namespace tmcmc::detail
