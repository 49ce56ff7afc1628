#include "tmcmc/modes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <sstream>

#include "errors/invalid_value.hpp"
#include "tmcmc/detail/mode_graph.hpp"
#include "tmcmc/detail/neighbours.hpp"
#include "tmcmc/detail/proposal_covariance.hpp"
#include "tmcmc/diagnostics.hpp"

namespace tmcmc {

namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

void require(bool condition, const char* field, double value, const char* expected) {
  if (!condition) {
    throw errors::InvalidValue(field, value, expected);
  }
}

/// The weights, normalised to the sum 1.
std::vector<double> normalised(const Population& points, std::span<const double> weights) {
  const Index n = points.rows();
  require(n >= 1 && points.cols() >= 1, "points", static_cast<double>(n), "at least one point");
  for (Index j = 0; j < points.cols(); ++j) {
    for (Index i = 0; i < n; ++i) {
      require(std::isfinite(points(i, j)), "points", points(i, j), "finite coordinates");
    }
  }
  require(weights.empty() || weights.size() == at(n), "weights", static_cast<double>(weights.size()),
          "one weight for each point");
  std::vector<double> result(at(n), 1.0);
  std::copy(weights.begin(), weights.end(), result.begin());
  double total = 0.0;
  for (const double weight : result) {
    require(weight >= 0.0 && std::isfinite(weight), "weights", weight, "finite numbers of at least 0");
    total += weight;
  }
  require(total > 0.0, "weights", total, "a positive sum");
  for (double& weight : result) {
    weight /= total;
  }
  return result;
}

/// Coordinates in which the covariance of the points is the identity; 0 where there is no variance.
Population standardised(Population points, const std::vector<double>& weights) {
  const Eigen::VectorXd mean = detail::weighted_mean(points, weights, 1.0);
  for (Index j = 0; j < points.cols(); ++j) {
    for (Index i = 0; i < points.rows(); ++i) {
      points(i, j) -= mean[j];
    }
  }
  return detail::whitened(points, detail::cholesky_factor(detail::proposal_covariance(
                                      points, weights, 1.0, 1.0, Centre::weighted_mean)));
}

bool is_before(const Population& points, Index a, Index b) {
  for (Index j = 0; j < points.cols(); ++j) {
    if (points(a, j) != points(b, j)) {
      return points(a, j) < points(b, j);
    }
  }
  return false;
}

/// Rows that represent all rows: at equal steps of the weight; equal rows occur once, with the
/// weight of all of them.
std::vector<std::pair<Index, double>> chosen_rows(const Population& white, const std::vector<double>& weights,
                                                  Index most) {
  std::vector<std::pair<Index, double>> rows;
  if (white.rows() <= most &&
      std::all_of(weights.begin(), weights.end(), [&](double w) { return w == weights[0]; })) {
    for (Index i = 0; i < white.rows(); ++i) {
      rows.emplace_back(i, weights[at(i)]);
    }
  } else {
    double sum_of_squares = 0.0;
    for (const double weight : weights) {
      sum_of_squares += weight * weight;
    }
    const Index count = std::clamp(static_cast<Index>(1.0 / sum_of_squares), Index{1}, most);
    const double step = 1.0 / static_cast<double>(count);
    double level = 0.5 * step;
    double below = 0.0;
    for (Index i = 0; i < white.rows(); ++i) {
      below += weights[at(i)];
      double weight = 0.0;
      for (; level < below; level += step) {
        weight += step;
      }
      if (weight > 0.0) {
        rows.emplace_back(i, weight);
      }
    }
  }
  std::sort(rows.begin(), rows.end(), [&](const auto& a, const auto& b) {
    return is_before(white, a.first, b.first) || (!is_before(white, b.first, a.first) && a.first < b.first);
  });
  std::vector<std::pair<Index, double>> different;
  for (const auto& [row, weight] : rows) {
    if (!different.empty() && !is_before(white, different.back().first, row)) {
      different.back().second += weight;
    } else {
      different.emplace_back(row, weight);
    }
  }
  return different;
}

/// Effective number of independent samples for the share of a mode.
double effective_size(const std::vector<Index>& labels, Index mode, const std::vector<double>& weights,
                      double share, const Genealogy* genealogy) {
  if (genealogy == nullptr || genealogy->chains < 1) {
    double error = 0.0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const double deviation = weights[i] * ((labels[i] == mode ? 1.0 : 0.0) - share);
      error += deviation * deviation;
    }
    return share * (1.0 - share) / error;
  }
  Population inside(static_cast<Index>(labels.size()), 1);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    inside(static_cast<Index>(i), 0) = labels[i] == mode ? 1.0 : 0.0;
  }
  return effective_sample_sizes(inside, *genealogy)[0];
}

