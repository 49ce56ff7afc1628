#include "study/published.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

#include "portable_math/elementary.hpp"

namespace study {

namespace {

double number(const std::string& printed) {
  double value = 0.0;
  std::from_chars(printed.data(), printed.data() + printed.size(), value);
  return value;
}

std::vector<double> areas_of(const std::vector<StudySummary>& studies, std::size_t parameter) {
  std::vector<double> areas;
  for (const auto& s : studies) {
    areas.push_back(s.areas.at(parameter));
  }
  return areas;
}

std::vector<Counts> counts_of(const std::vector<StudySummary>& studies) {
  std::vector<Counts> counts;
  for (const auto& s : studies) {
    counts.emplace_back(s.iterations.begin(), s.iterations.end());
  }
  return counts;
}

double log_normal_density(double squared_distance, double log_determinant, double dimension) {
  constexpr double log_two_pi = 1.8378770664093453;
  return -0.5 * (squared_distance + log_determinant + dimension * log_two_pi);
}

/// log-density of the logarithms of one or two areas, Normal with the moments of the studies.
double log_density_of_areas(const std::vector<StudySummary>& studies,
                            const std::vector<const PrintedArea*>& printed) {
  std::vector<std::vector<double>> logs(printed.size());
  std::vector<Moments> m;
  std::vector<double> deviation;
  for (std::size_t k = 0; k < printed.size(); ++k) {
    for (const double area : areas_of(studies, printed[k]->parameter)) {
      logs[k].push_back(portable_math::log(area));
    }
    m.push_back(moments(logs[k]));
    deviation.push_back((portable_math::log(number(printed[k]->printed)) - m[k].mean) /
                        m[k].standard_deviation);
  }
  if (printed.size() == 1) {
    return log_normal_density(deviation[0] * deviation[0], 2.0 * portable_math::log(m[0].standard_deviation),
                              1.0);
  }
  double correlation = 0.0;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    correlation += (logs[0][i] - m[0].mean) / m[0].standard_deviation * (logs[1][i] - m[1].mean) /
                   m[1].standard_deviation;
  }
  correlation /= static_cast<double>(studies.size() - 1);
  const double rest = 1.0 - correlation * correlation;
  const double distance = (deviation[0] * deviation[0] + deviation[1] * deviation[1] -
                           2.0 * correlation * deviation[0] * deviation[1]) /
                          rest;
  return log_normal_density(
      distance,
      2.0 * portable_math::log(m[0].standard_deviation * m[1].standard_deviation) + portable_math::log(rest),
      2.0);
}

}  // namespace

std::vector<StudySummary> studies_of(const std::vector<StudySummary>& studies, const std::string& sampler) {
  std::vector<StudySummary> result;
  std::copy_if(studies.begin(), studies.end(), std::back_inserter(result),
               [&](const StudySummary& s) { return s.sampler == sampler; });
  if (result.empty()) {
    throw std::invalid_argument("no replicated study of sampler '" + sampler + "': expected at least one");
  }
  return result;
}

double mean_iterations(const Counts& counts) {
  double sum = 0.0;
  double runs = 0.0;
  for (const auto& [iterations, count] : counts) {
    sum += static_cast<double>(iterations * count);
    runs += static_cast<double>(count);
  }
  return sum / runs;
}

