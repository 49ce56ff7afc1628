#include "replication/predictive.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "errors/invalid_value.hpp"
#include "portable_math/elementary.hpp"
#include "replication/study.hpp"

namespace replication {

namespace {

constexpr double log_two_pi = 1.8378770664093453;

std::vector<double> log_areas(const std::vector<StudySummary>& studies, std::size_t parameter) {
  std::vector<double> logs;
  for (const auto& s : studies) {
    const double area = s.areas.at(parameter);
    if (!(area > 0.0)) {
      throw errors::InvalidValue("area", area, "a positive number");
    }
    logs.push_back(portable_math::log(area));
  }
  return logs;
}

Counts counts_of(const StudySummary& study) {
  return {study.iterations.begin(), study.iterations.end()};
}

/// P-value from a share of pairs, where the printed pair counts as one more; if no pair is below
/// it, the error is that of one in n/2 independent pairs.
PValue of_pairs(double share, double pairs, double standard_error, double independent_pairs) {
  return {(share * pairs + 1.0) / (pairs + 1.0), share > 0.0 ? standard_error : 1.0 / independent_pairs};
}

/// For each x, how many of the sorted y have x + y at most the bound.
std::vector<double> numbers_below(std::span<const double> x, const std::vector<double>& sorted_y,
                                  double bound) {
  std::vector<double> numbers;
  for (const double value : x) {
    numbers.push_back(static_cast<double>(std::upper_bound(sorted_y.begin(), sorted_y.end(), bound - value) -
                                          sorted_y.begin()));
  }
  return numbers;
}

std::vector<double> sorted(std::span<const double> x) {
  std::vector<double> y(x.begin(), x.end());
  std::sort(y.begin(), y.end());
  return y;
}

}  // namespace

Prediction::Prediction(const std::vector<StudySummary>& studies, const Counts& categories) {
  if (studies.size() < 3) {
    throw errors::InvalidValue("studies", studies.size(), "at least 3");
  }
  std::array<std::vector<double>, 2> logs;
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    logs[k] = log_areas(studies, k);
    const Moments m = moments(logs[k]);
    if (!(m.standard_deviation > 0.0)) {
      throw errors::InvalidValue("areas", studies.front().areas[k], "studies whose areas differ");
    }
    mean_[k] = m.mean;
    standard_deviation_[k] = m.standard_deviation;
  }
  for (std::size_t i = 0; i < studies.size(); ++i) {
    correlation_ +=
        (logs[0][i] - mean_[0]) / standard_deviation_[0] * (logs[1][i] - mean_[1]) / standard_deviation_[1];
  }
  correlation_ /= static_cast<double>(studies.size() - 1);
  std::vector<Counts> counts;
  std::transform(studies.begin(), studies.end(), std::back_inserter(counts), counts_of);
  probabilities_ = category_probabilities(counts, categories);
  for (std::size_t i = 0; i < studies.size(); ++i) {
    of_studies_.push_back(log_density(studies[i].areas, counts[i]));
  }
}

LogDensity Prediction::log_density(std::span<const double> areas, const Counts& counts) const {
  std::array<double, 2> z{};
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
    z[k] = (portable_math::log(areas[k]) - mean_[k]) / standard_deviation_[k];
  }
  const double rest = 1.0 - correlation_ * correlation_;
  const double distance = (z[0] * z[0] + z[1] * z[1] - 2.0 * correlation_ * z[0] * z[1]) / rest;
  const double log_determinant =
      2.0 * portable_math::log(standard_deviation_[0] * standard_deviation_[1]) + portable_math::log(rest);
  return {-0.5 * (distance + log_determinant) - log_two_pi, log_multinomial(counts, probabilities_)};
}

PValue predictive_p(std::span<const double> scores, double printed) {
  const auto below = std::count_if(scores.begin(), scores.end(), [=](double x) { return x <= printed; });
  const auto n = static_cast<double>(scores.size());
  const double p = (static_cast<double>(below) + 1.0) / (n + 1.0);
  return {p, std::sqrt(p * (1.0 - p) / (n + 1.0))};
}

PValue predictive_p_of_pair(std::span<const double> scores, double printed) {
  const auto n = static_cast<double>(scores.size());
  if (scores.size() < 2) {
    throw errors::InvalidValue("scores", scores.size(), "those of at least two studies");
  }
  auto shares = numbers_below(scores, sorted(scores), printed);
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const bool with_itself = 2.0 * scores[i] <= printed;
    shares[i] = (shares[i] - (with_itself ? 1.0 : 0.0)) / (n - 1.0);
  }
  const Moments m = moments(shares);
  return of_pairs(m.mean, 0.5 * n * (n - 1.0), 2.0 * m.standard_deviation / std::sqrt(n), 0.5 * n);
}

PValue predictive_p_of_pair(std::span<const double> first, std::span<const double> second, double printed) {
  if (first.size() < 2 || second.size() < 2) {
    throw errors::InvalidValue("scores", std::min(first.size(), second.size()),
                               "those of at least two studies of each setting");
  }
  const auto m = static_cast<double>(first.size());
  const auto n = static_cast<double>(second.size());
  auto of_first = numbers_below(first, sorted(second), printed);
  auto of_second = numbers_below(second, sorted(first), printed);
  std::transform(of_first.begin(), of_first.end(), of_first.begin(), [=](double k) { return k / n; });
  std::transform(of_second.begin(), of_second.end(), of_second.begin(), [=](double k) { return k / m; });
  const Moments a = moments(of_first);
  const Moments b = moments(of_second);
  const double variance =
      a.standard_deviation * a.standard_deviation / m + b.standard_deviation * b.standard_deviation / n;
  return of_pairs(a.mean, m * n, std::sqrt(variance), std::min(m, n));
}

std::vector<double> scores_of(const Prediction& prediction, double (*part)(const LogDensity&)) {
  std::vector<double> scores;
  std::transform(prediction.of_studies().begin(), prediction.of_studies().end(), std::back_inserter(scores),
                 part);
  return scores;
}

}  // namespace replication
