#include "replication/run_worth.hpp"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "errors/invalid_value.hpp"
#include "portable_math/elementary.hpp"
#include "replication/published.hpp"
#include "replication/study.hpp"

namespace replication {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::vector<double> ranks(std::span<const double> x) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  std::vector<double> rank(x.size());
  for (std::size_t begin = 0; begin < order.size();) {
    std::size_t end = begin + 1;
    while (end < order.size() && x[order[end]] == x[order[begin]]) {
      ++end;
    }
    for (std::size_t i = begin; i < end; ++i) {
      rank[order[i]] = 0.5 * static_cast<double>(begin + end + 1);
    }
    begin = end;
  }
  return rank;
}

/// Mean of independent values, with its standard error.
Estimate mean_of(const std::vector<double>& values) {
  if (values.size() < 2) {
    throw errors::InvalidValue("studies", values.size(), "at least 2");
  }
  const Moments m = moments(values);
  return {m.mean, m.standard_deviation / std::sqrt(static_cast<double>(values.size()))};
}

Estimate mean_number_of_iterations(const std::vector<StudySummary>& studies) {
  std::vector<double> means;
  for (const auto& s : studies) {
    means.push_back(mean_iterations({s.iterations.begin(), s.iterations.end()}));
  }
  return mean_of(means);
}

}  // namespace

Estimate independent_draws_worth(const std::vector<StudySummary>& studies, long runs, std::size_t parameter,
                                 double exact_mean, double exact_sd) {
  if (runs < 2) {
    throw errors::InvalidValue("runs", runs, "at least 2");
  }
  std::vector<double> squares;  // mean-square error of the runs of each study
  for (const auto& s : studies) {
    const double bias = s.means.at(parameter) - exact_mean;
    const double spread = s.standard_errors.at(parameter);
    squares.push_back(bias * bias +
                      spread * spread * static_cast<double>(runs - 1) / static_cast<double>(runs));
  }
  const Estimate square = mean_of(squares);
  const double worth = exact_sd * exact_sd / square.value;
  return {worth, worth * square.standard_error / square.value};
}

Estimate difference_of_iterations(const std::vector<StudySummary>& first,
                                  const std::vector<StudySummary>& second) {
  const Estimate a = mean_number_of_iterations(first);
  const Estimate b = mean_number_of_iterations(second);
  return {b.value - a.value, std::hypot(a.standard_error, b.standard_error)};
}

RankCorrelation rank_correlation(std::span<const double> x, std::span<const double> y) {
  if (x.size() != y.size() || x.size() < 3) {
    throw errors::InvalidValue("y", y.size(), "as many numbers as x has, at least 3");
  }
  const auto a = ranks(x);
  const auto b = ranks(y);
  const Moments of_a = moments(a);
  const Moments of_b = moments(b);
  if (!(of_a.standard_deviation > 0.0) || !(of_b.standard_deviation > 0.0)) {
    return {not_a_number, not_a_number};
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - of_a.mean) * (b[i] - of_b.mean);
  }
  const auto n = static_cast<double>(x.size());
  RankCorrelation result;
  result.rho = std::clamp(sum / (n - 1.0) / (of_a.standard_deviation * of_b.standard_deviation), -1.0, 1.0);
  if (std::fabs(result.rho) == 1.0) {
    result.p = 0.0;
    return result;
  }
  const double t = result.rho * std::sqrt((n - 2.0) / (1.0 - result.rho * result.rho));
  result.p = 2.0 * cdf(complement(boost::math::students_t(n - 2.0), std::fabs(t)));
  return result;
}

PValue probability_of_none(const std::vector<StudySummary>& studies, tmcmc::Index iterations, long runs) {
  double all = 0.0;
  double such = 0.0;
  for (const auto& s : studies) {
    for (const auto& [number, count] : s.iterations) {
      all += static_cast<double>(count);
      such += number >= iterations ? static_cast<double>(count) : 0.0;
    }
  }
  if (!(all > 0.0) || runs < 1) {
    throw errors::InvalidValue("studies and runs", runs, "at least one run of a study, and at least 1");
  }
  const double share = such / all;
  const auto n = static_cast<double>(runs);
  const double below = share < 1.0 ? portable_math::exp((n - 1.0) * portable_math::log(1.0 - share)) : 0.0;
  return {below * (1.0 - share), n * below * std::sqrt(share * (1.0 - share) / all)};
}

}  // namespace replication