PublishedVerdicts judge_tables(const std::vector<StudySummary>& studies,
                               const std::vector<PrintedArea>& areas,
                               const std::vector<PrintedCounts>& counts) {
  PublishedVerdicts result;
  std::vector<double> p;
  for (const auto& area : areas) {
    auto null = areas_of(studies_of(studies, area.sampler), area.parameter);
    std::sort(null.begin(), null.end());
    CellVerdict cell;
    cell.sampler = area.sampler;
    cell.parameter = area.parameter;
    cell.printed = number(area.printed);
    cell.median = sample_quantile(null, 0.5);
    cell.interval = central_95(null);
    cell.p = two_sided_p(null, cell.printed, rounding_half_width(area.printed));
    p.push_back(cell.p);
    result.areas.push_back(cell);
  }
  for (const auto& column : counts) {
    const auto replicated = counts_of(studies_of(studies, column.sampler));
    const auto probabilities = category_probabilities(replicated, column.counts);
    std::vector<double> null;
    for (const Counts& c : replicated) {
      null.push_back(deviance(c, probabilities));
    }
    CountsVerdict verdict;
    verdict.sampler = column.sampler;
    verdict.statistic = deviance(column.counts, probabilities);
    std::sort(null.begin(), null.end());
    verdict.critical = sample_quantile(null, 0.95);
    verdict.p = upper_p(null, verdict.statistic, 1e-9 * verdict.statistic);
    p.push_back(verdict.p);
    result.counts.push_back(verdict);
  }
  const auto adjusted = holm(p);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    result.areas[i].p_holm = adjusted[i];
    result.areas[i].reproduced = adjusted[i] >= significance_level;
  }
  for (std::size_t i = 0; i < counts.size(); ++i) {
    result.counts[i].p_holm = adjusted[areas.size() + i];
    result.counts[i].reproduced = result.counts[i].p_holm >= significance_level;
  }
  return result;
}

ContrastVerdict contrast_areas(const std::vector<StudySummary>& studies, const std::string& first,
                               const std::string& second, std::size_t parameter, double printed_ratio,
                               double margin, std::uint64_t seed) {
  const auto a = areas_of(studies_of(studies, first), parameter);
  const auto b = areas_of(studies_of(studies, second), parameter);
  std::vector<double> null;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    null.push_back(b[i] / a[i]);
    null.push_back(a[i] / b[i]);
  }
  ContrastVerdict result;
  result.printed = printed_ratio;
  result.interval = central_95(null);
  result.p = two_sided_p(null, printed_ratio);
  result.replicated = median_ratio_equivalence(a, b, margin, seed);
  return result;
}

ContrastVerdict contrast_iterations(const std::vector<StudySummary>& studies, const Counts& first_printed,
                                    const Counts& second_printed, const std::string& first,
                                    const std::string& second, double margin, std::uint64_t seed) {
  const auto a = counts_of(studies_of(studies, first));
  const auto b = counts_of(studies_of(studies, second));
  std::vector<double> null, mean_a, mean_b;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    null.push_back(two_sample_deviance(a[i], b[i]));
  }
  for (const auto& c : a) {
    mean_a.push_back(mean_iterations(c));
  }
  for (const auto& c : b) {
    mean_b.push_back(mean_iterations(c));
  }
  ContrastVerdict result;
  result.printed = two_sample_deviance(first_printed, second_printed);
  result.interval = central_95(null);
  result.p = upper_p(null, result.printed, 1e-9 * result.printed);
  result.replicated = median_ratio_equivalence(mean_a, mean_b, margin, seed);
  return result;
}

double log_likelihood_of_tables(const std::vector<StudySummary>& studies,
                                const std::vector<PrintedArea>& areas,
                                const std::vector<PrintedCounts>& counts) {
  double sum = 0.0;
  for (const auto& column : counts) {
    const auto of_sampler = studies_of(studies, column.sampler);
    sum += log_multinomial(column.counts, category_probabilities(counts_of(of_sampler), column.counts));
    std::vector<const PrintedArea*> printed;
    for (const auto& area : areas) {
      if (area.sampler == column.sampler) {
        printed.push_back(&area);
      }
    }
    if (of_sampler.size() < 3 || printed.empty() || printed.size() > 2) {
      throw std::invalid_argument(
          "log_likelihood_of_tables: expected one or two areas a sampler and at least 3 studies");
    }
    sum += log_density_of_areas(of_sampler, printed);
  }
  return sum;
}

}  // namespace study
