#include "replication/replication.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "errors/invalid_value.hpp"
#include "tmcmc/option_table.hpp"

namespace replication {

namespace {

constexpr tmcmc::Index most_runs = 1000000;  // the null distributions draw them one by one

}  // namespace

StudySummary summarise(std::uint32_t study, const std::string& sampler, const std::vector<Run>& runs,
                       int threads) {
  StudySummary summary;
  summary.study = study;
  summary.sampler = sampler;
  const Eigen::VectorXd areas = pbox_areas(runs, threads);
  summary.areas.assign(areas.begin(), areas.end());
  for (tmcmc::Index j = 0; j < areas.size(); ++j) {
    std::vector<double> values;
    for (const Run& run : runs) {
      values.push_back(run.mean[j]);
    }
    const Moments m = moments(values);
    summary.means.push_back(m.mean);
    summary.standard_errors.push_back(m.standard_deviation);
    double smallest = std::numeric_limits<double>::infinity();
    double largest = -smallest;
    for (const Run& run : runs) {
      for (const double x : run.result.final.points.col(j)) {
        smallest = std::min(smallest, x);
        largest = std::max(largest, x);
      }
    }
    summary.smallest.push_back(smallest);
    summary.largest.push_back(largest);
  }
  std::vector<double> log_evidence;
  for (const Run& run : runs) {
    log_evidence.push_back(run.result.final.log_evidence);
  }
  const Moments m = moments(log_evidence);
  summary.log_evidence_mean = m.mean;
  summary.log_evidence_sd = m.standard_deviation;
  summary.iterations = iteration_counts(runs);
  return summary;
}

std::vector<StudySummary> run_study(const tmcmc::Problem& problem, const std::vector<Arm>& arms,
                                    const StudyOptions& options) {
  std::vector<StudySummary> summaries;
  for (std::uint32_t a = 0; a < arms.size(); ++a) {
    summaries.push_back(
        summarise(options.study, arms[a].name, run_arm(problem, arms[a], a, options), options.threads));
  }
  return summaries;
}

std::string study_key(const Reading& reading, const std::vector<Arm>& arms, const StudyOptions& options,
                      const friction::Observations& observations, const tmcmc::BoxPrior& prior) {
  std::string text = fmt::format("runs {} seed {}", options.runs, options.seed);
  for (const auto& arm : arms) {
    text += fmt::format(" | {}", arm.name);
    for (const auto& [name, value] : tmcmc::sample_settings(arm.options)) {
      text += fmt::format(" {}={}", name, value);
    }
  }
  text +=
      fmt::format(" | {} {} {} {}", reading.physics.driving_force_n, static_cast<int>(reading.physics.limit),
                  static_cast<int>(reading.physics.phase), reading.infeasible_log_likelihood);
  for (const auto* column : {&observations.nominal_ratio, &observations.measured_ratio,
                             &observations.driving_frequency_hz, &observations.phase_deg}) {
    text += fmt::format(" | {}", fmt::join(*column, " "));
  }
  for (Eigen::Index j = 0; j < prior.dimension(); ++j) {
    text += fmt::format(" | {} {}", prior.lower()[j], prior.upper()[j]);
  }
  return text;
}

std::string format_iterations(const std::map<tmcmc::Index, tmcmc::Index>& counts) {
  std::string text;
  for (const auto& [iterations, runs] : counts) {
    if (!text.empty()) {
      text += ' ';
    }
    text += std::to_string(iterations);
    text += ':';
    text += std::to_string(runs);
  }
  return text;
}

std::map<tmcmc::Index, tmcmc::Index> parse_iterations(const std::string& text) {
  std::map<tmcmc::Index, tmcmc::Index> counts;
  const errors::InvalidValue refused(
      "iterations", text,
      "pairs such as 10:45, with blanks between: each number of iterations once, with 1 to 1000000 runs");
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto number = [&](char after, tmcmc::Index largest) {
    tmcmc::Index value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || value < 1 || value > largest ||
        (next == end ? after == ':' : *next != after)) {
      throw refused;
    }
    at = next == end ? end : next + 1;
    return value;
  };
  while (at != end) {
    const tmcmc::Index iterations = number(':', std::numeric_limits<tmcmc::Index>::max());
    if (at == end || !counts.emplace(iterations, number(' ', most_runs)).second) {
      throw refused;
    }
  }
  if (counts.empty()) {
    throw refused;
  }
  return counts;
}

}  // namespace replication
