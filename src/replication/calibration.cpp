#include "replication/calibration.hpp"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numeric>
#include <string>

#include "errors/invalid_value.hpp"
#include "friction/angle.hpp"
#include "statistics/p_value.hpp"
#include "tmcmc/parallel.hpp"
#include "tmcmc/weighted_samples.hpp"

namespace replication {

namespace {

using friction::Parameter;

constexpr std::uint32_t most_attempts = 1000000;

void require(bool condition, const char* field, tmcmc::Index value, const char* expected) {
  if (!condition) {
    throw errors::InvalidValue(field, value, expected);
  }
}

/// Ranks of the truth among evenly spaced rows of the population.
void rank(const tmcmc::Population& points, const Eigen::VectorXd& truth, tmcmc::Index draws,
          tmcmc::Index replication, CalibrationResult& result) {
  for (tmcmc::Index j = 0; j < truth.size(); ++j) {
    tmcmc::Index below = 0;
    for (tmcmc::Index k = 0; k < draws; ++k) {
      const tmcmc::Index row = (2 * k + 1) * points.rows() / (2 * draws);
      below += points(row, j) < truth[j] ? 1 : 0;
    }
    result.ranks[static_cast<std::size_t>(j)][static_cast<std::size_t>(replication)] = below;
  }
}

/// Whether a rank lies inside the central part of the draws that leaves out `tail` on each side.
bool covered(tmcmc::Index rank, const CalibrationOptions& options, double tail) {
  const double place = (static_cast<double>(rank) + 0.5) / static_cast<double>(options.draws + 1);
  return place > tail && place < 1.0 - tail;
}

/// Number of ranks from 0 to draws that are covered: a uniform rank is covered with this number
/// over draws + 1 as its probability.
double covered_values(const CalibrationOptions& options, double tail) {
  double count = 0.0;
  for (tmcmc::Index r = 0; r <= options.draws; ++r) {
    count += covered(r, options, tail) ? 1.0 : 0.0;
  }
  return count;
}

double two_sided_binomial(double successes, double trials, double probability) {
  const boost::math::binomial distribution(trials, probability);
  const double below = boost::math::cdf(distribution, successes);
  const double above =
      successes > 0.0 ? boost::math::cdf(boost::math::complement(distribution, successes - 1.0)) : 1.0;
  return std::min(1.0, 2.0 * std::min(below, above));
}

}  // namespace

void CalibrationOptions::validate() const {
  require(replications >= 1, "replications", replications, "at least 1");
  require(draws >= 1, "draws", draws, "at least 1");
  require(bins >= 2 && (draws + 1) % bins == 0, "bins", bins, "a divisor of draws + 1, at least 2");
  require(threads >= 1, "threads", threads, "at least 1");
}

SimulatedPair simulate_pair(const friction::Observations& design, const friction::Physics& physics,
                            const tmcmc::BoxPrior& prior, std::uint64_t seed, std::uint32_t replication) {
  constexpr std::uint32_t stream =
      2;  // of Purpose::data: 0 and 1 are those of synthetic observations and exact draws
  const friction::Likelihood model(design, physics);
  for (std::uint32_t attempt = 0; attempt < most_attempts; ++attempt) {
    SimulatedPair pair{Eigen::VectorXd(friction::parameter_count), design};
    const auto words = [&](std::uint64_t row) {
      return tmcmc::random_words(
          {.seed = seed, .run = replication},
          {.purpose = tmcmc::Purpose::data, .stage = stream, .row = row, .attempt = attempt});
    };
    prior.draw({.seed = seed, .run = replication},
               {.purpose = tmcmc::Purpose::data, .stage = stream, .attempt = attempt}, pair.parameters);
    bool accepted = pair.parameters[Parameter::friction_force] <= model.limit_friction_force_n();
    for (std::size_t i = 0; accepted && i < design.size(); ++i) {
      const auto w = words(i + 1);
      const auto noise = tmcmc::normal_pair(w[0], w[1] >> 32U);
      const double phase =
          friction::phase_deg(friction::response_constants(design.measured_ratio[i], physics),
                              pair.parameters[Parameter::friction_force] / physics.driving_force_n);
      pair.observations.phase_deg[i] =
          friction::within_a_turn_deg(phase + pair.parameters[Parameter::phase_noise] * noise.first);
      pair.observations.nominal_ratio[i] =
          design.driving_frequency_hz[i] / pair.parameters[Parameter::natural_frequency] +
          pair.parameters[Parameter::frequency_ratio_noise] * noise.second;
      accepted = !std::isnan(phase) && pair.observations.nominal_ratio[i] > 0.0;
    }
    if (accepted) {
      return pair;
    }
  }
  throw tmcmc::InfeasiblePriorError(
      "none of " + std::to_string(most_attempts) +
      " draws from the prior is feasible: expected friction forces up to " +
      std::to_string(model.limit_friction_force_n()) +
      " N, the limit of continuous motion, and noise that leaves the nominal ratios positive");
}

CalibrationResult calibrate(const friction::Observations& design, const Reading& reading,
                            const tmcmc::BoxPrior& prior, const Arm& arm, std::uint32_t arm_index,
                            const CalibrationOptions& options, const std::function<void()>& observer) {
  options.validate();
  arm.options.validate();
  // A prior without feasible draws ends here, once, not in every replication.
  static_cast<void>(simulate_pair(design, reading.physics, prior, options.seed, 0));
  const auto replications = static_cast<std::size_t>(options.replications);
  CalibrationResult result;
  result.ranks.assign(static_cast<std::size_t>(prior.dimension()), std::vector<tmcmc::Index>(replications));
  std::vector<char> unfinished(replications, 0), warned(replications, 0);
  tmcmc::for_each_block(
      options.replications, 1, options.threads, [&](tmcmc::Index index, tmcmc::Index, tmcmc::Index) {
        const auto replication = static_cast<std::uint32_t>(index);
        const auto pair = simulate_pair(design, reading.physics, prior, options.seed, replication);
        const tmcmc::StreamKey key{.seed = options.seed, .arm = arm_index, .run = replication};
        const auto run = tmcmc::run(problem(reading, pair.observations, prior), arm.options, key);
        unfinished[static_cast<std::size_t>(index)] = run.stop == tmcmc::StopReason::completed ? 0 : 1;
        warned[static_cast<std::size_t>(index)] = run.diagnostics.warnings.empty() ? 0 : 1;
        rank(run.measurement
                 ? tmcmc::equally_weighted(run, options.draws, key, tmcmc::Resampling::multinomial)
                 : run.final.points,
             pair.parameters, options.draws, index, result);
        if (observer) {
          observer();
        }
      });
  for (const char flag : unfinished) {
    result.unfinished += flag;
  }
  for (const char flag : warned) {
    result.warned += flag;
  }
  return result;
}

RankHistogram rank_histogram(const std::vector<tmcmc::Index>& ranks, const CalibrationOptions& options) {
  options.validate();
  if (ranks.empty()) {
    throw errors::InvalidValue("ranks", "", "at least one");
  }
  RankHistogram histogram;
  histogram.counts.assign(static_cast<std::size_t>(options.bins), 0);
  const tmcmc::Index values = options.draws + 1;
  const double values_total = static_cast<double>(values);
  const double total = static_cast<double>(ranks.size());
  double inside_50 = 0.0;
  double inside_90 = 0.0;
  for (const tmcmc::Index r : ranks) {
    require(r >= 0 && r < values, "rank", r, "a number from 0 to draws");
    ++histogram.counts[static_cast<std::size_t>(r * options.bins / values)];
    inside_50 += covered(r, options, 0.25) ? 1.0 : 0.0;
    inside_90 += covered(r, options, 0.05) ? 1.0 : 0.0;
  }
  const double expected = total / static_cast<double>(options.bins);
  for (const tmcmc::Index count : histogram.counts) {
    const double deviation = static_cast<double>(count) - expected;
    histogram.chi_squared += deviation * deviation / expected;
  }
  const boost::math::chi_squared distribution(static_cast<double>(options.bins - 1));
  histogram.p_chi_squared = boost::math::cdf(boost::math::complement(distribution, histogram.chi_squared));
  histogram.coverage_50 = inside_50 / total;
  histogram.coverage_90 = inside_90 / total;
  histogram.p_coverage_50 =
      two_sided_binomial(inside_50, total, covered_values(options, 0.25) / values_total);
  histogram.p_coverage_90 =
      two_sided_binomial(inside_90, total, covered_values(options, 0.05) / values_total);
  return histogram;
}

std::vector<RankBin> rank_bins(const RankHistogram& histogram) {
  // Width for a normal distribution function at all 19 inner edges of 20 bins together
  // (Bonferroni).
  constexpr double deviations_of_band = 3.47;
  const double n = std::accumulate(histogram.counts.begin(), histogram.counts.end(), 0.0);
  const double bins = static_cast<double>(histogram.counts.size());
  const boost::math::binomial in_bin(n, 1.0 / bins);
  std::vector<RankBin> all;
  double below = 0.0;
  for (const tmcmc::Index count : histogram.counts) {
    const double edge = (static_cast<double>(all.size()) + 1.0) / bins;
    below += static_cast<double>(count);
    all.push_back({.place = (static_cast<double>(all.size()) + 0.5) / bins,
                   .count = count,
                   .expected = n / bins,
                   .band_low = boost::math::quantile(in_bin, 0.005),
                   .band_high = boost::math::quantile(boost::math::complement(in_bin, 0.005)),
                   .edge = edge,
                   .ecdf_difference = below / n - edge,
                   .ecdf_band = deviations_of_band * std::sqrt(edge * (1.0 - edge) / n)});
  }
  return all;
}

CalibrationVerdict judge_calibration(const CalibrationResult& result, const CalibrationOptions& options) {
  constexpr double level = 0.01;  // of all tests together
  CalibrationVerdict verdict;
  std::vector<statistics::PValue> p;
  for (const auto& ranks : result.ranks) {
    verdict.histograms.push_back(rank_histogram(ranks, options));
    const auto& h = verdict.histograms.back();
    for (const double value : {h.p_chi_squared, h.p_coverage_50, h.p_coverage_90}) {
      p.push_back({value});
    }
  }
  for (const auto& adjusted : statistics::holm(p)) {
    verdict.smallest_p = std::min(verdict.smallest_p, adjusted.value);
  }
  verdict.is_calibrated = verdict.smallest_p >= level;
  return verdict;
}

}  // namespace replication
