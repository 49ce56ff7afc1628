// Which reading of the paper makes the printed numbers? Each difference between text, published scripts and mathematics
// changed alone from `as_published`, and the three presets, with the effect on every number of Tables 3 and 4, the
// distance to the exact posterior, and the joint likelihood of both tables.
//
// Data: Tables 1 to 4 as printed. Where the published script takes the frequency ratios of the phase model from a column
// that is not in the paper, that column is drawn at random (r_nom + noise), anew in each study.

#include <algorithm>
#include <cmath>

#include "inputs.hpp"
#include "replication/synthetic.hpp"

using namespace experiments;

namespace {

struct Variant {
  std::string name;
  replication::Reading reading;
  bool random_ratios = false;
};

std::vector<Variant> variants(tmcmc::Index samples) {
  const replication::Reading base = replication::reading(replication::ReadingName::as_published);
  std::vector<Variant> list;
  for (const auto& name : replication::reading_names()) {
    list.push_back({name, replication::reading(replication::parse_reading(name))});
  }
  const auto add = [&](const std::string& name, auto change) {
    Variant v{name, base};
    change(v);
    list.push_back(v);
  };
  add("deviation population",
      [](Variant& v) { v.reading.sampler.criterion.deviation = tmcmc::Deviation::population; });
  add("1 step a move", [](Variant& v) { v.reading.sampler.move_steps = 1; });
  add("5 steps a move", [](Variant& v) { v.reading.sampler.move_steps = 5; });
  add("growing chains", [](Variant& v) { v.reading.sampler.move = tmcmc::MoveKind::growing_chains; });
  add("plain mean", [](Variant& v) { v.reading.sampler.centre = tmcmc::Centre::plain_mean; });
  add("reject outside", [](Variant& v) { v.reading.sampler.boundary = tmcmc::Boundary::reject; });
  add("infeasible -inf", [](Variant& v) {
    v.reading.infeasible_log_likelihood = -std::numeric_limits<double>::infinity();
    v.reading.sampler.criterion.counted = tmcmc::Counted::feasible;
  });
  add("exact limit", [](Variant& v) { v.reading.physics.limit = friction::LimitRule::supremum; });
  add("exact phase", [](Variant& v) { v.reading.physics.phase = friction::PhaseRule::fourier_coefficient; });
  add("omega_n from 0.01 Hz", [](Variant& v) { v.reading.natural_frequency_lower_hz.reset(); });
  add("random ratios", [](Variant& v) { v.random_ratios = true; });
  for (Variant& v : list) {
    v.reading.sampler.samples = samples;
  }
  return list;
}

/// Measured ratios drawn anew around the nominal ones (Eq. 22).
friction::Observations with_random_ratios(friction::Observations o, std::uint64_t seed, std::uint32_t study) {
  constexpr double ratio_noise = 0.01;
  for (std::size_t i = 0; i < o.size(); ++i) {
    const auto words = tmcmc::random_words({.seed = seed, .study = study},
                                           {.purpose = tmcmc::Purpose::data, .stage = 1, .row = i});
    o.measured_ratio[i] = o.nominal_ratio[i] + ratio_noise * tmcmc::normal_pair(words[0], words[1]).first;
  }
  return o;
}

double share(const std::vector<replication::StudySummary>& studies, std::int64_t low, std::int64_t high) {
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

double mean_of(const std::vector<replication::StudySummary>& studies, auto member) {
  std::vector<double> values;
  for (const auto& s : studies) {
    values.push_back(member(s));
  }
  return replication::moments(values).mean;
}

struct Spread {
  double median;
  replication::Interval95 interval;
};

Spread spread_of_areas(const std::vector<replication::StudySummary>& studies, std::size_t parameter) {
  std::vector<double> areas;
  for (const auto& s : studies) {
    areas.push_back(s.areas[parameter]);
  }
  std::sort(areas.begin(), areas.end());
  return {replication::sample_quantile(areas, 0.5), replication::central_95(areas)};
}

}  // namespace

int main(int argc, char** argv) {
  Program program("readings", "Effect of each reading of the paper on every printed number.");
  InputFiles inputs;
  RunOptions run_options;
  TableOptions table_options;
  table_options.draws = {.tables = 20000, .resamples = 2};  // the standard error is not reported
  std::string only;
  long studies = 40;
  long samples = 1000;
  std::string table3 = published("table3_pbox_area.csv");
  std::string table4 = published("table4_iteration_counts.csv");
  program.add_output("CSV with one row a reading and sampler");
  inputs.add_observations_to(program);
  run_options.add_to(program, 2);
  program.add_number("--studies", studies, count(3, 1000000), "Replicated studies a reading");
  program.add_number("--samples", samples, count(2), "N, samples a run");
  table_options.add_to(program);
  program.add_text("--only", only, "TEXT", "Only the reading of this name, for example 'as_worded'");
  program.add_input("--table3", table3, "Table 3 as printed");
  program.add_input("--table4", table4, "Table 4 as printed");

  return program.run(argc, argv, [&] {
    const auto observations = read_observations(inputs.observations);
    const auto printed = read_printed_tables(table3, table4);
    auto options = run_options.study_options();
    auto list = variants(samples);
    if (!only.empty()) {
      std::erase_if(list, [&](const Variant& v) { return v.name != only; });
    }
    if (list.empty()) {
      throw std::invalid_argument(fmt::format("--only: value '{}': expected the name of a reading", only));
    }
    for (const auto& column : printed.counts) {
      const auto arms = replication::paper_arms(list.front().reading);
      if (std::none_of(arms.begin(), arms.end(),
                       [&](const auto& arm) { return arm.name == column.sampler; })) {
        throw io::InputError(fmt::format("{}: column '{}': expected the samplers that are run here", table4,
                                         io::printable(column.sampler)));
      }
    }
    std::optional<io::CsvWriter> csv;
    if (!program.output().empty()) {
      csv.emplace(
          program.output(),
          std::vector<std::string>{"reading", "sampler", "area_force_median", "area_force_low",
                                   "area_force_high", "area_force_p", "area_frequency_median",
                                   "area_frequency_low", "area_frequency_high", "area_frequency_p",
                                   "share_up_to_9", "share_10", "share_from_11", "counts_p", "force_error_n",
                                   "frequency_error_hz", "log_evidence_error", "log_likelihood_of_tables"});
    }
    program.report(
        "{} studies of {} runs a reading, seed {}\n{:<22} {:<9} {:>8} {:>16} {:>6} {:>8} {:>17} {:>6} {:>18} "
        "{:>6} {:>9} {:>8}\n",
        studies, options.runs, options.seed, "reading", "sampler", "F area", "95 %", "p", "w area", "95 %",
        "p", "<=9 / 10 / >=11", "p", "F error", "log lik");
    io::Progress progress("readings", list.size() * static_cast<std::size_t>(studies), !program.quiet());
    for (const Variant& variant : list) {
      const auto prior = prior_for(inputs, variant.reading);
      const auto arms = replication::paper_arms(variant.reading);
      std::vector<replication::StudySummary> summaries;
      for (long k = 0; k < studies; ++k) {
        options.study = static_cast<std::uint32_t>(k);
        const auto data = variant.random_ratios
                              ? with_random_ratios(observations, options.seed, options.study)
                              : observations;
        const auto study = replication::run_study(
            interruptible(replication::problem(variant.reading, data, prior)), arms, options);
        summaries.insert(summaries.end(), study.begin(), study.end());
        progress.advance();
      }
      const auto exact =
          exact_posterior_for(inputs, friction::Likelihood(observations, variant.reading.physics), prior);
      // Under each reading both samplers are one algorithm (N_eff of 500 or 500.25): the studies of both are one null.
      const auto null = replication::Null::all_studies;
      const auto verdicts =
          replication::judge_tables(summaries, printed.areas, printed.counts, null, table_options.draws);
      const double log_likelihood =
          replication::log_likelihood_of_tables(summaries, printed.areas, printed.counts, null);
      for (std::size_t a = 0; a < arms.size(); ++a) {
        const auto of_arm = replication::studies_of(summaries, arms[a].name);
        const Spread force = spread_of_areas(of_arm, friction::friction_force);
        const Spread frequency = spread_of_areas(of_arm, friction::natural_frequency);
        const double force_p = verdicts.areas[a].p.value;
        const double frequency_p = verdicts.areas[arms.size() + a].p.value;
        const double counts_p = verdicts.counts->columns[a].p.value;
        const double low = share(of_arm, 0, 9);
        const double ten = share(of_arm, 10, 10);
        const double force_error = mean_of(of_arm, [](const auto& s) { return s.means[0]; }) -
                                   exact.marginal(friction::friction_force).mean();
        const double frequency_error = mean_of(of_arm, [](const auto& s) { return s.means[1]; }) -
                                       exact.marginal(friction::natural_frequency).mean();
        const double evidence_error =
            mean_of(of_arm, [](const auto& s) { return s.log_evidence_mean; }) - exact.log_evidence();
        program.report(
            "{:<22} {:<9} {:>8.4f} {:>7.4f}-{:<8.4f} {:>6.3f} {:>8.5f} {:>8.5f}-{:<8.5f} {:>6.3f} {:>5.2f} "
            "{:>5.2f} {:>6.2f} {:>6.3f} {:>+9.5f} {:>8.2f}\n",
            variant.name, arms[a].name, force.median, force.interval.low, force.interval.high, force_p,
            frequency.median, frequency.interval.low, frequency.interval.high, frequency_p, low, ten,
            1.0 - low - ten, counts_p, force_error, log_likelihood);
        if (csv) {
          csv->row(variant.name, arms[a].name, force.median, force.interval.low, force.interval.high, force_p,
                   frequency.median, frequency.interval.low, frequency.interval.high, frequency_p, low, ten,
                   1.0 - low - ten, counts_p, force_error, frequency_error, evidence_error, log_likelihood);
        }
      }
    }
    io::commit_all(csv);
  });
}
