#include "tmcmc/detail/mode_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "tmcmc/detail/neighbours.hpp"
#include "tmcmc/detail/proposal_covariance.hpp"

namespace tmcmc::detail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// Disjoint sets of indices.
class Sets {
 public:
  explicit Sets(Index n) : parents_(at(n)) { std::iota(parents_.begin(), parents_.end(), Index{0}); }
  Index find(Index i) {
    while (parents_[at(i)] != i) {
      i = parents_[at(i)] = parents_[at(parents_[at(i)])];
    }
    return i;
  }
  void join(Index i, Index j) { parents_[at(std::max(find(i), find(j)))] = std::min(find(i), find(j)); }

 private:
  std::vector<Index> parents_;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// One connected part of the graph.
struct Part {
  std::vector<Index> points;
  double reach = 0.0;  // median of its points
};

/// Smallest distance between a point of a and a point of b.
double gap_between(const Population& white, const Part& a, const Part& b) {
  double least = infinity;
  for (const Index i : a.points) {
    for (const Index k : b.points) {
      double squared = 0.0;
      for (Index j = 0; j < white.cols() && squared < least; ++j) {
        const double difference = white(i, j) - white(k, j);
        squared += difference * difference;
      }
      least = std::min(least, squared);
    }
  }
  return std::sqrt(least);
}

Eigen::VectorXd mean_of(const WeightedPoints& points, const Part& part) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(points.white.cols());
  double total = 0.0;
  for (const Index i : part.points) {
    total += points.weights[at(i)];
    for (Index j = 0; j < sum.size(); ++j) {
      sum[j] += points.weights[at(i)] * points.white(i, j);
    }
  }
  return sum / total;
}

/// Adds the weighted squares of the deviations, and returns the weight of the part.
double add_scatter(const WeightedPoints& points, const Part& part, const Eigen::VectorXd& mean,
                   Eigen::MatrixXd& scatter) {
  double total = 0.0;
  for (const Index i : part.points) {
    total += points.weights[at(i)];
    for (Index j = 0; j < mean.size(); ++j) {
      for (Index k = 0; k <= j; ++k) {
        scatter(j, k) +=
            points.weights[at(i)] * (points.white(i, j) - mean[j]) * (points.white(i, k) - mean[k]);
      }
    }
  }
  return total;
}

/// x with L L^T x = b; 0 in directions without variance.
Eigen::VectorXd solved(const Eigen::MatrixXd& factor, Eigen::VectorXd b) {
  const Index d = b.size();
  for (Index j = 0; j < d; ++j) {
    for (Index k = 0; k < j; ++k) {
      b[j] -= factor(j, k) * b[k];
    }
    b[j] = factor(j, j) > 0.0 ? b[j] / factor(j, j) : 0.0;
  }
  for (Index j = d; j-- > 0;) {
    for (Index k = j + 1; k < d; ++k) {
      b[j] -= factor(k, j) * b[k];
    }
    b[j] = factor(j, j) > 0.0 ? b[j] / factor(j, j) : 0.0;
  }
  return b;
}

/// Whether the density along Fisher's discriminant falls, between the medians of both parts, to
/// less than a fifth of the density around the lower of the two medians.
bool is_valley_between(const WeightedPoints& points, const Part& a, const Part& b) {
  const Index d = points.white.cols();
  const Eigen::VectorXd mean_a = mean_of(points, a);
  const Eigen::VectorXd mean_b = mean_of(points, b);
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(d, d);
  double total = add_scatter(points, a, mean_a, scatter);
  total += add_scatter(points, b, mean_b, scatter);
  const Eigen::VectorXd direction = solved(cholesky_factor(scatter / total), mean_b - mean_a);
  const auto along = [&](Index i) {
    double sum = 0.0;
    for (Index j = 0; j < d; ++j) {
      sum += direction[j] * points.white(i, j);
    }
    return sum;
  };
  std::array<std::vector<double>, 2> places;
  std::vector<std::pair<double, double>> all;
  for (const Index i : a.points) {
    places[0].push_back(along(i));
    all.emplace_back(places[0].back(), points.weights[at(i)]);
  }
  for (const Index i : b.points) {
    places[1].push_back(along(i));
    all.emplace_back(places[1].back(), points.weights[at(i)]);
  }
  const double from = median(places[0]);
  const double to = median(places[1]);
  constexpr int bins = 11;  // the first and the last around the medians
  std::array<double, bins> density{};
  for (const auto& [place, weight] : all) {
    const double bin = std::floor((place - from) / (to - from) * (bins - 1) + 0.5);
    if (bin >= 0.0 && bin < bins) {
      density[static_cast<std::size_t>(bin)] += weight;
    }
  }
  return *std::min_element(density.begin() + 1, density.end() - 1) <
         0.2 * std::min(density.front(), density.back());
}

