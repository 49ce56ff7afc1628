#include "replication/forensics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "errors/invalid_value.hpp"
#include "io/csv.hpp"
#include "portable_math/elementary.hpp"

namespace replication {

namespace {

constexpr int fewest_steps = 2;
constexpr int most_steps = 5;
constexpr std::uint32_t first_arm = 16;  // of the streams; those of the paper's samplers are 0 and 1

double both(const LogDensity& density) {
  return density.both();
}

std::vector<StudySummary> shifted(std::vector<StudySummary> studies, int shift) {
  for (auto& s : studies) {
    std::map<tmcmc::Index, tmcmc::Index> counts;
    for (const auto& [iterations, runs] : s.iterations) {
      counts[iterations + shift] += runs;
    }
    s.iterations = std::move(counts);
  }
  return studies;
}

/// Categories such that a number of iterations that no run of any setting took still has a
/// probability under each setting.
Counts all_categories(const std::vector<std::vector<StudySummary>>& studies,
                      const std::vector<PrintedColumn>& printed) {
  Counts categories;
  for (const auto& column : printed) {
    categories.insert(column.counts.begin(), column.counts.end());
  }
  for (const auto& of_setting : studies) {
    for (const auto& s : of_setting) {
      for (const auto& cell : s.iterations) {
        for (const int shift : {-1, 0, 1}) {
          categories.try_emplace(cell.first + shift, 0);
        }
      }
    }
  }
  return categories;
}

SettingFit fit_of(const std::string& name, int shift, const Prediction& prediction,
                  const std::vector<PrintedColumn>& printed) {
  SettingFit fit{name, shift, {}};
  const auto scores = scores_of(prediction, both);
  for (const auto& column : printed) {
    const double density = prediction.log_density(column.areas, column.counts).both();
    fit.columns.push_back({density, predictive_p(scores, density)});
  }
  return fit;
}

/// The difference by which the best setting fits a column better than the first setting does.
double gain_of(const std::vector<Prediction>& predictions, std::span<const double> areas,
               const Counts& counts) {
  double best = -std::numeric_limits<double>::infinity();
  for (const auto& p : predictions) {
    best = std::max(best, p.log_density(areas, counts).both());
  }
  return best - predictions.front().log_density(areas, counts).both();
}

}  // namespace

std::vector<Setting> forensic_settings(tmcmc::Index samples) {
  std::vector<Setting> settings;
  Reading base = reading(ReadingName::as_published);
  base.sampler.samples = samples;
  enum class Outside { redraw, reject };  // a proposal outside the prior
  const auto changed = [&](int steps, Outside outside) {
    Reading r = base;
    r.sampler.move = tmcmc::ResampleMove{.steps = steps};
    if (outside == Outside::reject) {
      r.sampler.proposal = tmcmc::MetropolisProposal{};
    }
    return r;
  };
  settings.push_back({"3 steps redraw", base, {}});
  for (const int steps : {fewest_steps, 4, most_steps}) {
    settings.push_back({std::to_string(steps) + " steps redraw", changed(steps, Outside::redraw), {}});
  }
  for (int steps = fewest_steps; steps <= most_steps; ++steps) {
    settings.push_back({std::to_string(steps) + " steps reject", changed(steps, Outside::reject), {}});
  }
  Reading population = base;
  population.sampler.criterion.deviation = tmcmc::Deviation::population;
  settings.push_back({"population deviation", population, {}});
  Reading no_penalty = base;
  no_penalty.infeasible_log_likelihood = -std::numeric_limits<double>::infinity();
  no_penalty.sampler.criterion.counted = tmcmc::Counted::feasible;
  settings.push_back({"no penalty", no_penalty, {}});
  settings.push_back({"half 3 redraw + 4 reject", base, changed(4, Outside::reject)});
  settings.push_back({"half 2 + 4 redraw", changed(2, Outside::redraw), changed(4, Outside::redraw)});
  return settings;
}

std::vector<StudySummary> run_setting(const Setting& setting,
                                      const std::function<tmcmc::Problem(const Reading&)>& make_problem,
                                      std::uint32_t index, long count, StudyOptions options,
                                      const std::function<void()>& after_each) {
  std::vector<std::pair<Arm, tmcmc::Problem>> parts;
  for (const Reading* r : {&setting.reading, setting.second ? &*setting.second : nullptr}) {
    if (r != nullptr) {
      parts.emplace_back(paper_arms(*r).front(), make_problem(*r));
    }
  }
  const tmcmc::Index all = options.runs;
  std::vector<StudySummary> studies;
  for (long k = 0; k < count; ++k) {
    options.study = static_cast<std::uint32_t>(k);
    std::vector<Run> runs;
    for (std::size_t part = 0; part < parts.size(); ++part) {
      options.runs = part == 0 && parts.size() > 1 ? all / 2 : all - static_cast<tmcmc::Index>(runs.size());
      auto more = run_arm(parts[part].second, parts[part].first,
                          first_arm + 2 * index + static_cast<std::uint32_t>(part), options);
      std::move(more.begin(), more.end(), std::back_inserter(runs));
    }
    studies.push_back(summarise(options.study, setting.name, runs, options.threads));
    after_each();
  }
  return studies;
}

Forensics compare_settings(const std::vector<std::vector<StudySummary>>& studies,
                           const std::vector<std::string>& names, const std::vector<PrintedColumn>& printed) {
  if (studies.empty() || studies.size() != names.size() || printed.size() != 2) {
    throw errors::InvalidValue("names", names.size(), "one a set of studies, and two printed columns");
  }
  const Counts categories = all_categories(studies, printed);
  Forensics result;
  std::vector<Prediction> predictions;
  for (std::size_t i = 0; i < studies.size(); ++i) {
    for (const int shift : {0, 1, -1}) {
      const Prediction prediction(shifted(studies[i], shift), categories);
      result.settings.push_back(fit_of(names[i], shift, prediction, printed));
      if (shift == 0) {
        predictions.push_back(prediction);
      }
    }
  }
  std::vector<std::vector<double>> scores;
  std::array<std::vector<double>, 2> densities;
  for (const auto& p : predictions) {
    scores.push_back(scores_of(p, both));
    for (const std::size_t c : {std::size_t{0}, std::size_t{1}}) {
      densities[c].push_back(p.log_density(printed[c].areas, printed[c].counts).both());
    }
  }
  double best = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < predictions.size(); ++i) {
    for (std::size_t j = 0; j < predictions.size(); ++j) {
      PairFit pair{i, j, densities[0][i] + densities[1][j], {}, 0.0};
      pair.p = i == j ? predictive_p_of_pair(scores[i], pair.log_density)
                      : predictive_p_of_pair(scores[i], scores[j], pair.log_density);
      best = std::max(best, pair.log_density);
      result.pairs.push_back(pair);
    }
  }
  double sum = 0.0;
  for (auto& pair : result.pairs) {
    pair.weight = portable_math::exp(pair.log_density - best);
    sum += pair.weight;
  }
  for (auto& pair : result.pairs) {
    pair.weight /= sum;
  }
  result.gain = best - result.pairs.front().log_density;
  result.number_of_pairs = static_cast<double>(result.pairs.size());
  std::vector<double> losses;  // of the studies of the first setting: minus what a search would gain on each
  for (const auto& s : studies.front()) {
    losses.push_back(-gain_of(predictions, s.areas, {s.iterations.begin(), s.iterations.end()}));
  }
  result.search_p = predictive_p_of_pair(losses, -result.gain + 1e-9);
  return result;
}

std::vector<SearchStatistic> search_statistics(const Forensics& found, const std::vector<std::string>& names,
                                               long studies) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const PairFit& best =
      *std::max_element(found.pairs.begin(), found.pairs.end(),
                        [](const auto& a, const auto& b) { return a.log_density < b.log_density; });
  return {{"studies of each setting", std::to_string(studies), none},
          {"pairs", io::format_number(found.number_of_pairs), none},
          {"log of the pairs", fmt::format("{:.6g}", portable_math::log(found.number_of_pairs)), none},
          {"fewest steps", std::to_string(fewest_steps), none},
          {"most steps", std::to_string(most_steps), none},
          {"best first", names.at(best.first), none},
          {"best second", names.at(best.second), none},
          {"gain", io::format_number(found.gain), none},
          {"p of the best pair", io::format_number(best.p.value), best.p.standard_error},
          {"weight of the best pair", io::format_number(best.weight), none},
          {"p of the search", io::format_number(found.search_p.value), found.search_p.standard_error}};
}

}  // namespace replication
