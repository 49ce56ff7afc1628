#include "replication/published.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "errors/invalid_value.hpp"
#include "portable_math/elementary.hpp"

namespace replication {

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

std::vector<double> iterations_of(const std::vector<StudySummary>& studies) {
  std::vector<double> means;
  for (const auto& counts : counts_of(studies)) {
    means.push_back(mean_iterations(counts));
  }
  return means;
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
    throw errors::InvalidValue("sampler", sampler, "one with at least one replicated study");
  }
  return result;
}

std::vector<StudySummary> null_studies(const std::vector<StudySummary>& studies, const std::string& sampler,
                                       Null null) {
  auto own = studies_of(studies, sampler);
  return null == Null::all_studies ? studies : own;
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
                               const std::vector<PrintedCounts>& counts, Null null, const TableDraws& draws) {
  PublishedVerdicts result;
  std::vector<PValue> p;
  for (const auto& area : areas) {
    auto sample = areas_of(null_studies(studies, area.sampler, null), area.parameter);
    std::sort(sample.begin(), sample.end());
    CellVerdict cell;
    cell.sampler = area.sampler;
    cell.parameter = area.parameter;
    cell.printed = number(area.printed);
    cell.median = sample_quantile(sample, 0.5);
    cell.p = two_sided_p(sample, cell.printed, rounding_half_width(area.printed));
    cell.interval = central_95(std::move(sample));
    p.push_back(cell.p);
    result.areas.push_back(cell);
  }
  if (!counts.empty()) {
    CountsVerdict verdict;
    std::vector<Counts> printed;
    std::vector<std::vector<Counts>> replicated;
    for (const auto& column : counts) {
      printed.push_back(column.counts);
      replicated.push_back(counts_of(null_studies(studies, column.sampler, null)));
      verdict.columns.push_back(test_tables({printed.back()}, {replicated.back()}, draws));
    }
    if (null == Null::all_studies) {
      replicated.resize(1);
    }
    verdict.test = test_tables(printed, replicated, draws);
    p.push_back(verdict.test.p);
    result.counts = std::move(verdict);
  }
  const auto adjusted = holm(p);
  for (std::size_t i = 0; i < areas.size(); ++i) {
    result.areas[i].p_holm = adjusted[i];
    result.areas[i].number = judge_number(adjusted[i]);
  }
  if (result.counts) {
    result.counts->p_holm = adjusted.back();
    result.counts->number = judge_number(adjusted.back());
  }
  return result;
}

Null null_of(const std::vector<StudySummary>& studies, const std::string& first, const std::string& second,
             std::uint64_t seed) {
  const auto a = studies_of(studies, first);
  const auto b = studies_of(studies, second);
  bool one = median_ratio_equivalence(iterations_of(a), iterations_of(b), iteration_margin, seed).equivalent;
  for (const std::size_t parameter : {std::size_t{0}, std::size_t{1}}) {
    one = one && median_ratio_equivalence(areas_of(a, parameter), areas_of(b, parameter), area_margin, seed)
                     .equivalent;
  }
  return one ? Null::all_studies : Null::own_studies;
}

ContrastVerdict contrast_areas(const std::vector<StudySummary>& studies, const std::string& first,
                               const std::string& second, std::size_t parameter, double printed_ratio,
                               std::uint64_t seed) {
  const auto a = areas_of(studies_of(studies, first), parameter);
  const auto b = areas_of(studies_of(studies, second), parameter);
  auto both = a;
  both.insert(both.end(), b.begin(), b.end());
  const RatioTest test = test_ratio_of_equals(std::move(both), printed_ratio);
  return {printed_ratio, test.interval, test.p, median_ratio_equivalence(a, b, area_margin, seed)};
}

ContrastVerdict contrast_iterations(const std::vector<StudySummary>& studies, const Counts& first_printed,
                                    const Counts& second_printed, const std::string& first,
                                    const std::string& second, std::uint64_t seed, const TableDraws& draws) {
  const auto a = studies_of(studies, first);
  const auto b = studies_of(studies, second);
  auto both = counts_of(a);
  const auto of_second = counts_of(b);
  both.insert(both.end(), of_second.begin(), of_second.end());
  const DevianceTest test = test_two_tables(first_printed, second_printed, both, draws);
  return {test.statistic, test.interval, test.p,
          median_ratio_equivalence(iterations_of(a), iterations_of(b), iteration_margin, seed)};
}

double log_likelihood_of_tables(const std::vector<StudySummary>& studies,
                                const std::vector<PrintedArea>& areas,
                                const std::vector<PrintedCounts>& counts, Null null) {
  double sum = 0.0;
  for (const auto& column : counts) {
    const auto of_sampler = null_studies(studies, column.sampler, null);
    sum += log_multinomial(column.counts, category_probabilities(counts_of(of_sampler), column.counts));
    std::vector<const PrintedArea*> printed;
    for (const auto& area : areas) {
      if (area.sampler == column.sampler) {
        printed.push_back(&area);
      }
    }
    if (of_sampler.size() < 3 || printed.empty() || printed.size() > 2) {
      throw errors::InvalidValue("sampler", column.sampler,
                                 "one or two printed areas and at least 3 studies");
    }
    sum += log_density_of_areas(of_sampler, printed);
  }
  return sum;
}

}  // namespace replication
