#include "replication/reading_effects.hpp"

#include <algorithm>
#include <limits>

#include "names/names.hpp"
#include "replication/study.hpp"
#include "replication/synthetic.hpp"

namespace replication {

namespace {

double share(const std::vector<StudySummary>& studies, tmcmc::Index low, tmcmc::Index high) {
  double count = 0.0;
  double total = 0.0;
  for (const auto& s : studies) {
    for (const auto& [iterations, runs] : s.iterations) {
      total += static_cast<double>(runs);
      count += iterations >= low && iterations <= high ? static_cast<double>(runs) : 0.0;
    }
  }
  return count / total;
}

template <class Number>
double mean_of(const std::vector<StudySummary>& studies, Number number) {
  std::vector<double> values;
  std::transform(studies.begin(), studies.end(), std::back_inserter(values), number);
  return moments(values).mean;
}

AreaEffect area_effect(const std::vector<StudySummary>& studies, const std::vector<CellVerdict>& verdicts,
                       const std::string& sampler, std::size_t parameter) {
  std::vector<double> areas;
  for (const auto& s : studies) {
    areas.push_back(s.areas.at(parameter));
  }
  std::sort(areas.begin(), areas.end());
  const auto verdict = std::find_if(verdicts.begin(), verdicts.end(), [&](const CellVerdict& v) {
    return v.sampler == sampler && v.parameter == parameter;
  });
  return {sample_quantile(areas, 0.5), central_95(areas), verdict->p.value};
}

}  // namespace

std::vector<ReadingVariant> reading_variants(tmcmc::Index samples) {
  const Reading base = reading(ReadingName::as_published);
  std::vector<ReadingVariant> list;
  for (const auto& name : names::all<ReadingName>()) {
    list.push_back({name, reading(parse_reading(name))});
  }
  const auto add = [&](const std::string& name, auto change) {
    ReadingVariant v{name, base};
    change(v);
    list.push_back(v);
  };
  using V = ReadingVariant;
  add("deviation population",
      [](V& v) { v.reading.sampler.criterion.deviation = tmcmc::Deviation::population; });
  add("1 step a move", [](V& v) { v.reading.sampler.move = tmcmc::ResampleMove{.steps = 1}; });
  add("5 steps a move", [](V& v) { v.reading.sampler.move = tmcmc::ResampleMove{.steps = 5}; });
  add("growing chains", [](V& v) { v.reading.sampler.move = tmcmc::GrowingChains{}; });
  add("plain mean", [](V& v) { v.reading.sampler.centre = tmcmc::Centre::plain_mean; });
  add("reject outside", [](V& v) { v.reading.sampler.proposal = tmcmc::MetropolisProposal{}; });
  add("infeasible -inf", [](V& v) {
    v.reading.infeasible_log_likelihood = -std::numeric_limits<double>::infinity();
    v.reading.sampler.criterion.counted = tmcmc::Counted::feasible;
  });
  add("exact limit", [](V& v) { v.reading.physics.limit = friction::LimitRule::supremum; });
  add("exact phase", [](V& v) { v.reading.physics.phase = friction::PhaseRule::fourier_coefficient; });
  add("omega_n from 0.01 Hz", [](V& v) { v.reading.natural_frequency_lower_hz.reset(); });
  add("random ratios", [](V& v) { v.random_ratios = true; });
  for (V& v : list) {
    v.reading.sampler.samples = samples;
  }
  return list;
}

friction::Observations with_random_ratios(friction::Observations o, std::uint64_t seed, std::uint32_t study) {
  const double ratio_noise = Truth{}.frequency_ratio_noise;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const auto words = tmcmc::random_words({.seed = seed, .study = study},
                                           {.purpose = tmcmc::Purpose::data, .stage = 1, .row = i});
    o.measured_ratio[i] = o.nominal_ratio[i] + ratio_noise * tmcmc::normal_pair(words[0], words[1]).first;
  }
  return o;
}

std::vector<ReadingEffect> effects_of(const std::vector<StudySummary>& studies,
                                      const std::vector<PrintedArea>& areas,
                                      const std::vector<PrintedCounts>& counts, const TableDraws& draws) {
  constexpr Null null = Null::all_studies;
  const auto of_areas = judge_areas(studies, areas, null);
  const auto of_counts = judge_counts(studies, counts, null, draws);
  const double log_likelihood = log_likelihood_of_tables(studies, printed_columns(areas, counts), null);
  std::vector<ReadingEffect> effects;
  for (std::size_t a = 0; a < counts.size(); ++a) {
    const std::string& sampler = counts[a].sampler;
    const auto own = studies_of(studies, sampler);
    ReadingEffect e;
    e.sampler = sampler;
    e.force = area_effect(own, of_areas, sampler, 0);
    e.frequency = area_effect(own, of_areas, sampler, 1);
    e.share_up_to_9 = share(own, 0, 9);
    e.share_10 = share(own, 10, 10);
    e.share_from_11 = 1.0 - e.share_up_to_9 - e.share_10;
    e.counts_p = of_counts[a].p.value;
    e.mean_force_n = mean_of(own, [](const StudySummary& s) { return s.means.at(0); });
    e.mean_frequency_hz = mean_of(own, [](const StudySummary& s) { return s.means.at(1); });
    e.mean_log_evidence = mean_of(own, [](const StudySummary& s) { return s.log_evidence_mean; });
    e.log_likelihood = log_likelihood;
    effects.push_back(e);
  }
  return effects;
}

}  // namespace replication