std::vector<Part> heavy_parts(const WeightedPoints& points, const Neighbours& neighbours,
                              const ModeOptions& options) {
  const Index n = points.white.rows();
  Sets sets(n);
  for (Index i = 0; i < n; ++i) {
    for (const Index k : neighbours.of[at(i)]) {
      const auto& others = neighbours.of[at(k)];
      if (k > i && std::binary_search(others.begin(), others.end(), i)) {
        sets.join(i, k);
      }
    }
  }
  std::map<Index, Part> all;
  for (Index i = 0; i < n; ++i) {
    all[sets.find(i)].points.push_back(i);
  }
  std::vector<Part> heavy;
  for (auto& [root, part] : all) {
    double weight = 0.0;
    std::vector<double> reaches;
    for (const Index i : part.points) {
      weight += points.weights[at(i)];
      reaches.push_back(neighbours.reach[at(i)]);
    }
    if (static_cast<Index>(part.points.size()) > options.neighbours && weight >= options.least_weight) {
      part.reach = median(reaches);
      heavy.push_back(std::move(part));
    }
  }
  return heavy;
}

}  // namespace

std::vector<Index> separate_parts(WeightedPoints points, const ModeOptions& options) {
  constexpr int refinements = 4;
  const Index n = points.white.rows();
  std::vector<Index> labels(at(n), 0);
  if (n < 2 * (options.neighbours + 1)) {
    return labels;
  }
  auto neighbours = neighbours_of(points.white, options.neighbours);
  for (int refinement = 0; refinement < refinements; ++refinement) {
    points.white = with_isotropic_neighbours(points.white, neighbours);
    neighbours = neighbours_of(points.white, options.neighbours);
  }
  const auto parts = heavy_parts(points, neighbours, options);
  if (parts.size() < 2) {
    return labels;
  }
  Sets joined(static_cast<Index>(parts.size()));
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (std::size_t b = a + 1; b < parts.size(); ++b) {
      const double gap =
          gap_between(points.white, parts[a], parts[b]) / std::max(parts[a].reach, parts[b].reach);
      const bool separate = gap >= options.widest_gap ||
                            (gap >= options.least_gap && is_valley_between(points, parts[a], parts[b]));
      if (!separate) {
        joined.join(static_cast<Index>(a), static_cast<Index>(b));
      }
    }
  }
  std::vector<Index> part_of(at(n), -1);
  for (std::size_t a = 0; a < parts.size(); ++a) {
    for (const Index i : parts[a].points) {
      part_of[at(i)] = joined.find(static_cast<Index>(a));
    }
  }
  std::vector<double> squared(at(n));
  for (Index i = 0; i < n; ++i) {  // stragglers belong to the part of the nearest point
    labels[at(i)] = part_of[at(i)];
    if (labels[at(i)] < 0) {
      distances_from(points.white, i, squared);
      double least = infinity;
      for (Index k = 0; k < n; ++k) {
        if (part_of[at(k)] >= 0 && squared[at(k)] < least) {
          least = squared[at(k)];
          labels[at(i)] = part_of[at(k)];
        }
      }
    }
  }
  return labels;
}

}  // namespace tmcmc::detail
