#include "tmcmc/detail/independent_draws.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "portable_math/sums.hpp"
#include "tmcmc/detail/separate_modes.hpp"
#include "tmcmc/log_weights.hpp"

namespace tmcmc::detail {

namespace {

/// Stages of Purpose::reference: the attempts of the joint fit count from 0.
constexpr std::uint32_t final_draws_stage = 2000;

constexpr double least_beta = 0.001;          // that one search has to reach
constexpr double share_of_a_good_fit = 0.65;  // of the first trial draws
constexpr double share_of_a_poor_fit = 0.1;   // below it there are more attempts
constexpr std::uint32_t most_attempts = 4;    // of the joint fit
constexpr std::uint32_t most_attempts_poor = 12;
constexpr double few_effective = 4.0;  // of the final draws: below it the fit has failed, and all draws count

/// A stream that is independent of the key's own.
StreamKey derived(const StreamKey& key, std::uint32_t number) {
  constexpr std::uint32_t derived_block = 3U << 24U;
  StreamKey result = key;
  result.seed = random_words(key, {.purpose = Purpose::reference, .row = number, .block = derived_block})[0];
  return result;
}

/// Effective size that the criterion requires, as a share of the population.
double effective_share(const Criterion& criterion) {
  if (const auto* size = std::get_if<EffectiveSampleSize>(&criterion.rule)) {
    return size->fraction;
  }
  const double target = std::get<CoefficientOfVariation>(criterion.rule).target;
  return 1.0 / (1.0 + target * target);
}

/// Settings for each of the two searches: populations of 200 draws, or 40 d, if the evaluations
/// suffice for 20 of them in addition to 600 draws. Smaller populations reach the posterior sooner,
/// but lose modes. A fit after each half of a population wastes fewer draws on an old fit, but a
/// fit after fewer than 100 draws loses modes.
SearchOptions search_options(const Options& options, const IndependentDraws& settings, Index dimension) {
  const auto all = static_cast<double>(options.evaluation_budget);
  const auto d = static_cast<double>(dimension);
  const double evaluations = 0.5 * std::min(1300.0 + settings.search_share * all, 0.64 * all);
  const double least = std::max(30.0, std::min(d * d, 10.0 * d));
  const double most = std::max(200.0, 40.0 * d);
  const double population = std::clamp((evaluations - 600.0) / 20.0, least, most);
  const double share = effective_share(options.criterion);
  return {.evaluations = static_cast<Index>(evaluations),
          .round = static_cast<Index>(
              std::max({0.5 * population, std::min(population, 100.0), evaluations / 48.0})),
          .target = share * population,
          .most_target = share * most,
          .enough = 15.0 * share * population,
          .prior_share = settings.prior_share,
          .wide_share = 1.5 * settings.wide_share,
          .fit = settings.fit,
          .threads = options.threads,
          .batch_rows = options.batch_rows};
}

/// The fit with shares of the tempered fits (if there are any), wider components and the prior.
ReferenceDensity reference_of(const IndependentDraws& settings, const StudentMixture& fit,
                              const std::array<Search, 2>& searches) {
  const StudentMixture& a = searches[0].tempered;
  const StudentMixture& b = searches[1].tempered;
  ReferenceDensity reference{.fitted = fit, .prior_share = settings.prior_share};
  if (a.size() > 0 || b.size() > 0) {
    const StudentMixture tempered = a.size() > 0 && b.size() > 0 ? blend(a, 0.5, b) : (a.size() > 0 ? a : b);
    reference.fitted = blend(fit, 1.0 - settings.tempered_share, tempered);
  }
  reference.fitted.wide_share = settings.wide_share;
  return reference;
}

/// The points of both, each with their own weights. Since a density is fitted to them, and no more,
/// the evidence of one search need not be known relative to that of the other.
WeightedPoints united(const WeightedPoints& a, const WeightedPoints& b) {
  if (a.points.rows() == 0 || b.points.rows() == 0) {
    return a.points.rows() == 0 ? b : a;
  }
  WeightedPoints all{Population(a.points.rows() + b.points.rows(), a.points.cols()),
                     Eigen::VectorXd(a.points.rows() + b.points.rows()), a.groups};
  all.points << a.points, b.points;
  all.weights << a.weights, b.weights;
  all.groups.insert(all.groups.end(), b.groups.begin(), b.groups.end());
  return all;
}

/// Share of the posterior mass, evaluated at up to 1000 of the draws, where a search has made fewer
/// than 8 draws per unit of mass.
double missed_mass(const Search& search, const ReferenceDraws& draws, const Eigen::VectorXd& weights,
                   double log_evidence, int threads, const std::function<void()>& look) {
  constexpr Index most_points = 1000;
  const double log_fewest = portable_math::log(8.0);
  const Index n = draws.z.rows();
  const Index stride = (n + most_points - 1) / most_points;
  Population z((n + stride - 1) / stride, draws.z.cols());
  Eigen::VectorXd log_prior(z.rows());
  Eigen::VectorXd log_own(z.rows());
  for (Index i = 0; i < z.rows(); ++i) {
    z.row(i) = draws.z.row(i * stride);
    log_prior[i] = draws.log_prior[i * stride];
    log_own[i] = draws.log_own[i * stride];
  }
  const Eigen::VectorXd log_draws = log_draws_per_volume(search.draws, z, log_prior, log_own, threads, look);
  double missed = 0.0;
  double all = 0.0;
  for (Index i = 0; i < z.rows(); ++i) {
    const double weight = weights[i * stride];
    const double posterior = log_prior[i] + draws.log_likelihood[i * stride] - log_evidence;
    all += weight;
    missed += log_draws[i] < posterior + log_fewest ? weight : 0.0;
  }
  return all > 0.0 ? missed / all : 0.0;
}

std::vector<Warning> warnings_of(const MeasuredPosterior& measured) {
  using Kind = WarningKind;
  std::vector<Warning> warnings;
  const auto warn = [&](Kind kind, const char* what, double value, const char* bound_is, double bound,
                        const char* advice) {
    std::ostringstream text;
    text.precision(3);
    text << what << " is " << value << ": " << bound_is << " " << bound << "; " << advice;
    warnings.push_back({kind, text.str()});
  };
  constexpr double most_missed = 0.1;
  constexpr double most_missed_by_both = 0.01;
  const double missed = std::max(measured.missed_mass[0], measured.missed_mass[1]);
  const double missed_by_both = measured.missed_mass[0] * measured.missed_mass[1];
  const char* advice = "another part may have been missed by both; take more evaluations or other seeds";
  if (!(missed <= most_missed)) {
    warn(Kind::searches_differ, "the posterior mass that one of two searches has missed", missed, "above",
         most_missed, advice);
  } else if (!(missed_by_both <= most_missed_by_both)) {
    warn(Kind::searches_differ, "the product of the posterior masses that each of two searches has missed",
         missed_by_both, "above", most_missed_by_both, advice);
  }
  constexpr Index fewest_search_draws = 2400;
  const double fewest_a_mode = measured.modes > 1 ? 25.0 : 40.0;
  if (!(measured.draws_a_mode >= fewest_a_mode)) {
    warn(Kind::few_draws_a_mode,
         measured.modes > 1
             ? "the number of effective draws that chose beta, for each mode and one that may be lost,"
             : "the number of effective draws that chose beta",
         measured.draws_a_mode, "below", fewest_a_mode,
         "another mode may have been lost; take more evaluations");
  } else if (measured.search_draws < fewest_search_draws) {
    warn(Kind::few_draws_a_mode, "the number of draws of the two searches",
         static_cast<double>(measured.search_draws), "below", static_cast<double>(fewest_search_draws),
         "they may have missed a small part; take 4000 evaluations or more");
  }
  constexpr double fewest_effective = 250.0;
  constexpr double least_share = 0.05;
  const auto n = static_cast<double>(measured.weights.size());
  const double least = std::max(fewest_effective, least_share * n);
  if (!(measured.effective_sample_size >= least)) {
    warn(Kind::low_overlap, "the effective number of draws", measured.effective_sample_size, "below", least,
         "the error is a lower bound; take more evaluations");
  }
  const double digits = portable_math::log(n) / portable_math::log(10.0);
  const double largest_shape = std::min(1.0 - 1.0 / digits, 0.7);
  if (!(measured.pareto_shape <= largest_shape)) {
    warn(Kind::heavy_weights, "the Pareto shape of the largest weights", measured.pareto_shape, "above",
         largest_shape, "the error is a lower bound; take more evaluations");
  }
  return warnings;
}

/// The options for the remaining evaluations: without the finish, and with a proportional number of
/// samples.
Options options_for_the_rest(Options options, Index evaluations) {
  const auto* waste_free = std::get_if<WasteFree>(&options.move);
  const Index chains = waste_free != nullptr ? waste_free->chains : 1;
  const double share = static_cast<double>(evaluations) / static_cast<double>(options.evaluation_budget);
  const auto samples = static_cast<Index>(share * static_cast<double>(options.samples));
  options.samples = std::max<Index>(samples / chains, 2) * chains;
  options.evaluation_budget = evaluations;
  options.finish = NoFinish{};
  return options;
}

/// Takes over the results of a TMCMC run with the remaining evaluations.
void take_over(const Problem& problem, const Options& options, const StreamKey& key,
               MeasuredPosterior& measured) {
  measured.tmcmc =
      run(problem, options_for_the_rest(options, options.evaluation_budget - measured.evaluations), key);
  measured.evaluations += measured.tmcmc->final.evaluations;
  std::ostringstream text;
  text.precision(3);
  text << "beta at the end of the better search is "
       << std::max(measured.search_beta[0], measured.search_beta[1]) << ": below " << least_beta
       << "; the result is that of TMCMC, take more evaluations";
  measured.warnings.push_back({WarningKind::search_not_completed, text.str()});
}

/// The rounds of a search, recorded as stages.
std::vector<StageRecord> records_of(const Search& search) {
  std::vector<StageRecord> records;
  for (std::size_t r = 0; r < search.rounds.size(); ++r) {
    StageRecord record;
    record.stage = static_cast<Index>(r) + 1;
    record.beta = search.rounds[r].beta;
    record.step = record.beta - (records.empty() ? 0.0 : records.back().beta);
    record.effective_sample_size = search.rounds[r].effective_sample_size;
    record.evaluations = search.draws.counts[search.draws.counts.size() - search.rounds.size() + r];
    records.push_back(record);
  }
  return records;
}

/// Whether the fit is good enough to be frozen, or no further attempts are allowed.
bool is_frozen(const IndependentDraws& settings, double effective_share, std::uint32_t attempt) {
  if (attempt == 0) {
    return effective_share >= share_of_a_good_fit;
  }
  return effective_share >= settings.least_effective_share ||
         attempt + 1 >= (effective_share >= share_of_a_poor_fit ? most_attempts : most_attempts_poor);
}

}  // namespace

MeasuredPosterior measure_posterior(const Problem& problem, const Options& options, const StreamKey& key) {
  const auto& settings = std::get<IndependentDraws>(options.finish);
  const int threads = options.threads;
  MeasuredPosterior measured;
  const SearchOptions search = search_options(options, settings, problem.prior.dimension());
  double target = search.most_target;
  std::array<Search, 2> searches;
  for (std::uint32_t k = 0; k < 2; ++k) {
    searches[k] = search_posterior(problem, search, derived(key, k));
    target = std::min(target, searches[k].target);
    measured.search_beta[k] = searches[k].beta();
    measured.evaluations += searches[k].draws.evaluations();
    measured.modes = std::max(measured.modes, searches[k].most_modes);
  }
  measured.search_draws = measured.evaluations;
  measured.rounds = records_of(searches[0]);
  if (std::max(measured.search_beta[0], measured.search_beta[1]) < least_beta) {
    take_over(problem, options, derived(key, 3), measured);
    return measured;
  }

  const auto draw = [&](Index n, std::uint32_t stage) {
    measured.evaluations += n;
    return draw_and_evaluate(problem, measured.reference, n, key, stage, threads, options.batch_rows);
  };
  WeightedPoints points =
      united(fit_points(searches[0].draws, target), fit_points(searches[1].draws, target));
  ReferenceDraws seen;  // by a fit, from the second attempt on
  ReferenceDraws draws;
  for (std::uint32_t attempt = 0;; ++attempt) {
    measured.reference =
        reference_of(settings, fit_mixture(points, settings.fit, key, attempt, problem.look), searches);
    draws = draw((options.evaluation_budget - measured.evaluations) / 6, attempt);
    const double effective = effective_sample_size(as_span(log_weights(draws)), 1.0);
    if (is_frozen(settings, effective / static_cast<double>(draws.z.rows()), attempt)) {
      break;
    }
    if (attempt == 0) {
      seen.append(searches[0].draws, threads, problem.look);
      seen.append(searches[1].draws, threads, problem.look);
    }
    seen.append(draws, threads, problem.look);
    points = fit_points(seen, target);
  }
  draws.append_of_same_density(draw(options.evaluation_budget - measured.evaluations, final_draws_stage));
  if (seen.z.rows() > 0 && effective_sample_size(as_span(log_weights(draws)), 1.0) < few_effective) {
    seen.append(draws, threads, problem.look);  // better dependent on the fits than on one draw or two
    draws = std::move(seen);
  }

  const Eigen::VectorXd log_weight = log_weights(draws);
  const ImportanceEstimate estimate = importance_estimate(as_span(log_weight));
  measured.points = from_unbounded(draws.z, problem.prior);
  measured.log_likelihood = draws.log_likelihood;
  measured.weights = normalised_weights(as_span(log_weight));
  measured.evidence = {estimate.log_mean, estimate.standard_error};
  measured.effective_sample_size = estimate.effective_sample_size;
  measured.pareto_shape = estimate.pareto_shape;
  for (std::size_t k = 0; k < 2; ++k) {
    measured.missed_mass[k] =
        missed_mass(searches[k], draws, measured.weights, estimate.log_mean, threads, problem.look);
  }
  measured.modes = std::max(measured.modes, detail::separate_modes(measured.reference.fitted));
  if (std::min(measured.search_beta[0], measured.search_beta[1]) < 1.0) {
    measured.modes = std::max<Index>(measured.modes, 2);
  }
  measured.draws_a_mode = target / static_cast<double>(measured.modes > 1 ? measured.modes + 1 : 1);
  measured.warnings = warnings_of(measured);
  return measured;
}

}  // namespace tmcmc::detail