Mode mode_of(const Population& points, const std::vector<double>& weights, const std::vector<Index>& labels,
             Index label) {
  const Index d = points.cols();
  Mode mode{0.0, 0.0, 0, Eigen::VectorXd::Zero(d), Eigen::VectorXd::Zero(d)};
  for (std::size_t i = 0; i < labels.size(); ++i) {
    mode.weight += labels[i] == label ? weights[i] : 0.0;
    mode.samples += labels[i] == label ? 1 : 0;
  }
  for (Index j = 0; j < d; ++j) {
    double sum = 0.0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      sum += labels[i] == label ? weights[i] * points(static_cast<Index>(i), j) : 0.0;
    }
    mode.mean[j] = sum / mode.weight;
    double squares = 0.0;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const double deviation = points(static_cast<Index>(i), j) - mode.mean[j];
      squares += labels[i] == label ? weights[i] * deviation * deviation : 0.0;
    }
    mode.standard_deviation[j] = std::sqrt(squares / mode.weight);
  }
  return mode;
}

/// Label of each row, which is the label of the nearest row of the graph.
std::vector<Index> labels_of_all(const Population& white, const std::vector<std::pair<Index, double>>& rows,
                                 const std::vector<Index>& parts) {
  std::vector<Index> labels(at(white.rows()), 0);
  if (std::all_of(parts.begin(), parts.end(), [&](Index part) { return part == parts[0]; })) {
    return labels;
  }
  for (Index i = 0; i < white.rows(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < rows.size(); ++k) {
      double squared = 0.0;
      for (Index j = 0; j < white.cols() && squared < least; ++j) {
        const double difference = white(i, j) - white(rows[k].first, j);
        squared += difference * difference;
      }
      if (squared < least) {
        least = squared;
        labels[at(i)] = parts[k];
      }
    }
  }
  return labels;
}

void warn_of_weights(Modes& modes, const std::vector<double>& effective_sizes) {
  constexpr double fewest = 50.0;
  constexpr double largest_relative_error = 0.25;
  for (std::size_t k = 0; k < modes.modes.size(); ++k) {
    const Mode& mode = modes.modes[k];
    std::ostringstream text;
    text.precision(2);
    text << "the weight of mode " << k + 1 << " is " << mode.weight << " +- " << mode.standard_error;
    if (effective_sizes[k] < fewest) {
      text << ", from " << effective_sizes[k] << " effective samples: below " << fewest;
    } else if (mode.standard_error > largest_relative_error * mode.weight) {
      text << ": its error is above a quarter of it";
    } else {
      continue;
    }
    text << "; take more evaluations, and compare runs of several seeds";
    modes.warnings.push_back(text.str());
  }
}

}  // namespace

void ModeOptions::validate() const {
  require(neighbours >= 2, "neighbours", static_cast<double>(neighbours), "at least 2");
  require(points > 4 * neighbours, "points", static_cast<double>(points),
          "more than four times the neighbours");
  require(least_weight >= 0.0 && least_weight < 0.5, "least_weight", least_weight, "a number in [0, 0.5)");
  require(least_gap >= 0.0 && std::isfinite(least_gap), "least_gap", least_gap,
          "a finite number of at least 0");
  require(widest_gap >= least_gap, "widest_gap", widest_gap, "a number of at least least_gap");
}

Modes find_modes(const Population& points, std::span<const double> weights, const Genealogy* genealogy,
                 const ModeOptions& options) {
  options.validate();
  const std::vector<double> shares = normalised(points, weights);
  const Population white = standardised(points, shares);
  const auto rows = chosen_rows(white, shares, options.points);
  detail::WeightedPoints graph{Population(static_cast<Index>(rows.size()), points.cols()), {}};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    graph.white.row(static_cast<Index>(k)) = white.row(rows[k].first);
    graph.weights.push_back(rows[k].second);
  }
  Modes result;
  const std::vector<Index> labels = labels_of_all(white, rows, detail::separate_parts(graph, options));
  std::vector<std::pair<Mode, Index>> found;
  for (Index label : std::vector<Index>(labels)) {
    if (std::none_of(found.begin(), found.end(), [&](const auto& mode) { return mode.second == label; })) {
      found.emplace_back(mode_of(points, shares, labels, label), label);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first.weight > b.first.weight; });
  std::vector<double> effective_sizes;
  std::map<Index, Index> place;
  for (auto& [mode, label] : found) {
    place[label] = static_cast<Index>(result.modes.size());
    if (found.size() > 1) {
      effective_sizes.push_back(effective_size(labels, label, shares, mode.weight, genealogy));
      const double variance = mode.weight * (1.0 - mode.weight);
      mode.standard_error = effective_sizes.back() > 0.0 ? std::sqrt(variance / effective_sizes.back()) : 1.0;
    }
    result.modes.push_back(std::move(mode));
  }
  std::transform(labels.begin(), labels.end(), std::back_inserter(result.of_sample),
                 [&](Index label) { return place[label]; });
  if (found.size() > 1) {
    warn_of_weights(result, effective_sizes);
  }
  return result;
}

Modes find_modes(const Result& result, const ModeOptions& options) {
  const ConstDoubles weights = as_span(result.weights);
  const bool is_weighted =
      std::any_of(weights.begin(), weights.end(), [&](double weight) { return weight != weights[0]; });
  return is_weighted ? find_modes(result.final.points, weights, nullptr, options)
                     : find_modes(result.final.points, {}, &result.final.genealogy, options);
}

}  // namespace tmcmc
